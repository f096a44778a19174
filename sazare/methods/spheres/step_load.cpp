#include "sazare/methods/spheres/step_load.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <numeric>

#include "sazare/laws/granular_contact.hpp"

namespace sazare::methods::spheres {

namespace {

constexpr std::size_t looked_at_closely = 200;

using Matrix6 = Eigen::Matrix<Real, 6, 6>;
using Vector6 = Eigen::Matrix<Real, 6, 1>;

/// h^2 k + 4 h c of a contact, by the way in which it is strained [kg].
struct Strengths {
  Real along = 0, across = 0, rolling = 0, twisting = 0;  ///< the last two times a length squared [kg m2]
};

class Sum {
public:
  Sum(const LoadedBodies& bodies, const ContactTable& table) : bodies_(bodies), table_(table) {}

  /// By body: what no eigenvalue exceeds, the sum of all of them.
  std::vector<Real> traces(const ContactVisit& visit) const {
    std::vector<Real> sum(bodies_.clumps.clumps.size() + bodies_.spheres.size(), 0);
    visit([&](const ContactPoint& at) {
      const Strengths strengths = strengths_of(at);
      for_both(at, [&](std::size_t sphere, const Vector3& normal, Real times) {
        sum[body_of(sphere)] += times * trace_of(at, sphere, normal, strengths);
      });
    });
    return sum;
  }

  /// The largest eigenvalue of each of these bodies.
  std::vector<Real> eigenvalues(const ContactVisit& visit, std::span<const std::size_t> which) const {
    std::vector<Index> number(bodies_.clumps.clumps.size() + bodies_.spheres.size(), -1);
    for (std::size_t n = 0; n < which.size(); ++n) number[which[n]] = static_cast<Index>(n);
    std::vector<Matrix6> sum(which.size(), Matrix6::Zero());
    visit([&](const ContactPoint& at) {
      for_both(at, [&](std::size_t sphere, const Vector3& normal, Real times) {
        const Index found = number[body_of(sphere)];
        if (found < 0) return;
        Matrix6& own = sum[static_cast<std::size_t>(found)];
        ways(sphere, normal, arm(at, sphere), strengths_of(at),
             [&](Real strength, const Vector6& way) { own += times * strength * way * way.transpose(); });
      });
    });
    std::vector<Real> largest;
    for (const Matrix6& own : sum)
      largest.push_back(Eigen::SelfAdjointEigenSolver<Matrix6>(own, Eigen::EigenvaluesOnly).eigenvalues()[5]);
    return largest;
  }

  std::size_t body_of(std::size_t sphere) const {
    const Index clump = bodies_.clump_of.empty() ? -1 : bodies_.clump_of[sphere];
    return clump >= 0 ? static_cast<std::size_t>(clump) : bodies_.clumps.clumps.size() + sphere;
  }

private:
  const state::Clump* clump_of(std::size_t sphere) const {
    const Index clump = bodies_.clump_of.empty() ? -1 : bodies_.clump_of[sphere];
    return clump < 0 ? nullptr : &bodies_.clumps.clumps[static_cast<std::size_t>(clump)];
  }
  bool is_held(std::size_t sphere) const {
    return clump_of(sphere) == nullptr && !(bodies_.spheres.kick[sphere].inverse_mass > 0);
  }

  /// Calls a function for both bodies of a contact that move.
  template <class Visit>
  void for_both(const ContactPoint& at, Visit&& visit) const {
    const bool moves = !is_held(at.first), other_moves = !at.is_at_wall() && !is_held(at.second);
    const Real times = moves && other_moves ? 2 : 1;
    if (moves) visit(at.first, at.normal, times);
    if (other_moves) visit(at.second, -at.normal, times);
  }

  /// The trace of what a contact adds to the matrix of a sphere's body.
  Real trace_of(const ContactPoint& at, std::size_t sphere, const Vector3& normal, const Strengths& strengths) const {
    if (clump_of(sphere) == nullptr) {
      const auto& kick = bodies_.spheres.kick[sphere];
      const Real length = arm(at, sphere);
      return kick.inverse_mass * (strengths.along + 2 * strengths.across) +
             kick.inverse_inertia * (2 * length * length * strengths.across + 2 * strengths.rolling + strengths.twisting);
    }
    Real sum = 0;
    ways(sphere, normal, arm(at, sphere), strengths, [&](Real strength, const Vector6& way) { sum += strength * way.squaredNorm(); });
    return sum;
  }

  /// From the centre of a sphere to the contact [m].
  Real arm(const ContactPoint& at, std::size_t sphere) const {
    return bodies_.spheres.place[sphere].radius - 0.5 * at.overlap;
  }

