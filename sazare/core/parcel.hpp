#pragma once

/// Plain records one after the other, on their way from one process to another: the same function packs and unpacks them.

#include <cstddef>
#include <cstring>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace sazare {

class Parcel {
public:
  /// To be packed.
  Parcel() = default;
  /// To be unpacked; the bytes must stay.
  explicit Parcel(std::span<const std::byte> arrived) : arrived_(arrived), unpacks_(true) {}

  bool unpacks() const { return unpacks_; }
  std::span<const std::byte> packed() const { return packed_; }

  template <class T>
  void operator()(T& record) {
    static_assert(std::is_trivially_copyable_v<T> || std::is_standard_layout_v<T>, "parcels hold plain records");
    carry(&record, sizeof(T));
  }

  template <class T>
  void operator()(std::vector<T>& records) {
    static_assert(std::is_trivially_copyable_v<T> || std::is_standard_layout_v<T>, "parcels hold plain records");
    std::size_t count = records.size();
    (*this)(count);
    if (unpacks_) records.resize(count);
    carry(records.data(), count * sizeof(T));
  }

private:
  void carry(void* record, std::size_t size) {
    if (size == 0) return;
    if (!unpacks_) {
      const std::size_t before = packed_.size();
      packed_.resize(before + size);
      std::memcpy(packed_.data() + before, record, size);
      return;
    }
    if (arrived_.size() - next_ < size) throw std::logic_error("a parcel holds less than is unpacked from it");
    std::memcpy(record, arrived_.data() + next_, size);
    next_ += size;
  }

  std::vector<std::byte> packed_;
  std::span<const std::byte> arrived_;
  std::size_t next_ = 0;
  bool unpacks_ = false;
};

}  // namespace sazare
