#pragma once

#include "sazare/cases/format/document.hpp"
#include "sazare/cases/format/schema.hpp"

namespace sazare::cases {

/// Checks type and range of one value; marks it `wrong` and reports when it is not what the key takes.
void check_value(const Key& key, Value& value, Problems& problems);

}  // namespace sazare::cases
