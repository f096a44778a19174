#include "sazare/methods/blocks/run/check/process_zone.hpp"

#include <fmt/format.h>

#include <limits>

#include "sazare/cases/explanation.hpp"
#include "sazare/methods/blocks/run/check/waves.hpp"

namespace sazare::runs {
namespace {

struct Found {
  Real softest = std::numeric_limits<Real>::infinity();  ///< Young's modulus [Pa]
  Real longest = 0;                                      ///< edge of an element [m]
};

std::string text_of(const cases::Joint& joint, const Found& found) {
  const Real zone = found.softest * joint.fracture_energy / (joint.tensile_strength * joint.tensile_strength);
  return fmt::format("{}: process zone E G/s_t^2 of {} m, edges of elements up to {} m{}", joint.name, cases::number(zone, 3),
                     cases::number(found.longest, 3),
                     found.longest > zone ? ": longer ones do not resolve the stress at the tip of a crack" : "");
}

}  // namespace

std::string describe_process_zones(const cases::BlocksCase& blocks, const BlocksModel& model) {
  std::vector<Found> found(blocks.joints.size());
  for (Index joint = 0; joint < model.joints->count(); ++joint) {
    const auto& record = model.joints->record(joint);
    Found& own = found[at(model.kinds.entry[at(record.kind)])];
    const cases::Material& material = blocks.materials[at(model.material[at(record.master)])];
    own.softest = std::min(own.softest, elastic_body_at(model, joint, material).young);
    for (const Index element : {record.master, record.slave})
      own.longest = std::max(own.longest, longest_edge(model.mesh, element));
  }
  std::string text;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (blocks.joints[i].bonded && !blocks.joints[i].is_natural() && found[i].softest > 0 && found[i].longest > 0)
      text += cases::line(text.empty() ? "cracks" : "", text_of(blocks.joints[i], found[i]));
  return text;
}

}  // namespace sazare::runs
