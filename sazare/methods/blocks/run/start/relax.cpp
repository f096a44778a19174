#include "sazare/methods/blocks/run/start/relax.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/format/counted.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/methods/blocks/run/failure.hpp"
#include "sazare/runs/progress.hpp"

namespace sazare::runs {

namespace {

using cases::number;

constexpr Real relaxed_share = 1e-5;   // of forces that mean something, as other methods have it
constexpr Real creeping_share = 1e-4;  // what slides close to its strength creeps for long
constexpr std::int64_t most_steps = 200'000;
constexpr std::int64_t look_interval = 20;  // base steps

/// Area of a face of an element, the mean of the four [m2].
Real face_area(const geometry::Tetrahedron& corners) {
  Real sum = 0;
  for (int face = 0; face < 4; ++face) sum += geometry::face_area_vector(corners, face).norm();
  return sum / 4;
}

/// Largest initial stress of any element [Pa].
Real largest_stress(const laws::LinearStress& stress, const state::Bodies<3>& bodies) {
  Real largest = 0;
  for (const Vector3& centre : bodies.start) largest = std::max(largest, stress.at(centre).norm());
  return largest;
}

/// By element: its weight and the force of the initial stress on a face of it, to which what is left is compared. Nothing less
/// can be told than by how much its springs change with the last digit of its place [N].
std::vector<Real> meaningful_forces(const cases::BlocksCase& blocks, const BlocksModel& model) {
  const state::Bodies<3>& bodies = model.simulation->bodies();
  const Real gravity = blocks.gravity.acceleration.norm(), stress = largest_stress(blocks.stress_at_start(), bodies);
  std::vector<Real> forces;
  for (Index element = 0; element < bodies.size(); ++element) {
    const Real mass = bodies.inertia[at(element)].mass, step = model.stable_step[at(element)];
    const Real last_digit = 4 * std::numeric_limits<Real>::epsilon() * bodies.start[at(element)].norm();
    const Real stiffness = std::isfinite(step) ? 4 * mass / (step * step) : 0;
    forces.push_back(mass * gravity + stress * face_area(geometry::corners_of(model.mesh, element)) +
                     stiffness * last_digit / relaxed_share);
  }
  return forces;
}

Real extent_of(const geometry::TetraMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vector3& node : mesh.nodes) box.extend(node);
  return box.diagonal().norm();
}

/// A simulation on its way to the equilibrium.
class Relaxation {
public:
  Relaxation(const cases::BlocksCase& blocks, BlocksModel& model, const RunOptions& options)
      : model_(model),
        simulation_(*model.simulation),
        options_(options),
        meaningful_(meaningful_forces(blocks, model)),
        extent_(extent_of(model.mesh)) {}

  bool run() {
    std::vector<Vector3> velocity;
    for (const auto& motion : simulation_.bodies().motion) velocity.push_back(motion.velocity);
    if (!options_.quiet) fmt::print("finding the equilibrium before the run begins\n");
    std::fflush(stdout);
    simulation_.relax();
    simulation_.stand();
    simulation_.start();
    if (!go_to_equilibrium()) return false;
    begin_time(velocity);
    return true;
  }

private:
  bool must_stop() const {
    const bool asked = options_.stop.is_made();
    const parallel::Ranks* ranks = options_.sharing.ranks;
    return ranks == nullptr ? asked : ranks->from_first(asked ? 1 : 0) != 0;
  }

  bool go_to_equilibrium() {
    const auto pause = [&] { return options_.sharing.ranks == nullptr && must_stop(); };
    Progress progress(options_.quiet, state(0));
    left_ = simulation_.largest_unbalance(meaningful_);
    first_ = left_.share;
    Real before = 0;
    for (std::int64_t step = 1; left_.share > relaxed_share; ++step) {
      if (!simulation_.approach(pause)) return false;
      const Real kinetic = simulation_.kinetic_energy();
      const bool is_past_peak = kinetic < before;
      if (is_past_peak) simulation_.stand();
      before = is_past_peak ? 0 : kinetic;
      simulation_.arrive();
      if (is_past_peak) left_ = simulation_.largest_unbalance(meaningful_);
      if (step % look_interval == 0) {
        if (must_stop()) return false;
        refuse_what_moves_away();
      }
      if (step == most_steps) return accept_creep();
      first_ = std::max(first_, left_.share);
      if (progress.is_due()) progress.show(state(std::log(first_ / left_.share) / std::log(first_ / relaxed_share)));
    }
    return true;
  }

