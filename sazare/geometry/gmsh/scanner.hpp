#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "sazare/core/vector.hpp"

namespace sazare::geometry {

/// Walks the sections of a Gmsh file and reads numbers from them, ASCII or binary.
///
/// Every error is a UserError that begins with the file, the line (of a text file) or byte, and the section.
class GmshScanner {
public:
  /// Reads the whole file. Throws UserError when it cannot be opened or is empty.
  explicit GmshScanner(std::filesystem::path file);

  /// From now on numbers are binary, in this machine's byte order.
  void set_binary() { binary_ = true; }
  bool is_binary() const { return binary_; }

  /// Goes to the first line of the next section; false at the end of the file.
  bool next_section();
  const std::string& section() const { return section_; }

  /// Checks that the section ends here, and leaves it.
  void end_section();
  /// Leaves the section without reading it.
  void skip_section();

  /// A whole number: 4 bytes where the file is binary.
  std::int32_t read_integer(std::string_view what);
  /// A whole number: 8 bytes where the file is binary.
  std::int64_t read_long(std::string_view what);
  /// A number of items that follow; refused when the rest of the file cannot hold so many. `item_bytes` is
  /// the size of the smallest item in a binary file.
  std::int64_t read_count(std::string_view what, std::size_t item_bytes);
  Real read_real(std::string_view what);

  /// A word, or a text in double quotes; always text, even in a binary file.
  std::string_view read_word(std::string_view what);
  std::string read_quoted(std::string_view what);
  std::int64_t read_text_integer(std::string_view what);

  /// Moves past `bytes` of a binary section.
  void skip_bytes(std::size_t bytes);

  [[noreturn]] void fail(std::string_view message) const;

private:
  template <class T>
  T read_bytes(std::string_view what);
  void skip_space();
  std::size_t remaining() const { return text_.size() - position_; }
  [[noreturn]] void fail_truncated(std::string_view what) const;

  std::filesystem::path file_;
  std::string text_;
  std::string section_;
  std::size_t position_ = 0;
  bool binary_ = false;
};

}  // namespace sazare::geometry
