#pragma once

#include <cstdint>

namespace sazare::observe {

/// Where HDF5 writes a file, and what went wrong there.
struct Hdf5Disk {
  int descriptor = -1;  ///< open for reading and writing
  int error = 0;        ///< errno of the first failure
};

/// File access properties by which HDF5 writes through `disk`, an hid_t to be closed by H5Pclose; `disk` must
/// outlive the file.
///
/// HDF5 1.10 cannot close a file whose last writes failed (disk full): it would crash at the end of the
/// program. So it is never told: a failure is noted in `disk.error`, and the caller gives the file up.
std::int64_t make_disk_properties(Hdf5Disk& disk);

}  // namespace sazare::observe
