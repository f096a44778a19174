#include "sazare/observe/hdf5_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <functional>
#include <numeric>
#include <system_error>
#include <type_traits>
#include <utility>

#include "sazare/core/error.hpp"
#include "sazare/observe/hdf5_disk.hpp"

namespace sazare::observe {
namespace {

/// HDF5 prints its errors unless told not to; here they become exceptions.
void silence() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

/// A number of HDF5 that is closed by `Close` at the end of its scope.
template <herr_t (*Close)(hid_t)>
class Handle {
public:
  explicit Handle(hid_t id) : id_(id) {}
  ~Handle() { close(); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  operator hid_t() const { return id_; }
  herr_t close() { return id_ < 0 ? 0 : Close(std::exchange(id_, -1)); }

private:
  hid_t id_;
};

using Dataset = Handle<H5Dclose>;
using Space = Handle<H5Sclose>;
using Attribute = Handle<H5Aclose>;
using Type = Handle<H5Tclose>;
using Object = Handle<H5Oclose>;
using Properties = Handle<H5Pclose>;

template <class T>
hid_t type_of() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  return H5T_NATIVE_UINT8;
}

constexpr std::size_t numbers_of_piece = 1 << 14;

std::vector<hsize_t> sizes_of(const std::vector<std::size_t>& shape) { return {shape.begin(), shape.end()}; }

hid_t make_space(const std::vector<hsize_t>& sizes) {
  return H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr);
}

hid_t make_dataset(hid_t file, const std::string& path, hid_t type, hid_t space) {
  const Properties properties(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_obj_track_times(properties, false);  // equal contents make equal files
  return H5Dcreate2(file, path.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
}

}  // namespace

Hdf5Writer::Hdf5Writer(const std::filesystem::path& file, Tables tables)
    : atomic_(file), disk_(std::make_unique<Hdf5Disk>(Hdf5Disk{atomic_.descriptor()})) {
  silence();
  const Properties properties(make_disk_properties(*disk_));
  if (tables == Tables::checked) H5Pset_libver_bounds(properties, H5F_LIBVER_V110, H5F_LIBVER_V110);
  file_ = H5Fcreate(atomic_.temporary().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, properties);
  check(file_);
}

Hdf5Writer::~Hdf5Writer() {
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5Writer::check(std::int64_t result) const {
  if (disk_->error != 0) fail_to_write(atomic_.file(), disk_->error);
  if (result < 0) fail_to_write(atomic_.file(), EIO);
}

void Hdf5Writer::make_group(const std::string& path) {
  const Object group(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  check(group);
}

template <class T>
void Hdf5Writer::write(const std::string& path, std::span<const T> values, const std::vector<std::size_t>& shape) {
  const Space space(make_space(sizes_of(shape)));
  Dataset dataset(make_dataset(file_, path, type_of<T>(), space));
  check(dataset);
  if (!values.empty()) check(H5Dwrite(dataset, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  check(dataset.close());
}

template <class T>
void Hdf5Writer::write(const std::string& path, const MadeNumbers<T>& numbers, const std::vector<std::size_t>& shape) {
  std::vector<hsize_t> sizes = sizes_of(shape), begin(shape.size(), 0);
  const Space space(make_space(sizes));
  Dataset dataset(make_dataset(file_, path, type_of<T>(), space));
  check(dataset);
  const std::size_t rows = shape.front();
  const std::size_t width = std::accumulate(shape.begin() + 1, shape.end(), std::size_t{1}, std::multiplies<>());
  const std::size_t rows_of_piece = std::max<std::size_t>(1, numbers_of_piece / width);
  std::vector<T> piece;
  for (std::size_t row = 0; row < rows; row += rows_of_piece) {
    begin.front() = row;
    sizes.front() = std::min(rows_of_piece, rows - row);
    piece.resize(sizes.front() * width);
    numbers.fill(row * width, piece);
    const Space memory(make_space(sizes));
    check(H5Sselect_hyperslab(space, H5S_SELECT_SET, begin.data(), nullptr, sizes.data(), nullptr));
    check(H5Dwrite(dataset, type_of<T>(), memory, space, H5P_DEFAULT, piece.data()));
  }
  check(dataset.close());
}

template void Hdf5Writer::write(const std::string&, const MadeNumbers<double>&, const std::vector<std::size_t>&);
template void Hdf5Writer::write(const std::string&, const MadeNumbers<std::int32_t>&, const std::vector<std::size_t>&);
template void Hdf5Writer::write(const std::string&, const MadeNumbers<std::int64_t>&, const std::vector<std::size_t>&);
template void Hdf5Writer::write(const std::string&, std::span<const double>, const std::vector<std::size_t>&);
template void Hdf5Writer::write(const std::string&, std::span<const std::int32_t>, const std::vector<std::size_t>&);
template void Hdf5Writer::write(const std::string&, std::span<const std::int64_t>, const std::vector<std::size_t>&);
template void Hdf5Writer::write(const std::string&, std::span<const std::uint8_t>, const std::vector<std::size_t>&);
template void Hdf5Writer::write(const std::string&, std::span<const std::byte>, const std::vector<std::size_t>&);

void Hdf5Writer::set_attribute(const std::string& path, const std::string& name, std::span<const std::int64_t> values) {
  const hsize_t count = values.size();
  const Space space(H5Screate_simple(1, &count, nullptr));
  const Attribute attribute(
      H5Acreate_by_name(file_, path.c_str(), name.c_str(), H5T_NATIVE_INT64, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  check(attribute);
  check(H5Awrite(attribute, H5T_NATIVE_INT64, values.data()));
}

void Hdf5Writer::set_attribute(const std::string& path, const std::string& name, const std::string& text) {
  const Space space(H5Screate(H5S_SCALAR));
  const Type type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, text.size());
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  const Attribute attribute(
      H5Acreate_by_name(file_, path.c_str(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  check(attribute);
  check(H5Awrite(attribute, type, text.data()));
}

void Hdf5Writer::commit(Sync sync) {
  check(H5Fclose(std::exchange(file_, -1)));
  atomic_.commit(sync);
}

Hdf5Reader::Hdf5Reader(std::filesystem::path file) : path_(std::move(file)) {
  silence();
  std::error_code ignored;
  if (!std::filesystem::exists(path_, ignored)) {
    throw UserError(fmt::format("{}: there is no such file", path_.string()));
  }
  const Properties properties(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_fclose_degree(properties, H5F_CLOSE_STRONG);  // closes what is still open in it
  file_ = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, properties);
  if (file_ < 0) fail();
}

Hdf5Reader::~Hdf5Reader() {
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5Reader::fail() const {
  throw UserError(
      fmt::format("{}: cannot be read as an HDF5 file: it is damaged, cut short or another kind of file", path_.string()));
}

bool Hdf5Reader::has(const std::string& path) const { return H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0; }

std::vector<std::byte> Hdf5Reader::read_bytes(const std::string& path) const {
  const Dataset dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT));
  if (dataset < 0) fail();
  const Space space(H5Dget_space(dataset));
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  std::error_code error;
  const auto file_size = std::filesystem::file_size(path_, error);
  if (count < 0 || error || static_cast<std::uintmax_t>(count) > file_size) fail();
  std::vector<std::byte> bytes(static_cast<std::size_t>(count));
  if (count > 0 && H5Dread(dataset, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0) fail();
  return bytes;
}

bool Hdf5Reader::has_attribute(const std::string& path, const std::string& name) const {
  return H5Aexists_by_name(file_, path.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::int64_t> Hdf5Reader::read_attribute(const std::string& path, const std::string& name) const {
  const Attribute attribute(H5Aopen_by_name(file_, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
  if (attribute < 0) fail();
  const Space space(H5Aget_space(attribute));
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  constexpr hssize_t longest = 1024;
  if (count < 0 || count > longest) fail();
  std::vector<std::int64_t> values(static_cast<std::size_t>(count));
  if (H5Aread(attribute, H5T_NATIVE_INT64, values.data()) < 0) fail();
  return values;
}

std::string Hdf5Reader::read_text_attribute(const std::string& path, const std::string& name) const {
  const Attribute attribute(H5Aopen_by_name(file_, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
  if (attribute < 0) fail();
  const Type type(H5Aget_type(attribute));
  constexpr std::size_t longest = 1024;
  const std::size_t size = H5Tget_size(type);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 || size > longest) fail();
  std::string text(size, '\0');
  if (H5Aread(attribute, type, text.data()) < 0) fail();
  return text;
}

}  // namespace sazare::observe
