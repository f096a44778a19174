#pragma once

#include <string>
#include <string_view>

namespace sazare::cases {

/// A word of a command that is shown to the user, quoted where a POSIX shell would not read it back as it is.
inline std::string shell_word(const std::string& word) {
  static constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace sazare::cases
