#pragma once

#include <memory>

#include "sazare/methods/blocks/run/parts.hpp"
#include "sazare/methods/blocks/water/water_loads.hpp"

namespace sazare::runs {

/// What the water of a case does to its elements; nothing where there is none. Outer faces with a boundary, a blast or a charge
/// have no water before them. `joints` must outlive it.
std::unique_ptr<methods::blocks::WaterLoads> make_water(const cases::BlocksCase& blocks, const MeshFaces& faces,
                                                        const methods::blocks::BondedFaces& joints, const state::Bodies<3>& bodies);

}  // namespace sazare::runs
