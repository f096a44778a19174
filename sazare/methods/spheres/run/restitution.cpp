#include "sazare/methods/spheres/run/restitution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/laws/granular/impact.hpp"
#include "sazare/methods/spheres/case/case.hpp"

namespace sazare::runs {

namespace {

using cases::SpheresCase;
using laws::Reduced;

constexpr Real most_error = 0.02;  // of a coefficient of restitution

/// Two materials in contact, their smallest sphere against another one like it or a wall.
struct Impact {
  std::string one, other;
  laws::ContactConstants<Real> constants;
  Real restitution = 1;
  Reduced<Real> radius = Reduced<Real>::alone(1);
  Real mass = 0;  ///< reduced [kg]
  Real step = 0;  ///< [s]

  Real rebound(laws::ContactModel model, Real speed, Real shorter = 1) const {
    return laws::visit_law(model, [&]<class Law>(Law) {
      return laws::worst_rebound<Law>(constants, restitution, radius, mass, speed, shorter * step);
    });
  }
  bool holds(laws::ContactModel model, Real speed, Real shorter = 1) const {
    return std::abs(rebound(model, speed, shorter) - restitution) <= most_error * restitution;
  }
};

/// The lightest sphere of each material, by its place at the start.
std::map<Index, std::size_t> lightest(const state::Spheres& spheres) {
  std::map<Index, std::size_t> found;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const auto at = found.try_emplace(static_cast<Index>(spheres.spin[i].material), i).first;
    if (spheres.place[i].mass < spheres.place[at->second].mass) at->second = i;
  }
  return found;
}

Real restitution_of(const SpheresCase& spheres, const std::string& one, const std::string& other) {
  for (const cases::MaterialPair& pair : spheres.pairs)
    if ((pair.between[0] == one && pair.between[1] == other) || (pair.between[0] == other && pair.between[1] == one))
      return pair.restitution.value_or(spheres.contact.restitution);
  return spheres.contact.restitution;
}

Real step_of(const SpheresModel& model, std::size_t sphere) {
  return model.steps.level.empty() ? model.steps.step : std::ldexp(model.steps.step, -model.steps.level[sphere]);
}

std::vector<Impact> impacts(const SpheresCase& spheres, const SpheresModel& model) {
  const state::Spheres& placed = model.stepper->spheres();
  const methods::spheres::ContactTable& table = model.stepper->walls().table();
  std::vector<Impact> all;
  const auto add = [&](Index one, Index other, Impact impact) {
    impact.one = spheres.materials[static_cast<std::size_t>(one)].name;
    impact.other = spheres.materials[static_cast<std::size_t>(other)].name;
    impact.constants = table.of(one, other);
    impact.restitution = restitution_of(spheres, impact.one, impact.other);
    all.push_back(impact);
  };
  const std::map<Index, std::size_t> found = lightest(placed);
  for (const auto& [material, sphere] : found) {
    const auto& own = placed.place[sphere];
    for (const auto& [other_material, other_sphere] : found) {
      if (other_material < material || placed.size() < 2) continue;
      const auto& other = placed.place[other_sphere];
      Impact impact;
      impact.radius = Reduced<Real>::of(own.radius, other.radius);
      impact.mass = Reduced<Real>::of(own.mass, other.mass).value();
      impact.step = std::min(step_of(model, sphere), step_of(model, other_sphere));
      add(material, other_material, impact);
    }
    for (const auto& wall : model.stepper->walls().walls()) {
      Impact impact;
      impact.radius = Reduced<Real>::alone(own.radius);
      impact.mass = own.mass;
      impact.step = step_of(model, sphere);
      add(material, wall.material, impact);
    }
  }
  return all;
}

/// How fast spheres may hit something: as they move at the start, as they fall from the highest sphere to the lowest thing, and
/// as walls come towards them.
struct ExpectedSpeed {
  Real initial = 0;  ///< [m/s]
  Real fall = 0;     ///< gravity times height [m2/s2]
  Real walls = 0;    ///< [m/s]

  Real all() const { return std::sqrt(initial * initial + 2 * fall) + walls; }

  std::string text() const {
    std::string causes;
    const auto add = [&](Real speed, const char* cause) {
      if (speed > 0) causes += fmt::format("{}{} {} m/s", causes.empty() ? "" : ", ", cause, cases::short_number(speed, 3));
    };
    add(initial, "initial velocity");
    add(std::sqrt(2 * fall), "fall");
    add(walls, "motion of walls");
    return fmt::format("{} m/s ({})", cases::short_number(all(), 3), causes);
  }
};

/// Half the square of the speed of what falls onto the water, or sinks in it. `highest` is gravity times height [m2/s2].
Real fall_in_water(const SpheresCase& spheres, const SpheresModel& model, Real highest) {
  const methods::spheres::WaterForces& water = model.stepper->water();
  const auto& placed = model.stepper->spheres();
  Real fastest = 0;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const Real density = spheres.materials[static_cast<std::size_t>(placed.spin[i].material)].density;
    fastest = std::max(fastest, water.largest_steady_speed(placed.number[i], density));
  }
  return std::max(highest - water.water().gravity * water.water().level, 0.5 * fastest * fastest);
}

