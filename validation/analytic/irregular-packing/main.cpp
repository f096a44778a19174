#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

#include "sazare/geometry/plane/voronoi.hpp"
#include "sazare/methods/rectangles/stable_step.hpp"
#include "sazare/parallel/threads.hpp"
#include "tests/support/blocks_of_squares.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
using geometry::Vector2;
using methods::rectangles::FaceKind;
constexpr Real modulus = 1e8, spacing = 0.1;
constexpr int across = 40;  // elements along a side of the block whose stiffness is measured

/// Stresses or strains: xx, yy, and xy (of strains twice that).
using Voigt = Eigen::Matrix<Real, 3, 1>;
using Stiffness = Eigen::Matrix<Real, 3, 3>;

struct Sample {
  test::Scene scene;
  std::vector<Vector2> nuclei;
  std::vector<char> at_edge;
  Real strained_area = 0;  ///< half of the sum of all faces times distances [m2]
};

std::vector<Vector2> rectangle(Real width, Real height) { return {{0, 0}, {width, 0}, {width, height}, {0, height}}; }

Sample packed(Real width, Real height, Real size, int seed, const FaceKind& kind) {
  Sample sample;
  sample.nuclei = geometry::scatter_nuclei(rectangle(width, height), size, seed);
  const auto packing = methods::rectangles::pack(sample.nuclei, rectangle(width, height), 2000);
  for (const geometry::Faces outside : packing.outside) sample.at_edge.push_back(outside != 0 ? 1 : 0);
  for (const auto& facet : packing.facets) sample.strained_area += facet.half_face * facet.distance;
  sample.scene.kinds = {kind};
  sample.scene.contact = {modulus, modulus, 0.3, 0.5, 1};
  sample.scene.add_packing(packing, 0);
  return sample;
}

/// Squares with the stiffnesses of (25).
Sample lattice(Real normal, Real shear) {
  Sample sample;
  sample.scene.kinds = {test::square_faces(spacing / 2, normal, shear, 5, laws::FaceFormula::exact)};
  sample.scene.contact = {modulus, modulus, 0.3, 0.5, 1};
  sample.scene.add_lattice(across, across, spacing / 2, {0, 0}, 0);
  for (int row = 0; row < across; ++row)
    for (int column = 0; column < across; ++column) {
      sample.nuclei.emplace_back((column + 0.5) * spacing, (row + 0.5) * spacing);
      sample.at_edge.push_back(row % (across - 1) == 0 || column % (across - 1) == 0 ? 1 : 0);
    }
  sample.strained_area = across * (across - 1) * spacing * spacing;
  return sample;
}

Real stable_limit(test::Scene& scene) {
  const auto holder = scene.make(1);
  return stable_step(scene.particles(), scene.forces->outlines(), scene.forces->links(), scene.contact, false).limit;
}

/// The mean stress when the edge follows a uniform strain and all else has come to rest.
Voigt stress_of(Sample sample, const Voigt& strain, Real limit) {
  sample.scene.make(1);
  auto& particles = sample.scene.particles();
  for (std::size_t i = 0; i < sample.nuclei.size(); ++i) {
    const Vector2& x = sample.nuclei[i];
    particles.displacement[0][i] = strain[0] * x.x() + 0.5 * strain[2] * x.y();
    particles.displacement[1][i] = 0.5 * strain[2] * x.x() + strain[1] * x.y();
    for (int freedom = 0; freedom < 3 && sample.at_edge[i] != 0; ++freedom)
      sample.scene.supports.held.push_back({static_cast<Index>(i), freedom});
  }
  auto stepper = sample.scene.make(0.7 * limit);
  stepper->relax({1e-6 * strain.norm() * modulus / (2000 * spacing), 20000});
  state::FreedomColumns<2> acceleration;
  for (auto& column : acceleration) column.resize(stepper->particles().padded());
  sample.scene.forces->evaluate(stepper->particles(), acceleration);
  Voigt stress = Voigt::Zero();
  for (std::size_t i = 0; i < sample.nuclei.size(); ++i) {
    const Vector2 force = Vector2(acceleration[0][i], acceleration[1][i]) / stepper->particles().inverse_mass[i],
                  &x = sample.nuclei[i];
    stress -= Voigt(force.x() * x.x(), force.y() * x.y(), 0.5 * (force.x() * x.y() + force.y() * x.x()));
  }
  return stress / sample.strained_area;
}

Stiffness stiffness_of(Sample sample) {
  const Real limit = stable_limit(sample.scene);
  Stiffness stiffness;
  for (int i = 0; i < 3; ++i) stiffness.col(i) = stress_of(sample, 1e-6 * Voigt::Unit(i), limit) / 1e-6;
  return stiffness;
}

struct Elastic {
  Real youngs_modulus = 0, poisson_ratio = 0;
};

/// In plane strain, of a bar cut out along a direction.
Elastic along(const Stiffness& stiffness, Real angle) {
  const Real c = std::cos(angle), s = std::sin(angle);
  const Voigt strain = stiffness.inverse() * Voigt(c * c, s * s, c * s);
  const Real longitudinal = strain.dot(Voigt(c * c, s * s, c * s)), lateral = strain.dot(Voigt(s * s, c * c, -c * s));
  const Real ratio = -lateral / longitudinal, poisson = ratio / (1 + ratio);
  return {(1 - poisson * poisson) / longitudinal, poisson};
}

struct Directions {
  Elastic mean;
  Real spread = 0;  ///< of Young's modulus, largest less smallest over the mean
};

