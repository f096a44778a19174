#pragma once

/// The page of the reference that tells what a run writes: every file, column, field and figure.

#include <span>
#include <string>

#include "sazare/runs/method.hpp"

namespace sazare::runs {

/// With the tables of all methods.
std::string folder_markdown(std::span<const FolderTables> methods);

}  // namespace sazare::runs
