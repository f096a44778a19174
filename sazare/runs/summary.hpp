#pragma once

/// Figures of a manifest, for the words about a finished run.

#include <string>
#include <string_view>

#include "sazare/observe/manifest.hpp"

namespace sazare::runs {

/// 0 where there is none of that name.
Real figure(const observe::Manifest& manifest, std::string_view name);

std::string figure_text(const observe::Manifest& manifest, std::string_view name, int digits = 4);

/// Work and residual of the energy balance.
std::string balance_text(const observe::Manifest& manifest);

/// A warning where the energy balance misses more than a hundredth of the work and of the energy set free; otherwise empty. The report has the verdict.
std::string balance_warning(const observe::Manifest& manifest);

/// Seconds, threads, and where `steps` names a figure, how many of those steps were done in a second.
std::string wall_time_line(const observe::Manifest& manifest, std::string_view steps = "", std::string_view step_name = "");

}  // namespace sazare::runs