Directions all_directions(const Stiffness& stiffness) {
  Directions found;
  Real least = 1e300, most = 0;
  constexpr int count = 12;
  for (int i = 0; i < count; ++i) {
    const Elastic elastic = along(stiffness, std::numbers::pi * i / count);
    found.mean.youngs_modulus += elastic.youngs_modulus / count;
    found.mean.poisson_ratio += elastic.poisson_ratio / count;
    least = std::min(least, elastic.youngs_modulus);
    most = std::max(most, elastic.youngs_modulus);
  }
  found.spread = (most - least) / found.mean.youngs_modulus;
  return found;
}

Directions packing_of(Real poisson_ratio, int seed) {
  const auto springs = methods::rectangles::facet_stiffness(modulus, poisson_ratio);
  const Real side = across * spacing;
  return all_directions(stiffness_of(packed(side, side, spacing, seed, test::facets_of(springs.normal, springs.shear, 5))));
}

/// The largest unbalanced force in a uniform strain that all elements follow, k_s = k_n, over stress times size.
Real unbalance() {
  const Real side = across * spacing;
  Sample sample = packed(side, side, spacing, 1, test::facets_of(modulus, modulus, 5));
  auto stepper = sample.scene.make(1e-5);
  auto& particles = sample.scene.particles();
  constexpr Real xx = 1e-7, yy = -2e-7, xy = 3e-7;
  for (std::size_t i = 0; i < sample.nuclei.size(); ++i) {
    particles.displacement[0][i] = xx * sample.nuclei[i].x() + xy * sample.nuclei[i].y();
    particles.displacement[1][i] = xy * sample.nuclei[i].x() + yy * sample.nuclei[i].y();
  }
  state::FreedomColumns<2> acceleration;
  for (auto& column : acceleration) column.resize(particles.padded());
  sample.scene.forces->evaluate(particles, acceleration);
  Real worst = 0;
  for (std::size_t i = 0; i < sample.nuclei.size(); ++i)
    for (std::size_t axis = 0; axis < 2 && sample.at_edge[i] == 0; ++axis)
      worst = std::max(worst, std::abs(acceleration[axis][i] / particles.inverse_mass[i]) / (3e-7 * modulus * spacing));
  return worst;
}

/// Tension through the links that cross a line of equal x, which elements have first from the left.
Real load_through(const methods::rectangles::FaceLinks& links, const state::Particles<2>& particles, Real x) {
  Real load = 0;
  for (Index number = 0; number < links.count(); ++number) {
    const auto& link = links.link(number);
    const auto at = [&](Index element) { return particles.start[0][static_cast<std::size_t>(element)]; };
    if (links.is_padding(number) || (at(link.first) < x) == (at(link.second) < x)) continue;
    load += (at(link.first) < x ? -1 : 1) * links.force_of(number)[0];
  }
  return load;
}

/// The largest load of a bar that is pulled until it breaks, over strength times cross-section.
Real bar_strength(int seed) {
  constexpr Real length = 4, height = 1, strength = 1e5, end = 0.5;
  Sample sample = packed(length, height, spacing / 2, seed, test::facets_of(modulus, modulus, 5, strength, 0.3));
  sample.scene.kinds[0].springs.cohesion_limit = 1e300;
  const Real limit = stable_limit(sample.scene), speed = 3 * strength / modulus * length / end;
  laws::GroundMotion motion;
  motion.shape = laws::GroundMotion::Shape::record;
  motion.quantity = laws::MotionQuantity::velocity;
  motion.record = laws::Record::make(end, {0, speed});  // a soft start: no wave matters
  sample.scene.supports.motions = {motion};
  for (std::size_t i = 0; i < sample.nuclei.size(); ++i) {
    const auto own = static_cast<Index>(i);
    const Real x = sample.nuclei[i].x();
    if (x > spacing / 2 && x < length - spacing / 2) continue;
    sample.scene.supports.driven.push_back({own, 0, 0, x / length});  // as in a uniform strain
    for (int freedom = 1; freedom < 3; ++freedom) sample.scene.supports.held.push_back({own, freedom});
  }
  auto stepper = sample.scene.make(0.7 * limit);
  stepper->start();
  Real peak = 0, load = 0;
  while (stepper->time() < 0.99 * end && (load >= 0.5 * peak || peak < 0.3 * strength * height)) {
    for (int i = 0; i < 20; ++i) stepper->advance();
    load = load_through(sample.scene.forces->links(), stepper->particles(), length / 4);
    peak = std::max(peak, load);
  }
  return peak / (strength * height);
}

}  // namespace

int main() {
  parallel::set_threads(1);
  validation::print_row("unbalance", unbalance());
  const Directions exact = packing_of(0, 1);
  validation::print_row("modulus-0", exact.mean.youngs_modulus / modulus);
  validation::print_row("spread-0", exact.spread);
  validation::print_row("poisson-0", exact.mean.poisson_ratio);
  const Directions usual = packing_of(0.2, 1);
  validation::print_row("modulus-0.2", usual.mean.youngs_modulus / modulus);
  validation::print_row("poisson-0.2", usual.mean.poisson_ratio);
  validation::print_row("spread-0.2", usual.spread);
  constexpr Real nu = 0.2, normal = (1 - nu) * modulus / ((1 + nu) * (1 - 2 * nu));
  validation::print_row("lattice-spread-0.2",
                        all_directions(stiffness_of(lattice(normal, (1 - 2 * nu) * normal / (2 * (1 - nu))))).spread);
  Real least = 1e300, most = 0, mean = 0;
  constexpr int bars = 5;
  for (int seed = 1; seed <= bars; ++seed) {
    const Real found = bar_strength(seed);
    least = std::min(least, found);
    most = std::max(most, found);
    mean += found / bars;
  }
  validation::print_row("bar-strength", mean);
  validation::print_row("bar-spread", (most - least) / mean);
}
