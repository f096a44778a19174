#pragma once

/// The page of the reference that tells what a run writes: every file, column, field and figure.

#include <string>

namespace sazare::runs {

std::string folder_markdown();

}  // namespace sazare::runs
