#pragma once

#include <string>
#include <string_view>

#include "sazare/cases/format/problems.hpp"
#include "sazare/cases/format/schema.hpp"

namespace sazare::cases {

struct SyntaxMessage {
  Place place;
  std::string what;
  std::string help;
};

/// Turns the parser's description of a TOML syntax error into what the user wrote and what to write instead.
SyntaxMessage syntax_message(std::string_view description, const Source& source, Place place, std::span<const Table> known);

}  // namespace sazare::cases
