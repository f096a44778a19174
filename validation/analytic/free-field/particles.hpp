#pragma once

namespace sazare::validation {

/// The rows of method mps.
void print_rows_of_particles();

}  // namespace sazare::validation
