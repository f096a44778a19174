#pragma once

/// One side of a hybrid case in this program, and the other one in a partner's, who may be anybody: what both sides share.

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "sazare/coupling/file_channel.hpp"
#include "sazare/levels/simulation.hpp"
#include "sazare/runs/run_options.hpp"

namespace sazare::runs {

/// The end of a channel to the partner, with where it goes on, and what it costs.
template <class Channel>
class PartnerLine {
public:
  explicit PartnerLine(const RunOptions& options) : options_(options) {}

  /// Joins the partner: at the beginning, or where the checkpoint says.
  void open() {
    channel_.emplace(coupling::ExchangeOptions{options_.one_side->folder, options_.one_side->side, mark_, true,
                                               options_.one_side->time_out, options_.stop});
  }
  Channel& channel() { return *channel_; }

  /// The run stands at the beginning of a window: a checkpoint made now goes on from here.
  void mark() { mark_ = {channel_->files().run(), channel_->files().next()}; }

  void checkpoint_made() {
    if (channel_) channel_->files().keep_from(mark_.next);
  }
  void part(coupling::Farewell reason, std::int64_t window, const std::string& words) {
    if (!channel_) return;
    try {
      channel_->files().part(reason, window, words);
    } catch (const MachineError&) {  // what has failed is the error to report
      if (reason != coupling::Farewell::failed) throw;
    }
  }
  /// Cost of writing and reading messages since the run began.
  coupling::ExchangeCost cost() const {
    const coupling::ExchangeCost now = channel_ ? channel_->files().cost() : coupling::ExchangeCost{};
    return {earlier_.seconds + now.seconds, earlier_.processor_seconds + now.processor_seconds};
  }
  /// Headline figures, for the manifest.
  std::vector<std::pair<std::string, observe::Figure>> figures() const {
    return {{"exchange_seconds", cost().seconds}, {"exchange_processor_seconds", cost().processor_seconds}};
  }

  void columns(Archive& archive) {
    std::vector<char> run(mark_.run.begin(), mark_.run.end());
    archive("run", run);
    archive("next", mark_.next);
    coupling::ExchangeCost so_far = cost();
    archive("seconds", so_far.seconds);
    archive("processor_seconds", so_far.processor_seconds);
    if (!archive.reading()) return;
    mark_.run.assign(run.begin(), run.end());
    earlier_ = so_far;
  }

private:
  RunOptions options_;
  coupling::ExchangeMark mark_;
  coupling::ExchangeCost earlier_;  ///< until the checkpoint that the run was resumed from
  std::optional<Channel> channel_;
};

/// Times of a side: its own work, its partner's as far as it is waited for, and files.
struct SideTimes {
  std::array<levels::PartTime, 3> parts;

  explicit SideTimes(const char* own) : parts{{{own, 0}, {"waiting for the partner", 0}, {"exchange of files", 0}}} {}

  /// Counts a time in which `waited` were spent waiting for the partner, `files` of it in writing and reading [s].
  void add(Real all, Real waited, Real files) {
    parts[0].seconds += all - waited;
    parts[1].seconds += waited - files;
    parts[2].seconds += files;
  }
};

}  // namespace sazare::runs
