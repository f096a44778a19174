#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/spheres/case/case.hpp"
#include "sazare/methods/spheres/run/model.hpp"
#include "sazare/methods/spheres/run/placing/clump_shape.hpp"
#include "sazare/registry/registry.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

cases::CaseFile read(const std::string& name) { return registry::read_case("validation/analytic/bonded-bodies/" + name + ".toml"); }

void walk(methods::spheres::SphereStepper& stepper, Real end) {
  stepper.start();
  while (stepper.time() < end) stepper.advance();
  stepper.evaluate_now();
}

/// Mass, momentum and angular momentum of a tetrapod as of the rigid body of the same shape, at the start and after a flight.
void flight() {
  const cases::CaseFile file = read("tetrapod");
  const cases::SphereGroup& group = file.as<cases::SpheresCase>().spheres.front();
  const runs::Shape shape = runs::make_shape(file, 0);
  runs::SpheresModel model = runs::build_spheres(file);
  methods::spheres::SphereStepper& stepper = *model.stepper;
  Real mass = 0;
  for (const auto& place : stepper.spheres().place) mass += place.mass;
  const Real density = file.as<cases::SpheresCase>().materials.front().density;
  validation::print_row("mass", mass, density * shape.volume);
  const Matrix3 turn = Eigen::AngleAxis<Real>(group.rotation.norm(), group.rotation.normalized()).toRotationMatrix() * shape.axes;
  const Vector3 spin = turn * (density * shape.inertia).cwiseProduct(turn.transpose() * group.spin),
                rigid = mass * group.centre.cross(group.velocity) + spin;
  stepper.start();
  stepper.evaluate_now();
  const Vector3 momentum = stepper.momentum(), turning = stepper.angular_momentum();
  const Real energy = stepper.energies().sum();
  validation::print_row("momentum", (momentum - mass * group.velocity).norm() / momentum.norm());
  validation::print_row("angular-momentum", (turning - rigid).norm() / spin.norm());
  while (stepper.time() < file.as<cases::SpheresCase>().time.end) stepper.advance();
  stepper.evaluate_now();
  validation::print_row("momentum-kept", (stepper.momentum() - momentum).norm() / momentum.norm());
  validation::print_row("angular-momentum-kept", (stepper.angular_momentum() - turning).norm() / turning.norm());
  validation::print_row("energy-kept", std::abs(stepper.energies().sum() - energy) / energy);
}

/// How far the end of a bar goes down under its own weight: Timoshenko's beam with the masses of its spheres at its nodes.
void cantilever() {
  const cases::CaseFile file = read("bar");
  const cases::BondRules& bond = file.as<cases::SpheresCase>().bonds.front();
  runs::SpheresModel model = runs::build_spheres(file);
  methods::spheres::SphereStepper& stepper = *model.stepper;
  const auto& place = stepper.spheres().place;
  const Real radius = place.front().radius, area = std::numbers::pi * radius * radius,
             second_moment = 0.25 * area * radius * radius, poisson = *bond.poisson_ratio;
  const Real bending = *bond.youngs_modulus * second_moment,
             shear = 6 * (1 + poisson) / (7 + 6 * poisson) * *bond.youngs_modulus / (2 * (1 + poisson)) * area;
  Real end = 0, sag = 0, found = 0;
  for (const auto& sphere : place) end = std::max(end, sphere.x);
  for (const auto& sphere : place)  // the clamp stands at 0
    sag += sphere.mass * 9.81 * (sphere.x * sphere.x * (3 * end - sphere.x) / (6 * bending) + sphere.x / shear);
  walk(stepper, file.as<cases::SpheresCase>().time.end);
  for (std::size_t i = 0; i < place.size(); ++i)
    found = std::max(found, model.placed[static_cast<std::size_t>(stepper.spheres().number[i])].z() - place[i].z);
  validation::print_row("sag", found, sag);
}

struct Parting {
  bool broke = false;
  Real contact_energy = 0;  ///< most that contacts held, over the energy at the start
  Real gained = 0;          ///< most that the energy of motion rose above that of the start, over it
};

/// The two halves of a pair part at a speed.
Parting part(Real speed) {
  const cases::CaseFile file = read("pair");
  runs::Placement placement = runs::place_spheres(file);
  for (std::size_t i = 0; i < 2; ++i)
    placement.spheres.set_motion(i, {(placement.spheres.place[i].x > 0 ? 0.5 : -0.5) * speed, 0, 0}, Vector3::Zero());
  const runs::SpheresModel model = runs::build_spheres(file);
  const methods::spheres::SphereStepper& built = *model.stepper;
  methods::spheres::SphereStepper stepper(placement.spheres, built.levels().pairs(0).table(), {}, built.rules(), built.bonds(), {},
                                built.bodies());
  stepper.start();
  const Real energy = stepper.energies().sum();
  Parting parting;
  while (stepper.time() < file.as<cases::SpheresCase>().time.end) {
    stepper.advance();
    stepper.evaluate_now();
    const methods::spheres::SphereEnergies now = stepper.energies();
    parting.contact_energy = std::max(parting.contact_energy, now.elastic / energy);
    parting.gained = std::max(parting.gained, (now.translation + now.rotation) / energy - 1);
  }
  parting.broke = stepper.broken_bonds() > 0;
  return parting;
}

/// The speed above which the pair breaks: its energy of relative motion stretches the bond to its strength.
void parting_speed() {
  const cases::CaseFile file = read("pair");
  const cases::BondRules& bond = file.as<cases::SpheresCase>().bonds.front();
  const runs::Placement placement = runs::place_spheres(file);
  const auto& place = placement.spheres.place;
  const Real length = (place[1].centre() - place[0].centre()).norm(), area = std::numbers::pi * place[0].radius * place[0].radius,
             reduced = place[0].mass * place[1].mass / (place[0].mass + place[1].mass);
  const Real expected = *bond.tensile_strength * std::sqrt(area * length / (*bond.youngs_modulus * reduced));
  Real whole = 0.5 * expected, broken = 2 * expected;
  while (broken - whole > 1e-4 * expected) {
    const Real middle = 0.5 * (whole + broken);
    (part(middle).broke ? broken : whole) = middle;
  }
  validation::print_row("parting-speed", 0.5 * (whole + broken), expected);
  const Parting fast = part(1.5 * expected);
  validation::print_row("contact-energy", fast.contact_energy);
  validation::print_row("energy-gained", fast.gained);
}

}  // namespace

int main() {
  flight();
  cantilever();
  parting_speed();
}
