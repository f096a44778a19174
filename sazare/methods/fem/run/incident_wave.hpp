#pragma once

/// The incident wave of a case.

#include "sazare/methods/fem/body.hpp"
#include "sazare/methods/fem/run/mesh_names.hpp"
#include "sazare/methods/fem/supports.hpp"

namespace sazare::runs {

/// Adds the wave to the supports, once their sides and viscous boundaries are in them. Throws UserError where it cannot come in.
template <int D>
void add_incident_wave(const cases::CaseFile& file, const methods::fem::BodyDescription& body,
                       methods::fem::Supports<D>& supports);

/// A line that says how the wave travels; empty where there is none.
template <int D>
std::string incident_wave_line(const methods::fem::Supports<D>& supports);

}  // namespace sazare::runs
