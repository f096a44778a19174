#pragma once

/// How a part of the simulation hands its columns to a checkpoint and takes them back: one function names each column,
/// and the same function serves both directions.

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "sazare/core/error.hpp"

namespace sazare {

class Archive {
public:
  virtual ~Archive() = default;
  virtual bool reading() const = 0;

  /// A column of plain records.
  template <class T>
  void operator()(const std::string& name, std::vector<T>& column) {
    static_assert(std::is_trivially_copyable_v<T> || std::is_standard_layout_v<T>, "columns hold plain records");
    if (!reading()) return write(prefix_ + name, std::as_bytes(std::span(column)));
    const std::vector<std::byte> bytes = read(prefix_ + name);
    if (bytes.size() % sizeof(T) != 0) throw UserError("checkpoint: column " + prefix_ + name + " has another layout");
    column.resize(bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(static_cast<void*>(column.data()), bytes.data(), bytes.size());
  }

  /// A single plain value.
  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(const std::string& name, T& value) {
    std::vector<T> column{value};
    (*this)(name, column);
    if (column.size() != 1) throw UserError("checkpoint: value " + prefix_ + name + " has another layout");
    value = column.front();
  }

  /// Columns named inside `fill` stand under `folder`.
  template <class Fill>
  void folder(const std::string& folder, Fill&& fill) {
    const std::string outer = prefix_;
    prefix_ += folder + ".";
    fill();
    prefix_ = outer;
  }

protected:
  virtual void write(const std::string& name, std::span<const std::byte> bytes) = 0;
  virtual std::vector<std::byte> read(const std::string& name) = 0;

private:
  std::string prefix_;
};

}  // namespace sazare
