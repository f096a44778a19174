#pragma once

#include <atomic>
#include <functional>
#include <utility>

namespace sazare {

/// Whether a long calculation is to end before its time: it asks again and again. One that nobody makes is never made.
class StopRequest {
public:
  StopRequest() = default;
  StopRequest(std::function<bool()> question) : question_(std::move(question)) {}
  /// Made when the flag is set, as a signal does.
  StopRequest(const std::atomic<bool>* flag) {
    if (flag != nullptr) question_ = [flag] { return flag->load(std::memory_order_relaxed); };
  }

  bool is_made() const { return question_ && question_(); }

private:
  std::function<bool()> question_;
};

}  // namespace sazare
