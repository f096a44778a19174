#include "sazare/methods/spheres/run/pieces.hpp"

namespace sazare::runs {

std::int64_t broken_bodies(const methods::spheres::BondedBodies& bodies) {
  std::int64_t broken = 0;
  for (std::size_t body = 0; body < bodies.count(); ++body) broken += bodies.is_whole(body) ? 0 : 1;
  return broken;
}

std::int64_t count_pieces(const methods::spheres::BondedBodies& bodies) {
  std::int64_t count = 0;
  for (std::size_t body = 0; body < bodies.count(); ++body) {
    const auto range = bodies.spheres(static_cast<Index>(body));
    for (Index sphere = range.begin; sphere < range.end; ++sphere) count += bodies.piece(sphere) == sphere ? 1 : 0;
  }
  return count;
}

std::vector<std::int32_t> body_numbers(const SpheresModel& model) {
  std::vector<std::int32_t> numbers(model.body.begin(), model.body.end());
  const methods::spheres::BondedBodies& bodies = model.stepper->bodies();
  if (bodies.empty()) return numbers;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (const Index body = bodies.of(static_cast<Index>(i)); body >= 0)
      numbers[i] = static_cast<std::int32_t>(model.clumps) + body;
  return numbers;
}

std::vector<Fragment> measure_pieces(const SpheresModel& model) {
  const methods::spheres::SphereStepper& stepper = *model.stepper;
  const state::Spheres& spheres = stepper.spheres();
  std::vector<std::size_t> place(spheres.size()), fragment_of(spheres.size());
  for (std::size_t i = 0; i < place.size(); ++i) place[static_cast<std::size_t>(spheres.number[i])] = i;
  std::vector<Fragment> fragments;
  std::vector<Vector3> moved;
  for (std::size_t number = 0; number < place.size(); ++number) {
    const Index piece = stepper.bodies().piece(static_cast<Index>(number));
    if (piece < 0) continue;
    if (static_cast<std::size_t>(piece) == number) {
      fragment_of[number] = fragments.size();
      fragments.emplace_back();
      moved.emplace_back(Vector3::Zero());
    }
    const std::size_t f = fragment_of[static_cast<std::size_t>(piece)], i = place[number];
    const state::SpherePlace& sphere = spheres.place[i];
    Fragment& fragment = fragments[f];
    ++fragment.elements;
    fragment.volume += sphere.mass / model.density[static_cast<std::size_t>(spheres.spin[i].material)];
    fragment.mass += sphere.mass;
    fragment.center += sphere.mass * sphere.centre();
    fragment.velocity += sphere.mass * stepper.velocity(i);
    moved[f] += sphere.mass * (sphere.centre() - model.placed[number]);
  }
  finish_fragments(fragments, moved);
  return fragments;
}

}  // namespace sazare::runs
