#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sazare/observe/atomic_file.hpp"

namespace sazare::observe {

struct Hdf5Disk;

/// Numbers that are made while they are written, so that they never stand in memory all at once: `fill(first, piece)` sets those
/// from number `first` on.
template <class T>
struct MadeNumbers {
  std::size_t count = 0;
  std::function<void(std::size_t first, std::span<T> piece)> fill;

  std::size_t size() const { return count; }
};

/// An HDF5 file in the making, atomic (see AtomicFile). Paths of groups and datasets are absolute
/// ("/group/name"). Every member throws MachineError when the disk fails; then nothing is left of the file.
class Hdf5Writer {
public:
  /// How HDF5 lays out its own tables: as every reader knows them, or with checksums that show damage.
  enum class Tables { common, checked };

  explicit Hdf5Writer(const std::filesystem::path& file, Tables tables = Tables::common);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  void make_group(const std::string& path);

  /// A dataset of this shape, its last index fastest. T: double, std::int32_t, std::int64_t, std::uint8_t,
  /// std::byte.
  template <class T>
  void write(const std::string& path, std::span<const T> values, const std::vector<std::size_t>& shape);
  template <class T>
  void write(const std::string& path, std::span<const T> values) {
    write(path, values, {values.size()});
  }
  /// Writes numbers that are made in pieces of whole rows.
  template <class T>
  void write(const std::string& path, const MadeNumbers<T>& numbers, const std::vector<std::size_t>& shape);

  /// Attributes of a group or dataset: whole numbers (an array), a text of fixed length in ASCII.
  void set_attribute(const std::string& path, const std::string& name, std::span<const std::int64_t> values);
  void set_attribute(const std::string& path, const std::string& name, const std::string& text);

  /// Finishes the file and gives it its name.
  void commit(Sync sync = Sync::disk);

private:
  /// Fails when HDF5 says no (a result below zero) or the disk has.
  void check(std::int64_t result) const;

  AtomicFile atomic_;
  std::unique_ptr<Hdf5Disk> disk_;
  std::int64_t file_ = -1;  ///< HDF5's number of the open file
};

/// An open HDF5 file, read only. Members return false or throw UserError when the file does not hold what is
/// asked.
class Hdf5Reader {
public:
  /// Throws UserError when the file is missing, no HDF5 file, or cut short.
  explicit Hdf5Reader(std::filesystem::path file);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  bool has(const std::string& path) const;
  std::vector<std::byte> read_bytes(const std::string& path) const;
  std::vector<std::int64_t> read_attribute(const std::string& path, const std::string& name) const;
  std::string read_text_attribute(const std::string& path, const std::string& name) const;
  bool has_attribute(const std::string& path, const std::string& name) const;

private:
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  std::int64_t file_ = -1;
};

}  // namespace sazare::observe
