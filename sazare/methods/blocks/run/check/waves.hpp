#pragma once

/// How fast waves run through the elements of a case.

#include <string>

#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/run/model.hpp"

namespace sazare::runs {

/// The springs of a joint as an elastic body; that of the material where its moduli are given. Modulus 0 where they stand for
/// none.
laws::ElasticModuli elastic_body_at(const BlocksModel& model, Index joint, const cases::Material& material);

/// [m]
Real longest_edge(const geometry::TetraMesh& mesh, Index element);

/// Lines for each material: speeds of P and S waves; where the stiffness of joints is given per area, how they spread over the
/// mesh.
std::string describe_waves(const cases::BlocksCase& blocks, const BlocksModel& model);

}  // namespace sazare::runs
