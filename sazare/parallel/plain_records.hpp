#pragma once

/// Plain records as the bytes that ranks give each other, and back.

#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

namespace sazare::parallel {

template <class Record>
std::vector<std::byte> bytes_of(std::span<const Record> records) {
  const auto bytes = std::as_bytes(records);
  return {bytes.begin(), bytes.end()};
}

template <class Record>
std::vector<std::byte> bytes_of(const std::vector<Record>& records) {
  return bytes_of(std::span(records));
}

template <class Record>
std::vector<Record> records_in(std::span<const std::byte> bytes) {
  std::vector<Record> records(bytes.size() / sizeof(Record));
  if (!records.empty()) std::memcpy(static_cast<void*>(records.data()), bytes.data(), bytes.size());
  return records;
}

}  // namespace sazare::parallel
