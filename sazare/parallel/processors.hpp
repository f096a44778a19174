#pragma once

namespace sazare::parallel {

/// The number of processors that this program may use.
int processors();

}  // namespace sazare::parallel
