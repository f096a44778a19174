#include "sazare/observe/checkpoint.hpp"

#include <fmt/format.h>

#include <bit>
#include <stdexcept>

#include "sazare/core/error.hpp"
#include "sazare/observe/hash.hpp"

namespace sazare::observe {
namespace {

constexpr std::int64_t format_version = 1;
const std::string format_name = "sazare-checkpoint";
const std::string group = "/checkpoint";

std::string path_of(const std::string& name) { return group + "/" + name; }

std::vector<std::int64_t> seal_of(std::span<const std::byte> bytes) {
  return {static_cast<std::int64_t>(bytes.size()), std::bit_cast<std::int64_t>(hash_bytes(bytes))};
}

std::vector<std::int64_t> signature(const SignatureKey& key, const std::string& name, std::span<const std::byte> bytes) {
  return {std::bit_cast<std::int64_t>(signature_of(key, name, bytes))};
}

}  // namespace

CheckpointWriter::CheckpointWriter(const std::filesystem::path& file) : file_(file, Hdf5Writer::Tables::checked) {
  file_.make_group(group);
  file_.set_attribute(group, "format", format_name);
  file_.set_attribute(group, "version", std::vector<std::int64_t>{format_version});
}

void CheckpointWriter::add(const std::string& name, std::span<const std::byte> bytes) {
  if (name.empty() || name == "." || name.find('/') != std::string::npos) {
    throw std::invalid_argument("a checkpoint cannot hold the name '" + name + "'");
  }
  if (!names_.insert(name).second) throw std::invalid_argument("a checkpoint holds '" + name + "' already");
  file_.write(path_of(name), bytes);
  file_.set_attribute(path_of(name), "length_and_checksum", seal_of(bytes));
  file_.set_attribute(path_of(name), "signature", signature(key_, name, bytes));
}

void CheckpointWriter::commit(Sync sync) { file_.commit(sync); }

CheckpointReader::CheckpointReader(const std::filesystem::path& path) try : path_(path), file_(path) {
  if (!file_.has(group) || !file_.has_attribute(group, "format") || file_.read_text_attribute(group, "format") != format_name) {
    throw UserError(fmt::format("{}: is not a checkpoint of Sazare", path.string()));
  }
  const std::vector<std::int64_t> version = file_.read_attribute(group, "version");
  if (version != std::vector<std::int64_t>{format_version}) {
    throw UserError(fmt::format("{}: checkpoint format {}, this Sazare reads {}. Resume with the Sazare that wrote it",
                                path.string(), version.empty() ? 0 : version[0], format_version));
  }
} catch (const UserError& error) {
  throw UserError(fmt::format("{}. Start the run again with --overwrite", error.what()));
}

bool CheckpointReader::has(const std::string& name) const { return file_.has(path_of(name)); }

std::vector<std::byte> CheckpointReader::read(const std::string& name) const {
  if (!has(name)) {
    throw UserError(fmt::format(
        "{}: has no '{}': it was written by another version of Sazare or is damaged. Start the run again with --overwrite",
        path_.string(), name));
  }
  std::vector<std::byte> bytes = file_.read_bytes(path_of(name));
  if (file_.read_attribute(path_of(name), "length_and_checksum") != seal_of(bytes)) {
    throw UserError(fmt::format("{}: '{}' is damaged: its checksum does not match its data. Start the run again with --overwrite",
                                path_.string(), name));
  }
  check_signature(name, bytes);
  return bytes;
}

void CheckpointReader::check_signature(const std::string& name, std::span<const std::byte> bytes) const {
  if (is_trusted_) return;
  if (file_.has_attribute(path_of(name), "signature") &&
      file_.read_attribute(path_of(name), "signature") == signature(key_, name, bytes))
    return;
  throw UserError(fmt::format(
      "{}: this checkpoint was not written by you on this machine, and one that somebody made up can crash the program\n"
      "  your key lies below HOME, so another HOME is another user; if you know where it comes from, add --trust-checkpoint, or "
      "set SAZARE_TRUST_CHECKPOINT=1 in the environment; "
      "otherwise start the run again with --overwrite",
      path_.string()));
}

}  // namespace sazare::observe