  /// What is left falls by about the same factor in equal times.
  ProgressState state(Real share) const {
    return {share, 0, simulation_.counters().pair_evaluations, simulation_.levels().step(simulation_.levels().finest()),
            model_.joints->broken_count()};
  }

  void refuse_what_moves_away() {
    std::vector<Index> away;
    const state::Bodies<3>& bodies = simulation_.bodies();
    for (Index element = 0; element < bodies.size(); ++element)
      if (simulation_.owns(element) && !(moved(element) <= std::max(2 * bodies.reach[at(element)], 0.01 * extent_)))
        away.push_back(element);
    simulation_.unite(away);
    if (away.empty()) return;
    throw PhysicsError(fmt::format(
        "no equilibrium: {} {} moved away while the equilibrium was sought, as element {} at {} m\n"
        "  nothing holds {}: check [[boundaries]], [[constraints]] and the strength of the joints, of which {} broke, or run the "
        "case "
        "without settle to see how it moves",
        cases::counted(std::ssize(away), "elements"), away.size() == 1 ? "has" : "have", element_tag(model_.mesh, away.front()),
        cases::vector_text(bodies.start[at(away.front())]), away.size() == 1 ? "it" : "them", model_.joints->broken_count()));
  }

  Real moved(Index element) const {
    const state::Bodies<3>& bodies = simulation_.bodies();
    return (bodies.motion[at(element)].position - bodies.start[at(element)]).norm();
  }

  bool accept_creep() const {
    const std::string after =
        fmt::format("after {} base steps a force is left on element {} that is {} of what acts there, {} is required", most_steps,
                    element_tag(model_.mesh, left_.body), number(left_.share, 3), number(relaxed_share));
    if (left_.share > creeping_share)
      throw PhysicsError(
          fmt::format("no equilibrium: {}\n"
                      "  the body is not stable, or hardly held: check [[boundaries]] and the strength of the joints",
                      after));
    if (!options_.quiet) fmt::print("the equilibrium is all but reached: {}\n", after);
    return true;
  }

  /// At the next base step. What the first of several processes writes down needs all elements.
  void begin_time(std::span<const Vector3> velocity) {
    simulation_.approach();
    simulation_.collect();
    std::vector<Index> changed;
    if (model_.boundaries != nullptr) changed = model_.boundaries->let_go(simulation_.bodies());
    for (const auto& motion : simulation_.bodies().motion) model_.equilibrium.push_back(motion.position);
    simulation_.stand(velocity);
    simulation_.begin_time(changed);
  }

  BlocksModel& model_;
  levels::Simulation<3>& simulation_;
  const RunOptions& options_;
  std::vector<Real> meaningful_;  ///< by element [N]
  Real extent_ = 0;               ///< of the body [m]
  levels::Unbalance left_;        ///< when all stood still last
  Real first_ = 0;                ///< the largest share that was left
};

}  // namespace

bool relax(const cases::BlocksCase& blocks, BlocksModel& model, const RunOptions& options) {
  return Relaxation(blocks, model, options).run();
}

std::string warn_of_relaxation(const cases::CaseFile& file, const BlocksModel& model) {
  const Index broken = model.joints->broken_count();
  if (broken == 0) return "";
  return warning(file, file.as<cases::BlocksCase>().gravity.settle ? "gravity.settle" : "initial_stress.settle",
                 fmt::format("{} broke while the equilibrium was sought: the stress is beyond their strength",
                             cases::counted(broken, "joints")),
                 "the run begins with these cracks; raise the strength or lower the stress where they should not be there");
}

}  // namespace sazare::runs
