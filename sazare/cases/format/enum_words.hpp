#pragma once

namespace sazare::cases {

/// The words of an enumeration in case files, in its order: `static constexpr std::array<std::string_view, n> words`.
template <class Enum>
struct EnumWords;

}  // namespace sazare::cases
