#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>

#include "sazare/cases/clocks.hpp"
#include "sazare/cases/explanation.hpp"
#include "sazare/cases/fields.hpp"
#include "sazare/methods/blocks/case/explain_charge.hpp"
#include "sazare/methods/blocks/case/fields.hpp"
#include "sazare/methods/blocks/case/format.hpp"

namespace sazare::cases {
namespace {

std::string axes_text(const std::array<bool, 3>& axes) {
  std::string out;
  for (std::size_t i = 0; i < 3; ++i)
    if (axes[i]) out += fmt::format("{}{}", out.empty() ? "" : " ", static_cast<char>('x' + i));
  return out.empty() ? "none" : out;
}

/// One topic of the explanation; further lines of the same topic are indented below the first.
class Explanation {
public:
  void add(std::string_view topic, const std::string& line) {
    out_ += fmt::format("  {:<12}{}\n", topic == last_ ? "" : topic, line);
    last_ = topic;
  }
  /// Lines that have their topics.
  void add(const std::string& lines) { out_ += lines; }
  void more(const std::string& line) { out_ += fmt::format("  {:<12}  {}\n", "", line); }
  std::string take(const std::string& title) { return title + "\n" + out_; }

private:
  std::string out_;
  std::string last_;
};

void explain_body(Explanation& text, const BlocksCase& blocks) {
  const Mesh& mesh = blocks.mesh;
  std::string how = mesh.scale == 1 ? "" : fmt::format(", coordinates times {}", number(mesh.scale));
  if (mesh.is_geometry()) {
    how += ", meshed by gmsh";
    if (mesh.size_factor != 1) how += fmt::format(", element sizes times {}", number(mesh.size_factor));
    for (const auto& [name, value] : mesh.parameters) how += fmt::format(", {} = {}", name, number(value));
  }
  text.add("mesh", mesh.file.filename().string() + how);
  for (const Material& material : blocks.materials)
    text.add("materials",
             fmt::format("{}: {} kg/m3{}, regions {}", material.name, number(material.density),
                         material.has_moduli()
                             ? fmt::format(", E {} Pa, nu {}, {} elements", number(*material.youngs_modulus),
                                           number(*material.poisson_ratio), material.deformable ? "deformable" : "rigid")
                             : "",
                         fmt::join(material.regions, ", ")));
}

/// The law with what it takes beside the strengths; nothing of a law that takes no more.
void explain_law(Explanation& text, const Joint& joint) {
  laws::visit_joint_law(joint.law, [&]<class Law>(Law) {
    std::vector<std::string> own;
    for (const laws::LawParameter& parameter : Law::parameters)
      if (const auto& value = joint.law_parameter(parameter.name))
        own.push_back(
            fmt::format("{} {}{}{}", parameter.name, number(*value), parameter.unit.empty() ? "" : " ", parameter.unit));
    if (!own.empty()) text.more(fmt::format("law {}: {}", Law::word, fmt::join(own, ", ")));
  });
}

/// How a bonded joint fails.
void explain_strength(Explanation& text, const Joint& joint) {
  const Real broken = 2 * joint.fracture_energy / joint.tensile_strength;
  const std::string opening =
      joint.has_stiffness() ? fmt::format(" at an opening of {} m", number(joint.tensile_strength / *joint.normal_stiffness))
                            : "";
  text.more(fmt::format("tension: elastic to {}{}, broken at {} m ({} J/m2)", stress_text(joint.tensile_strength), opening,
                        number(broken), number(joint.fracture_energy)));
  text.more(fmt::format("shear: slips at {} + {} times the pressure (friction angle {} deg)", stress_text(joint.cohesion),
                        number(joint.friction_coefficient),
                        number(std::atan(joint.friction_coefficient) * 180 / std::numbers::pi)));
  if (joint.weibull_modulus) {
    const std::vector<Real> factors = joint.strength_factors();
    text.more(fmt::format("strengths and energies scatter: Weibull modulus {}, {} to {} times these, seed {}",
                          number(*joint.weibull_modulus), number(factors.front()), number(factors.back()), joint.scatter_seed));
  }
  if (joint.follows_rate())
    text.more(
        fmt::format("strengths grow with the strain rate, {}: times {} at 1/s, {} at 10/s, {} at 100/s; energies by the power {} "
                    "of that",
                    word(joint.by_rate.law), number(joint.by_rate.factor(1)), number(joint.by_rate.factor(10)),
                    number(joint.by_rate.factor(100)), number(joint.by_rate.energy_exponent)));
}

/// What follows from the numbers of a natural joint.
void explain_natural(Explanation& text, const Joint& joint) {
  constexpr Real degrees = 180 / std::numbers::pi;
  const auto own = laws::own_parameters<laws::JointLaws, laws::BartonBandis>(joint.law_parameters);
  struct {
    Real normal_stiffness = 1, shear_stiffness = 1;
  } const springs;
  const auto rough = laws::BartonBandis::shear(springs, own);
  std::vector<std::string> friction;
  for (const Real pressure : {1e5, 1e6, 1e7})
    friction.push_back(fmt::format("{} deg under {}",
                                   number(std::atan(laws::rough_strength(rough, pressure, 1) / pressure) * degrees, 3),
                                   stress_text(pressure)));
  text.more(fmt::format("natural: JRC {} and JCS {} at its length, friction angle {} deg at first and at the peak {}",
                        number(laws::BartonBandis::roughness_of(own), 3), stress_text(rough.wall_strength),
                        number(rough.residual_angle * degrees, 3), fmt::join(friction, ", ")));
  text.more(fmt::format("peak at a slip of {} m", number(rough.peak_slip, 3)));
  const Real closure = laws::BartonBandis::closure_of(own);
  text.more(closure > 0 ? fmt::format("closes by up to {} m, at first with {} Pa/m", number(closure, 3),
                                      number(laws::BartonBandis::initial_stiffness_of(own), 3))
                        : "does not close but by its springs");
}

void explain_joint(Explanation& text, const Joint& joint) {
  const std::string where =
      joint.on_surface() ? "on surface " + joint.surface : fmt::format("between {} and {}", joint.between[0], joint.between[1]);
  text.add("joints", fmt::format("{}: {}{}", joint.name, where, joint.bonded ? "" : ", never bonded"));
  if (!joint.bonded) return;
  if (joint.is_natural())
    explain_natural(text, joint);
  else
    explain_strength(text, joint);
  explain_law(text, joint);
  const std::string springs = joint.has_stiffness() ? fmt::format("springs {} and {} Pa/m", number(*joint.normal_stiffness),
                                                                  number(*joint.shear_stiffness))
                                                    : std::string("springs of the elements beside each face");
  const std::string dashpots =
      joint.damping_ratio ? fmt::format("damping ratio {}", number(*joint.damping_ratio))
                          : fmt::format("dashpots {} and {} Pa s/m", number(joint.normal_damping), number(joint.shear_damping));
  text.more(fmt::format("{}, {} (normal, shear)", springs, dashpots));
  const bool is_damped = joint.damping_ratio ? *joint.damping_ratio > 0 : joint.shear_damping > 0;
  if (joint.on_surface() && !joint.is_natural() && is_damped)
    text.more(fmt::format("where it slides, its shear dashpot bears stress beside its strength{}",
                          joint.damping_ratio ? "" : fmt::format(": {} at 1 m/s", stress_text(joint.shear_damping))));
}

void explain_contact(Explanation& text, const Contact& contact) {
  if (contact.shape == ContactShape::faces) {
    text.add("contact", "true faces");
    text.more(fmt::format("spring {} Pa/m, dashpot {} Pa s/m (cap: {}), friction {}", number(contact.face_stiffness),
                          number(contact.face_damping), word(contact.damping_cap), number(contact.friction_coefficient)));
    if (contact.normal_stiffness > 0)
      text.more(
          "contact_stiffness and contact_damping are of spheres behind the faces, which touch the surface of a coupled run "
          "alone");
    return;
  }
  const int spheres = (contact.edge_division - 1) * (contact.edge_division - 2) / 2;
  text.add("contact", fmt::format("{} spheres on each free face (edge_division {})", spheres, contact.edge_division));
  text.more(fmt::format("spring {} N/m, dashpot {} N s/m (cap: {}), friction {}", number(contact.normal_stiffness),
                        number(contact.normal_damping), word(contact.damping_cap), number(contact.friction_coefficient)));
}

void explain_blast(Explanation& text, const Blast& blast) {
  std::string pressure;
  Real duration = 0, peak = 0;
  if (const auto* pulse = std::get_if<PressurePulse>(&blast.pressure)) {
    peak = pulse->peak_pressure;
    duration = pulse->rise_time * (1 + pulse->decay_ratio);
    pressure = fmt::format("{} after {} s, zero again after {} s", stress_text(peak), number(pulse->rise_time), number(duration));
  } else if (const auto* table = std::get_if<PressureTable>(&blast.pressure)) {
    pressure = fmt::format("{} rows of {}, to {} s", table->time.size(), table->file.filename().string(),
                           table->time.empty() ? "0" : number(table->time.back()));
  } else {
    pressure = "a function of time, given in Python";
  }
  text.add("blasts", fmt::format("{}: on surface {} from {} s: {}", blast.name, blast.surface, number(blast.delay), pressure));
  if (std::isfinite(blast.cut_distance))
    text.more(fmt::format("ends on a face once its displacement is {} m", number(blast.cut_distance)));
}

void explain_charges(Explanation& text, const std::vector<Charge>& charges) {
  for (std::size_t i = 0; i < charges.size(); ++i) {
    const std::vector<std::string> lines = charge_lines(charges[i], i);
    text.add("charges", lines.front());
    for (std::size_t line = 1; line < lines.size(); ++line) text.more(lines[line]);
    if (std::isfinite(charges[i].cut_distance))
      text.more(fmt::format("the gas leaves a face once its displacement is {} m", number(charges[i].cut_distance)));
  }
}

void explain_initial_stress(Explanation& text, const InitialStress& stress) {
  if (stress.is_zero()) return;
  if (stress.k0) {
    text.add("initial", fmt::format("weight of the ground below {} m, horizontal stress {} of the vertical", number(stress.datum),
                                    number(*stress.k0)));
    return;
  }
  text.add("initial",
           fmt::format("stress xx yy zz {} Pa, xy yz zx {} Pa", vector_text(stress.normal), vector_text(stress.shear)));
  if (!stress.normal_per_depth.isZero(0) || !stress.shear_per_depth.isZero(0))
    text.more(fmt::format("and per metre below {} m {} Pa, {} Pa", number(stress.datum), vector_text(stress.normal_per_depth),
                          vector_text(stress.shear_per_depth)));
}

void explain_conditions(Explanation& text, const BlocksCase& blocks) {
  for (const Blast& blast : blocks.blasts) explain_blast(text, blast);
  explain_charges(text, blocks.charges);
  if (!blocks.gravity.acceleration.isZero()) text.add("gravity", vector_text(blocks.gravity.acceleration) + " m/s2");
  text.add(explain_water(blocks.water, blocks.gravity));
  explain_initial_stress(text, blocks.initial_stress);
  if (blocks.settles()) text.add("settles", "before the run begins, until it is in equilibrium");
  text.add(explain_motions(blocks.motions, blocks.time.end));
  for (const Boundary& boundary : blocks.boundaries)
    text.add("boundaries", fmt::format("{}: {}{}", boundary.surface, word(boundary.kind), motion_names_text(boundary.motion, boundary.kind == BoundaryKind::absorbing)));
  for (const Constraint& constraint : blocks.constraints)
    text.add("locked", fmt::format("{}: translation {}, rotation {}", fmt::join(constraint.regions, ", "),
                                   axes_text(constraint.translation), axes_text(constraint.rotation)));
  for (const InitialVelocity& velocity : blocks.initial_velocities)
    text.add("moving", fmt::format("{}: {} m/s", fmt::join(velocity.regions, ", "), vector_text(velocity.velocity)));
  for (const Gauge& gauge : blocks.gauges) text.add("gauges", fmt::format("{}: {} m", gauge.name, vector_text(gauge.point)));
}

void explain_time(Explanation& text, const Time& time) {
  const auto count = [&](Real interval) { return whole_multiple(time.end, interval).value_or(0); };
  const std::string base = time.base_step ? number(*time.base_step) + " s" : "chosen from the stability limits";
  text.add("time", fmt::format("to {} s, {} history rows, {} snapshots", number(time.end), count(time.history_interval),
                               count(time.snapshot_interval)));
  const std::string limiter = time.limiter == Limiter::stability
                                  ? fmt::format("{} of the stability limit of each element", number(time.stability_fraction))
                              : time.limiter == Limiter::travel
                                  ? fmt::format("travel of at most {} m in a step", number(time.travel_length))
                                  : std::string("the base step for all");
  text.more(fmt::format("steps: {}; largest {}", limiter, base));
  text.more(time.levels == Levels::uniform
                ? std::string("all elements have the finest level that any element needs")
                : fmt::format("a level for each element, differing by at most {} where linked", time.neighbor_levels));
  text.more(fmt::format("steps above the stability limit are {}", time.strict ? "refused" : "allowed with a warning"));
}

}  // namespace

std::string explain(const BlocksCase& blocks) {
  Explanation text;
  explain_body(text, blocks);
  for (const Joint& joint : blocks.joints) explain_joint(text, joint);
  explain_contact(text, blocks.contact);
  explain_conditions(text, blocks);
  explain_time(text, blocks.time);
  text.add("checkpoint", fmt::format("every {} s of wall-clock time", number(blocks.output.checkpoint_interval)));
  return text.take(blocks.title);
}

}  // namespace sazare::cases
