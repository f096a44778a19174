#pragma once

/// Still water of a case on the faces of its mesh.

#include "sazare/methods/fem/body.hpp"
#include "sazare/methods/fem/run/mesh_names.hpp"
#include "sazare/methods/fem/supports.hpp"

namespace sazare::runs {

/// Throws UserError where a group or joint cannot have such water.
template <int D>
std::vector<methods::fem::StillWater<D>> make_waters(const cases::CaseFile& file, const methods::fem::BodyDescription& body,
                                                     const MeshNames& names);

/// Warns of water that wets nothing; with time.strict it is refused.
template <int D>
std::string warn_of_dry_water(const cases::CaseFile& file, const std::vector<methods::fem::StillWater<D>>& waters);

/// Warns of faces of saturated ground that nothing holds and no water presses: the pores push them out.
template <int D>
std::string warn_of_free_pores(const cases::CaseFile& file, const methods::fem::BodyDescription& body,
                               const methods::fem::Supports<D>& supports, const MeshNames& names);

}  // namespace sazare::runs