ExpectedSpeed expected_speed(const SpheresCase& spheres, const SpheresModel& model) {
  const Vector3 gravity = spheres.gravity.acceleration;
  ExpectedSpeed speed;
  Real highest = -std::numeric_limits<Real>::infinity(), lowest = -highest, extent = 0;
  const auto& placed = model.stepper->spheres();
  for (const auto& place : placed.place) {
    speed.initial = std::max(speed.initial, place.velocity().norm());
    const Real height = -place.centre().dot(gravity);
    highest = std::max(highest, height);
    lowest = std::min(lowest, height);
    extent = std::max(extent, place.centre().norm() + place.radius);
  }
  for (const auto& wall : model.stepper->walls().walls()) {
    if (wall.is_plane() && wall.normal.dot(gravity) < 0) lowest = std::min(lowest, -wall.point.dot(gravity));
    for (const auto& triangle : wall.triangles)
      for (const Vector3& corner : triangle) lowest = std::min(lowest, -corner.dot(gravity));
  }
  speed.fall = std::max(highest - lowest, Real{0});
  if (!model.stepper->water().empty()) speed.fall = std::min(speed.fall, fall_in_water(spheres, model, highest));
  speed.walls = model.stepper->walls().largest_speed(extent);
  return speed;
}

/// The largest of the speeds 10^(n/20) m/s up to which an impact rebounds as asked for; 0 where it never does. Impacts are looked
/// at from slow to fast, since slower ones than the first that is off are right, but not all faster ones are off.
Real holds_up_to(const Impact& impact, laws::ContactModel model, Real fastest) {
  const auto speed = [](int n) { return std::pow(Real{10}, n / Real{20}); };
  int n = static_cast<int>(std::floor(20 * std::log10(std::max(1e-4 * fastest, std::numeric_limits<Real>::min()))));
  if (!impact.holds(model, speed(n))) return 0;
  while (speed(n + 1) < fastest && impact.holds(model, speed(n + 1))) ++n;
  return speed(n);
}

/// By how much the step is to be shortened for an impact; 0 where a thousandth does not do.
Real shorter_step(const Impact& impact, laws::ContactModel model, Real speed) {
  for (Real shorter = 0.5; shorter > 1e-3; shorter *= 0.5)
    if (impact.holds(model, speed, shorter)) return shorter;
  return 0;
}

}  // namespace

std::string warn_of_restitution(const cases::CaseFile& file, const SpheresModel& model) {
  const auto& spheres = file.as<SpheresCase>();
  const laws::ContactModel law = spheres.contact.model;
  if (laws::visit_law(law, []<class Law>(Law) { return Law::adheres; })) return "";  // adhesion takes energy besides
  const ExpectedSpeed expected = expected_speed(spheres, model);
  const Real fastest = expected.all();
  if (!(fastest > 0) || !std::isfinite(fastest)) return "";
  const Impact* worst = nullptr;
  Real worst_error = most_error, found = 0;
  const std::vector<Impact> all = impacts(spheres, model);
  for (const Impact& impact : all) {
    const Real rebound = impact.rebound(law, fastest), error = std::abs(rebound - impact.restitution) / impact.restitution;
    if (error <= worst_error) continue;
    worst = &impact;
    worst_error = error;
    found = rebound;
  }
  if (worst == nullptr) return "";
  const Real holds = holds_up_to(*worst, law, fastest), shorter = shorter_step(*worst, law, fastest),
             share = model.steps.smallest() / model.steps.limit;
  if (!std::isfinite(found))
    refuse(
        file, "contact.restitution",
        fmt::format("an impact between \"{}\" and \"{}\" at {} has no end with this step: the lightest sphere of both is far too "
                    "light for its stiffness",
                    worst->one, worst->other, expected.text()),
        "check the masses and radii of the smallest spheres, or set a smaller time.step");
  const std::string what = fmt::format(
      "the restitution between \"{}\" and \"{}\" will be {} instead of {} at {}, which this case may reach; with this step it is "
      "{}",
      worst->one, worst->other, cases::short_number(found, 3), cases::short_number(worst->restitution, 3), expected.text(),
      holds > 0 ? fmt::format("right within 2 % up to {} m/s", cases::short_number(holds, 2))
                : "off by more than 2 % at lower speeds too");
  const std::string help = shorter > 0 ? fmt::format("set time.stability_fraction = {} for faster impacts",
                                                     cases::short_number(0.95 * shorter * share, 2))
                                       : "give the spheres stiffer contacts, or a restitution that such an impact can have";
  if (spheres.time.strict) refuse(file, "contact.restitution", what, help);
  return warning(file, "contact.restitution", what, help);
}

}  // namespace sazare::runs
