#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sazare::observe {

/// Collects named byte blobs and writes them to one HDF5 file at once.
class CheckpointWriter {
public:
  /// Copies the bytes. A name is used once; any characters but '/' will do.
  void add(std::string name, std::span<const std::byte> bytes);

  /// Writes a temporary file beside `file`, then renames: `file` is the former checkpoint or this one, never
  /// half. Throws MachineError when it cannot be written.
  void commit(const std::filesystem::path& file);

private:
  struct Blob {
    std::string name;
    std::vector<std::byte> bytes;
  };
  std::vector<Blob> blobs_;
};

/// Reads what CheckpointWriter wrote; length and checksum of each blob are verified as it is read.
class CheckpointReader {
public:
  /// Throws UserError when the file is missing, cut short, no checkpoint of Sazare, or of a newer format.
  explicit CheckpointReader(std::filesystem::path file);

  bool has(const std::string& name) const;

  /// Throws UserError when the blob is missing or damaged.
  std::vector<std::byte> read(const std::string& name) const;

private:
  std::filesystem::path file_;
  std::vector<std::string> names_;
};

}  // namespace sazare::observe
