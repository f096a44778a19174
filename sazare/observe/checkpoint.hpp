#pragma once

#include <cstddef>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "sazare/observe/hdf5_file.hpp"
#include "sazare/observe/signature.hpp"

namespace sazare::observe {

/// Writes named byte blobs to one HDF5 file, each with its length, checksum and the signature of the user. The former file of
/// that name stays until `commit`, so there is always one whole checkpoint. Throws MachineError when the disk fails.
class CheckpointWriter {
public:
  explicit CheckpointWriter(const std::filesystem::path& file);

  /// Writes the bytes at once. A name is used once; any characters but '/' will do.
  void add(const std::string& name, std::span<const std::byte> bytes);

  void commit(Sync sync = Sync::disk);

private:
  Hdf5Writer file_;
  SignatureKey key_ = signature_key();
  std::set<std::string> names_;
};

/// Reads what CheckpointWriter wrote; length, checksum and signature of each blob are verified as it is read.
class CheckpointReader {
public:
  /// Throws UserError when the file is missing, cut short, no checkpoint of Sazare, or of another format
  /// version.
  explicit CheckpointReader(const std::filesystem::path& file);

  bool has(const std::string& name) const;

  /// Throws UserError when the blob is missing or damaged, or was signed by somebody else and the user does not trust it.
  std::vector<std::byte> read(const std::string& name) const;

private:
  void check_signature(const std::string& name, std::span<const std::byte> bytes) const;

  std::filesystem::path path_;
  Hdf5Reader file_;
  SignatureKey key_ = signature_key();
  bool is_trusted_ = trusts_checkpoints();
};

}  // namespace sazare::observe
