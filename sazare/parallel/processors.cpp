#include "sazare/parallel/processors.hpp"

#include <omp.h>

namespace sazare::parallel {

int processors() { return omp_get_num_procs(); }

}  // namespace sazare::parallel