  Strengths strengths_of(const ContactPoint& at) const {
    const state::Spheres& spheres = bodies_.spheres;
    const auto material = [&](std::size_t sphere) { return static_cast<Index>(spheres.spin[sphere].material); };
    const auto &one = spheres.place[at.first], &other = spheres.place[at.second];
    const bool is_wall = at.is_at_wall();
    using laws::Reduced;
    const auto radius = is_wall ? Reduced<Real>::alone(one.radius) : Reduced<Real>::of(one.radius, other.radius),
               mass = is_wall ? Reduced<Real>::alone(one.mass) : Reduced<Real>::of(one.mass, other.mass);
    const auto& constants = table_.of(material(at.first), is_wall ? at.wall_material : material(at.second));
    return laws::visit_law(table_.model, [&]<class Law>(Law) {
      const Real width = Law::width(constants, at.overlap, radius);
      const auto damping = laws::dashpots(constants, width, std::sqrt(width * mass.value()), at.step);
      const Real squared = at.step * at.step, along = squared * Law::steepness * constants.normal * width + 4 * at.step * damping.normal,
                 across = squared * constants.tangential * width + 4 * at.step * damping.tangential,
                 turning = radius.value() * radius.value() * across;
      return Strengths{along, constants.friction > 0 ? across : 0, constants.rolling > 0 ? turning : 0,
                       constants.twisting > 0 ? turning : 0};
    });
  }

  /// Calls a function with each way in which a contact is strained by the motion of a sphere's body, in units in which that has mass
  /// and inertia 1.
  template <class Visit>
  void ways(std::size_t sphere, const Vector3& normal, Real arm, const Strengths& strengths, Visit&& visit) const {
    const Vector3 across = normal.unitOrthogonal(), other = normal.cross(across);
    const state::Clump* const clump = clump_of(sphere);
    const auto way_of = [&](const Vector3& along, const Vector3& turning) {
      Vector6 way;
      if (clump == nullptr) {
        way << std::sqrt(bodies_.spheres.kick[sphere].inverse_mass) * along,
            std::sqrt(bodies_.spheres.kick[sphere].inverse_inertia) * turning;
        return way;
      }
      const Vector3 own = clump->into(turning);
      way << along / std::sqrt(clump->mass), own.cwiseQuotient(clump->inertia.cwiseSqrt());
      return way;
    };
    Vector3 point = arm * normal;  // from the centre of the body
    if (clump != nullptr) point += bodies_.spheres.place[sphere].centre() - clump->centre;
    const auto strain = [&](Real strength, const Vector3& along) {
      if (strength > 0) visit(strength, way_of(along, point.cross(along)));
    };
    const auto turn = [&](Real strength, const Vector3& axis) {
      if (strength > 0) visit(strength, way_of(Vector3::Zero(), axis));
    };
    strain(strengths.along, normal);
    strain(strengths.across, across);
    strain(strengths.across, other);
    turn(strengths.rolling, across);
    turn(strengths.rolling, other);
    turn(strengths.twisting, normal);
  }

  LoadedBodies bodies_;
  const ContactTable& table_;
};

/// A sphere of a body.
Index number_of(const LoadedBodies& bodies, std::size_t body) {
  if (body < bodies.clumps.clumps.size()) return bodies.clumps.members_of(body).front().sphere;
  return bodies.spheres.number[body - bodies.clumps.clumps.size()];
}

bool is_looked_at(const LoadedBodies& bodies, std::size_t body) {
  if (!bodies.is_own) return true;
  const std::size_t clumps = bodies.clumps.clumps.size();
  if (body >= clumps) return bodies.is_own(body - clumps);
  return bodies.is_own(static_cast<std::size_t>(bodies.place[static_cast<std::size_t>(number_of(bodies, body))]));
}

}  // namespace

std::vector<HeavyLoad> heaviest_loads(const LoadedBodies& bodies, const ContactTable& table, const ContactVisit& visit) {
  const Sum sum(bodies, table);
  const std::vector<Real> traces = sum.traces(visit);
  std::vector<std::size_t> which;
  for (std::size_t body = 0; body < traces.size(); ++body)
    if (is_looked_at(bodies, body)) which.push_back(body);
  const auto count = std::min(looked_at_closely, which.size());
  const auto end = which.begin() + static_cast<std::ptrdiff_t>(count);
  std::ranges::nth_element(which, end, [&](std::size_t a, std::size_t b) {
    return traces[a] != traces[b] ? traces[a] > traces[b] : number_of(bodies, a) < number_of(bodies, b);
  });
  which.resize(count);
  const std::vector<Real> largest = sum.eigenvalues(visit, which);
  std::vector<HeavyLoad> loads;
  for (std::size_t n = 0; n < count; ++n) loads.push_back({traces[which[n]], {largest[n] / 4, number_of(bodies, which[n])}});
  return loads;
}

StepLoad largest_step_load(std::vector<HeavyLoad> loads) {
  std::ranges::sort(
      loads, [](const HeavyLoad& a, const HeavyLoad& b) { return a.sum != b.sum ? a.sum > b.sum : a.of.sphere < b.of.sphere; });
  if (loads.size() > looked_at_closely) loads.resize(looked_at_closely);
  StepLoad result;
  for (const HeavyLoad& one : loads)
    if (one.of.load > result.load) result = one.of;
  return result;
}

}  // namespace sazare::methods::spheres
