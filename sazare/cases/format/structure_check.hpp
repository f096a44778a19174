#pragma once

#include <span>

#include "sazare/cases/format/document.hpp"
#include "sazare/cases/format/schema.hpp"

namespace sazare::cases {

/// Checks tables, keys, types and ranges against the schema. Values that are not what their key takes are
/// marked `wrong`.
void check_structure(Value& root, std::span<const Table> schema, Problems& problems);

/// "[time]" or "[[joints]]"
std::string table_header(const Table& table);

/// What to write for a missing key: `add density = ... (a number in kg/m3, greater than 0): Mass per volume.`
std::string how_to_add(const Key& key);

}  // namespace sazare::cases
