#pragma once

#include "sazare/methods/fem/members/members.hpp"
#include "sazare/methods/fem/run/mesh_names.hpp"

namespace sazare::runs {

/// The members of a case. Throws UserError where they do not fit the mesh.
std::vector<methods::fem::MemberSet> make_members(const cases::CaseFile& file, const geometry::ElementMesh& mesh,
                                                  const MeshNames& names);

}  // namespace sazare::runs
