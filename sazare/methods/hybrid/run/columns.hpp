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
    Column{"impulse_under_way", "N s", "of that, what the continuum has not got yet", 3},
    Column{"work_on_nodes", "J", "over the surface"},
    Column{"work_on_bodies", "J", "over the surface"},
    Column{"energy_made", "J", "their sum, which nobody has lost"},
    Column{"energy_residual_continuum", "J", "of its ledger"},
    Column{"energy_residual_bodies", "J", "of their ledger"},
    Column{"passes", "-", "through windows so far"},
    Column{"disagreement", "-", "what was left between the force tried and found, over the larger one"}};

/// In the manifest, `results` by name: an interface, which scripts of users read.
inline constexpr std::array figures = {Column{"windows", "-", ""},
                                      Column{"window", "s", "its length"},
                                      Column{"passes", "-", "through windows"},
                                      Column{"steps_per_window", "-", "of the bodies"},
                                      Column{"step", "s", "of the bodies"},
                                      Column{"elements", "-", ""},
                                      Column{"freedoms", "-", ""},
                                      Column{"particles", "-", "where the bodies are spheres"},
                                      Column{"particle_steps", "-", ""},
                                      Column{"body_elements", "-", "where they are rectangles"},
                                      Column{"body_element_steps", "-", ""},
                                      Column{"blocks", "-", "where they are blocks"},
                                      Column{"block_steps", "-", ""},
                                      Column{"impulse_given", "N s", "by the bodies"},
                                      Column{"impulse_under_way", "N s", "what the continuum has not got yet"},
                                      Column{"work_on_nodes", "J", ""},
                                      Column{"energy_made", "J", "over the surface"},
                                      Column{"peak_force", "N", "of the bodies on the surface"},
                                      Column{"peak_displacement", "m", "mean of the surface's nodes"}};

/// Of a side of a hybrid case that is a program of its own.
inline constexpr std::array exchange = {
    Column{"exchange_seconds", "s", "spent in writing and reading messages, without the waits for the partner"},
    Column{"exchange_processor_seconds", "s", "of the processor, for the same"}};

}  // namespace sazare::runs::columns::hybrid
