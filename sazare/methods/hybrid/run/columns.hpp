#pragma once

/// What runs of method hybrid write: columns of their tables, fields of their snapshots, headline figures of their manifests, all in
/// their order. Energies and forces in the plane are per metre across it.

#include "sazare/observe/column.hpp"

namespace sazare::runs::columns::hybrid {

using observe::Column;

inline constexpr std::array history = {
    Column{"surface.displacement", "m", "mean of the surface's nodes", 3},
    Column{"surface.force", "N", "of the bodies on the surface: mean of the last window", 3},
    Column{"surface.last_force", "N", "of the bodies on the surface: at the window's end", 3},
    Column{"impulse_given", "N s", "by the bodies so far", 3},
    Column{"impulse_pending", "N s", "part of it that the continuum has not yet received", 3},
    Column{"energy_work_on_nodes", "J", "over the surface"},
    Column{"energy_work_on_bodies", "J", "over the surface"},
    Column{"energy_coupling_error", "J", "sum of both: energy added by the coupling"},
    Column{"energy_residual_continuum", "J", "of the energy balance of the continuum"},
    Column{"energy_residual_bodies", "J", "of the energy balance of the bodies"},
    Column{"passes", "-", "through coupling windows so far"},
    Column{"force_mismatch", "-", "difference of assumed and resulting force over the larger one"}};

/// In the manifest, `results` by name: an interface, which scripts of users read.
inline constexpr std::array figures = {
    Column{"windows", "-", ""},
    Column{"window", "s", "length of a coupling window"},
    Column{"passes", "-", "through coupling windows"},
    Column{"unconverged_windows", "-", "in which the automatic scheme left a force mismatch above a hundredth"},
    Column{"steps_per_window", "-", "of the bodies"},
    Column{"step", "s", "of the bodies"},
    Column{"elements", "-", ""},
    Column{"degrees_of_freedom", "-", "free degrees of freedom"},
    Column{"particles", "-", "where the bodies are spheres"},
    Column{"particle_steps", "-", ""},
    Column{"body_elements", "-", "where they are rectangles"},
    Column{"body_element_steps", "-", ""},
    Column{"blocks", "-", "where they are blocks"},
    Column{"block_steps", "-", ""},
    Column{"ground_particles", "-", "where they are ground of method mps"},
    Column{"ground_particle_steps", "-", ""},
    Column{"impulse_given", "N s", "by the bodies"},
    Column{"impulse_pending", "N s", "that the continuum has not received"},
    Column{"energy_work_on_nodes", "J", ""},
    Column{"energy_work", "J", "reference of the residual: the works of both sides"},
    Column{"energy_coupling_error", "J", "added by the coupling"},
    Column{"peak_force", "N", "of the bodies on the surface"},
    Column{"peak_displacement", "m", "mean of the surface's nodes"}};

/// Figures of a side of a hybrid case that runs in a program of its own.
inline constexpr std::array exchange = {
    Column{"exchange_seconds", "s", "wall-clock time of writing and reading messages, without waiting for the partner"},
    Column{"exchange_processor_seconds", "s", "processor time of writing and reading messages"}};

}  // namespace sazare::runs::columns::hybrid
