#include "sazare/runs/run_identity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <sstream>
#include <vector>

#include "sazare/core/error.hpp"
#include "sazare/core/version.hpp"
#include "sazare/observe/hash.hpp"
#include "sazare/state/bodies.hpp"

namespace sazare::runs {

namespace {

constexpr std::size_t most_lines_shown = 4;

template <class T>
std::span<const std::byte> bytes_of(const T& records) {
  return std::as_bytes(std::span(records.data(), records.size()));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Lines of `text` that `other` does not have.
std::vector<std::string> lines_only_in(const std::string& text, const std::string& other) {
  std::vector<std::string> only;
  const std::vector<std::string> others = lines_of(other);
  for (const std::string& line : lines_of(text))
    if (std::ranges::find(others, line) == others.end()) only.push_back(line);
  return only;
}

std::string list(const std::string& label, const std::vector<std::string>& lines) {
  std::string text;
  for (std::size_t i = 0; i < std::min(lines.size(), most_lines_shown); ++i) text += fmt::format("\n  {}: {}", label, lines[i]);
  if (lines.size() > most_lines_shown) text += fmt::format("\n  {}: and {} more lines", label, lines.size() - most_lines_shown);
  return text;
}

void add(observe::CheckpointWriter& out, const std::string& name, const std::string& text) { out.add(name, bytes_of(text)); }

std::string read(const observe::CheckpointReader& in, const std::string& name) {
  const std::vector<std::byte> bytes = in.read(name);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

std::string records_hash(std::vector<cases::Motion>& motions) {
  observe::Hash records;
  for (cases::Motion& motion : motions) {
    motion.file = motion.file.filename();
    records.add(bytes_of(motion.record.value));
  }
  return observe::to_hex(records.value());
}

std::string curves_hash(std::span<cases::SoilBackbone* const> soils) {
  observe::Hash hash;
  bool any = false;
  for (cases::SoilBackbone* soil : soils) {
    if (soil->modulus_reduction.empty()) continue;
    any = true;
    soil->modulus_reduction = soil->modulus_reduction.filename();
    for (const auto* column : {&soil->reduction.strain, &soil->reduction.ratio}) hash.add(std::as_bytes(std::span(*column)));
  }
  return any ? observe::to_hex(hash.value()) : "";
}

std::string program_text() {
  return fmt::format("Sazare {}, commit {}, GCC {}, records of {} and {} bytes", version, commit, __VERSION__,
                     sizeof(state::Motion<3>), sizeof(state::Inertia<3>));
}

void write_identity(observe::CheckpointWriter& out, const RunIdentity& identity) {
  add(out, "identity.case", identity.case_text);
  add(out, "identity.mesh", identity.mesh);
  add(out, "identity.tables", identity.tables);
  add(out, "identity.program", identity.program);
}

void check_identity(const observe::CheckpointReader& in, const std::filesystem::path& folder, const RunIdentity& now) {
  const auto refuse = [&](const std::string& what, const std::string& help) {
    throw UserError(fmt::format("{}: cannot be resumed: {}. {}, or start again with --overwrite", folder.string(), what, help));
  };
  if (const std::string program = read(in, "identity.program"); program != now.program)
    refuse(fmt::format("its checkpoint was written by another program, and only the same program gives the same results"
                       "\n  checkpoint: {}\n  now: {}\n",
                       program, now.program),
           "Resume with the program that wrote it");
  if (const std::string before = read(in, "identity.case"); before != now.case_text)
    refuse(
        fmt::format("the case is not the one that the checkpoint was written for{}{}\n",
                    list("checkpoint", lines_only_in(before, now.case_text)), list("now", lines_only_in(now.case_text, before))),
        "Give the case and the --set of the first part of the run");
  if (read(in, "identity.mesh") != now.mesh)
    refuse("the mesh is not the one that the checkpoint was written for", "Restore the mesh of the first part of the run");
  if (read(in, "identity.tables") != now.tables)
    refuse("a pressure table or record is not the one that the checkpoint was written for",
           "Restore the file of the first part of the run");
}

}  // namespace sazare::runs
