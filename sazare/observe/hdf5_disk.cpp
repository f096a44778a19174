#include "sazare/observe/hdf5_disk.hpp"

#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>

#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

namespace sazare::observe {
namespace {

/// A file as HDF5 knows it: its own part must come first.
struct DiskFile {
  H5FD_t base;
  Hdf5Disk* disk;
  haddr_t end_of_addresses;  ///< as HDF5 has it laid out
  haddr_t end_of_file;       ///< as it was written
};

DiskFile& disk_file(H5FD_t* file) { return *reinterpret_cast<DiskFile*>(file); }
const DiskFile& disk_file(const H5FD_t* file) { return *reinterpret_cast<const DiskFile*>(file); }

void note(Hdf5Disk& disk, int error) {
  if (disk.error == 0) disk.error = error;
}

H5FD_t* open_file(const char*, unsigned, hid_t properties, haddr_t) {
  auto* file = new DiskFile{};
  file->disk = *static_cast<Hdf5Disk* const*>(H5Pget_driver_info(properties));
  return &file->base;
}

herr_t close_file(H5FD_t* file) {
  delete &disk_file(file);
  return 0;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t end_of_addresses(const H5FD_t* file, H5FD_mem_t) { return disk_file(file).end_of_addresses; }

herr_t set_end_of_addresses(H5FD_t* file, H5FD_mem_t, haddr_t address) {
  disk_file(file).end_of_addresses = address;
  return 0;
}

haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t) { return disk_file(file).end_of_file; }

herr_t read_file(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, void* buffer) {
  const DiskFile& file = disk_file(base);
  auto* to = static_cast<char*>(buffer);
  while (size > 0) {
    const ssize_t count = pread(file.disk->descriptor, to, size, static_cast<off_t>(address));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) note(*file.disk, errno);
    if (count <= 0) break;
    to += count;
    address += static_cast<haddr_t>(count);
    size -= static_cast<std::size_t>(count);
  }
  std::memset(to, 0, size);  // beyond the end, or lost
  return 0;
}

herr_t write_file(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, const void* buffer) {
  DiskFile& file = disk_file(base);
  file.end_of_file = std::max<haddr_t>(file.end_of_file, address + size);
  const auto* from = static_cast<const char*>(buffer);
  while (size > 0 && file.disk->error == 0) {
    const ssize_t count = pwrite(file.disk->descriptor, from, size, static_cast<off_t>(address));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      note(*file.disk, errno);
      break;
    }
    from += count;
    address += static_cast<haddr_t>(count);
    size -= static_cast<std::size_t>(count);
  }
  return 0;
}

herr_t truncate_file(H5FD_t* base, hid_t, hbool_t) {
  DiskFile& file = disk_file(base);
  if (ftruncate(file.disk->descriptor, static_cast<off_t>(file.end_of_addresses)) != 0) note(*file.disk, errno);
  file.end_of_file = file.end_of_addresses;
  return 0;
}

H5FD_class_t make_driver() {
  H5FD_class_t driver{};
#if H5_VERSION_GE(1, 13, 2)
  driver.version = H5FD_CLASS_VERSION;
  driver.value = static_cast<H5FD_class_value_t>(600);  // of the numbers that HDF5 leaves to others
#endif
  driver.name = "sazare_disk";
  driver.maxaddr = static_cast<haddr_t>(~0ULL >> 1);
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.fapl_size = sizeof(Hdf5Disk*);
  driver.open = open_file;
  driver.close = close_file;
  driver.query = query;
  driver.get_eoa = end_of_addresses;
  driver.set_eoa = set_end_of_addresses;
  driver.get_eof = end_of_file;
  driver.read = read_file;
  driver.write = write_file;
  driver.truncate = truncate_file;
  constexpr H5FD_mem_t kinds[H5FD_MEM_NTYPES] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(kinds), std::end(kinds), std::begin(driver.fl_map));
  return driver;
}

}  // namespace

std::int64_t make_disk_properties(Hdf5Disk& disk) {
  static const H5FD_class_t driver = make_driver();
  static const hid_t driver_number = H5FDregister(&driver);
  const hid_t properties = H5Pcreate(H5P_FILE_ACCESS);
  Hdf5Disk* const address = &disk;
  H5Pset_driver(properties, driver_number, &address);
  H5Pset_fclose_degree(properties, H5F_CLOSE_STRONG);
  return properties;
}

}  // namespace sazare::observe
