#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "sazare/core/vector.hpp"

namespace sazare::observe {

/// A table that grows with the run: a header with units, then rows of numbers in their shortest form that
/// reads back to the same bits. Rows are kept in memory until `flush`; a flush that fails leaves whole rows
/// only.
class CsvWriter {
public:
  /// Makes the file, with its header. Columns are named with their unit, as in "time [s]".
  /// Throws MachineError when the file cannot be written.
  CsvWriter(std::filesystem::path file, std::vector<std::string> columns);

  /// Goes on with the file of an earlier run after its first `rows` rows; later ones are removed.
  /// Throws UserError when the file is missing, has another header or fewer rows.
  static CsvWriter resume(std::filesystem::path file, std::vector<std::string> columns, std::size_t rows);

  CsvWriter(CsvWriter&& other) noexcept;
  CsvWriter& operator=(CsvWriter&& other) noexcept;
  /// Flushes what it can; call `flush` to learn of a failure.
  ~CsvWriter();

  /// One number per column. Throws PhysicsError when one is not finite, and adds no row then.
  void add_row(std::span<const Real> values);

  /// Number of rows added, those of the earlier run included.
  std::size_t rows() const { return rows_; }

  /// Hands all rows to the system, and to the disk where `to_disk`. Throws MachineError.
  void flush(bool to_disk = false);

private:
  CsvWriter() = default;

  std::filesystem::path file_;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::size_t written_ = 0;  ///< bytes of the file that are whole rows
  std::string buffer_;
  int descriptor_ = -1;
};

/// A field of a table that is written at once.
using CsvField = std::variant<Real, std::int64_t, std::string>;

/// Writes a whole table, atomically. Texts that hold a comma, a quote or a line's end are put in quotes.
void write_csv(const std::filesystem::path& file, const std::vector<std::string>& columns,
               const std::vector<std::vector<CsvField>>& rows);

}  // namespace sazare::observe
