#pragma once

#include <string>
#include <string_view>

namespace sazare {

/// Without the mark (U+FEFF in UTF-8) that spreadsheets and editors put before the first character of a text file.
inline std::string_view without_byte_order_mark(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}

/// The content of a text file without a byte order mark, its lines ended by "\n" whatever system wrote them ("\r\n", or "\r"
/// alone).
inline std::string plain_text(std::string_view content) {
  content = without_byte_order_mark(content);
  std::string text;
  text.reserve(content.size());
  for (std::size_t i = 0; i < content.size(); ++i) {
    if (content[i] != '\r')
      text += content[i];
    else if (i + 1 == content.size() || content[i + 1] != '\n')
      text += '\n';
  }
  return text;
}

}  // namespace sazare
