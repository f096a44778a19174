#include "sazare/observe/csv_writer.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "sazare/core/error.hpp"
#include "sazare/observe/atomic_file.hpp"

namespace sazare::observe {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_buffer = 1 << 20;

void append(std::string& line, const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) {
    line += text;
    return;
  }
  line += '"';
  for (const char c : text) line += c == '"' ? std::string("\"\"") : std::string(1, c);
  line += '"';
}

void append(std::string& line, Real value) { fmt::format_to(std::back_inserter(line), "{}", value); }
void append(std::string& line, std::int64_t value) { fmt::format_to(std::back_inserter(line), "{}", value); }

void append(std::string& line, const CsvField& field) {
  std::visit([&](const auto& value) { append(line, value); }, field);
}

template <class Fields>
void append_row(std::string& text, const Fields& fields) {
  bool first = true;
  for (const auto& field : fields) {
    if (!first) text += ',';
    first = false;
    append(text, field);
  }
  text += '\n';
}

/// The length of the header and the first `rows` rows; npos when there are fewer.
std::size_t length_of_rows(const std::string& text, std::size_t header, std::size_t rows) {
  std::size_t length = header;
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t end = text.find('\n', length);
    if (end == std::string::npos) return end;
    length = end + 1;
  }
  return length;
}

/// The title of a column, which stands in the file from the beginning.
std::string title_of(const fs::path& file, std::size_t column) {
  std::ifstream stream(file);
  std::string header, title;
  std::getline(stream, header);
  std::istringstream rest(header);
  for (std::size_t n = 0; n <= column; ++n)
    if (!std::getline(rest, title, ',')) return fmt::format("column {}", column + 1);
  return fmt::format("\"{}\"", title);
}

}  // namespace

CsvWriter::CsvWriter(fs::path file, std::vector<std::string> columns) : file_(std::move(file)), columns_(columns.size()) {
  append_row(buffer_, columns);
  descriptor_ = make_file(file_, O_WRONLY);
  if (descriptor_ < 0) fail_to_write(file_, errno);
  flush();
}

CsvWriter CsvWriter::resume(fs::path file, std::vector<std::string> columns, std::size_t rows) {
  std::string header;
  append_row(header, columns);
  std::ifstream stream(file, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!stream || !text.starts_with(header)) {
    throw UserError(
        fmt::format("{}: is missing, or its columns are not those of this run. Start the run again without "
                    "--resume",
                    file.string()));
  }
  const std::size_t length = length_of_rows(text, header.size(), rows);
  if (length == std::string::npos) {
    throw UserError(
        fmt::format("{}: has fewer than the {} rows that the checkpoint counts. Start the run again without "
                    "--resume",
                    file.string(), rows));
  }
  CsvWriter writer;
  writer.file_ = std::move(file);
  writer.columns_ = columns.size();
  writer.rows_ = rows;
  writer.written_ = length;
  writer.descriptor_ = open(writer.file_.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC);
  if (writer.descriptor_ < 0 || ftruncate(writer.descriptor_, static_cast<off_t>(length)) != 0) {
    fail_to_write(writer.file_, errno);
  }
  return writer;
}

CsvWriter::CsvWriter(CsvWriter&& other) noexcept { *this = std::move(other); }

CsvWriter& CsvWriter::operator=(CsvWriter&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(columns_, other.columns_);
  std::swap(rows_, other.rows_);
  std::swap(written_, other.written_);
  std::swap(buffer_, other.buffer_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

CsvWriter::~CsvWriter() {
  if (descriptor_ < 0) return;
  try {
    flush();
  } catch (const MachineError&) {  // whoever cares has flushed before
  }
  close(descriptor_);
}

void CsvWriter::add_row(std::span<const Real> values) {
  if (values.size() != columns_) {
    throw std::invalid_argument(fmt::format("{}: a row of {} numbers for {} columns", file_.string(), values.size(), columns_));
  }
  const auto senseless = std::ranges::find_if_not(values, [](Real value) { return std::isfinite(value); });
  if (senseless != values.end()) {
    const auto column = static_cast<std::size_t>(senseless - values.begin());
    throw PhysicsError(
        fmt::format("{}: {} is {} where {} is {:.6g}\n  a number of the case is too large or too small for what follows from it: check "
                    "stiffnesses, densities, sizes, gravity and loads, and their units",
                    file_.filename().string(), title_of(file_, column), std::isnan(*senseless) ? "not a number" : "infinite",
                    title_of(file_, 0), values.front()));
  }
  append_row(buffer_, values);
  ++rows_;
  if (buffer_.size() >= largest_buffer) flush();
}

void CsvWriter::flush(bool to_disk) {
  std::size_t done = 0;
  while (done < buffer_.size()) {
    const ssize_t count = pwrite(descriptor_, buffer_.data() + done, buffer_.size() - done, static_cast<off_t>(written_ + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int error = errno;
      if (ftruncate(descriptor_, static_cast<off_t>(written_)) != 0) fail_to_write(file_, errno);
      fail_to_write(file_, error);
    }
    done += static_cast<std::size_t>(count);
  }
  written_ += buffer_.size();
  buffer_.clear();
  if (to_disk && fsync(descriptor_) != 0) fail_to_write(file_, errno);
}

void write_csv(const fs::path& file, const std::vector<std::string>& columns, const std::vector<std::vector<CsvField>>& rows) {
  std::string text;
  append_row(text, columns);
  for (const auto& row : rows) {
    if (row.size() != columns.size()) {
      throw std::invalid_argument(
          fmt::format("{}: a row of {} fields for {} columns", file.string(), row.size(), columns.size()));
    }
    append_row(text, row);
  }
  write_file(file, text);
}

}  // namespace sazare::observe
