#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/cases/format/case_text.hpp"
#include "sazare/cases/tables.hpp"

/// What can be found wrong from the text of a case alone, after types and ranges: each function reports what
/// it finds.
namespace sazare::cases {

/// Reads another case that this one names, with its own overrides; `side` as for read_case.
using ReadSide =
    std::function<CaseFile(const std::filesystem::path& path, std::span<const std::string> overrides, const std::string& side)>;

/// What the checks look at: the document for places and for what was given, the case for values.
struct CheckContext {
  const Value& root;
  std::span<const Table> schema;
  std::filesystem::path shown_folder;  // the case file's folder as the user typed it, for messages
  Problems& problems;
  std::filesystem::path folder = {};            // the case file's folder, as it can be opened from anywhere
  std::span<const std::string> overrides = {};  // of the command line
  ReadSide read_side = {};

  std::vector<Entry> entries_of(std::string_view table) const;
};

void check_mesh_file(const CheckContext& context, const Mesh& mesh);

/// The clocks of a case, by whatever method.
struct Clocks {
  Real end;  // s
  std::string_view step_key;
  std::optional<Real> step;  // s
  Real& history_interval;    // s
  Real& snapshot_interval;   // s
};

/// Checks that the clocks nest, and fills in the intervals that are not given.
void resolve_clocks(const CheckContext& context, const Clocks& clocks);
void resolve_clocks(const CheckContext& context, UniformTime& time);

/// Checks motions and reads their records; warns of those that are over before the end of the run [s].
void check_motions(const CheckContext& context, std::vector<Motion>& motions, Real end);

/// In 2-D the z of a key is 0; `table` has the key dimension.
void check_flat(const CheckContext& context, const Entry& entry, std::string_view key, const Vector3& value, int dimension,
                std::string_view table);

/// Damping ratios of materials need the two frequencies of [damping], in their order.
void check_damping(const CheckContext& context, const Damping& damping, const std::vector<Real>& ratios);

/// The motions that a boundary names by axis are there.
void check_motion_names(const CheckContext& context, const Entry& entry, const std::array<std::string, 3>& motion,
                        const std::vector<std::string>& names);

/// Numbers of a Mohr-Coulomb strength, angles in degrees.
struct StrengthNumbers {
  Real cohesion = 0, friction_angle = 0, dilation_angle = 0, tensile_strength = 0;
};

/// Checks that the numbers of a strength go together; does nothing where the friction angle is missing.
void check_strength(const CheckContext& context, const Entry& entry, const StrengthNumbers& strength);

/// Reports keys that are missing, and those that do not belong to what was chosen, with the help for these.
void check_keys(const CheckContext& context, const Entry& entry, const std::string& chosen,
                const std::vector<std::string_view>& needed, const std::vector<std::string_view>& foreign,
                const std::string& help = "remove it, or choose another kind");

/// Reports names that stand twice in a list of tables, and names that cannot head a column.
void check_unique_names(const CheckContext& context, std::string_view table, std::span<const std::string> names);

template <class Item>
void check_unique(const CheckContext& context, std::string_view table, const std::vector<Item>& items) {
  std::vector<std::string> names;
  for (const Item& item : items) names.push_back(item.name);
  check_unique_names(context, table, names);
}

/// Reports names that stand in both lists: they head columns of one table.
void check_names_apart(const CheckContext& context, std::string_view table, std::span<const std::string> names,
                       std::string_view other, std::span<const std::string> other_names);

/// The file that a key names, as it can be opened; reports one that is not there (then nothing).
bool check_file(const CheckContext& context, const Place& place, std::string_view what, const std::filesystem::path& file,
                const std::string& as_written);

}  // namespace sazare::cases
