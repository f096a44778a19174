#pragma once

/// Columns in memory: a place to return to.

#include <map>
#include <string>
#include <vector>

#include "sazare/core/archive.hpp"

namespace sazare {

class MemoryArchive final : public Archive {
public:
  bool reading() const override { return reading_; }

  /// From writing to reading, or back.
  void turn_round() { reading_ = !reading_; }

  const std::map<std::string, std::vector<std::byte>>& columns() const { return columns_; }
  friend bool operator==(const MemoryArchive& a, const MemoryArchive& b) { return a.columns_ == b.columns_; }

protected:
  void write(const std::string& name, std::span<const std::byte> bytes) override {
    if (!columns_.emplace(name, std::vector<std::byte>(bytes.begin(), bytes.end())).second)
      throw UserError("column " + name + " written twice");
  }
  std::vector<std::byte> read(const std::string& name) override {
    const auto found = columns_.find(name);
    if (found == columns_.end()) throw UserError("column " + name + " is not there");
    return found->second;
  }

private:
  std::map<std::string, std::vector<std::byte>> columns_;
  bool reading_ = false;
};

}  // namespace sazare
