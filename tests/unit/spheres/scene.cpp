#include <algorithm>
#include <cmath>

#include "scene.hpp"

namespace sazare::methods::spheres {

ContactTable table(const Rules& rules) {
  ContactTable contacts(rules.model, 1);
  const laws::MaterialsInContact materials{
      soft, soft, rules.restitution, {rules.friction, rules.rolling, rules.twisting}};
  contacts.set(0, 0, laws::visit_law(rules.model, [&]<class Law>(Law) {
    if constexpr (std::is_same_v<Law, laws::Linear>)
      return Law::constants(materials, {1e5, 8e4});
    else if constexpr (std::is_same_v<Law, laws::Jkr>)
      return Law::constants(materials, {rules.surface_energy});
    else
      return Law::constants(materials, {});
  }));
  return contacts;
}

methods::spheres::SphereStepper make_stepper(const std::vector<Grain>& grains, const Rules& rules, std::vector<Wall> walls) {
  state::Spheres spheres;
  spheres.box = rules.box;
  for (const Grain& grain : grains) {
    spheres.add(grain.centre, grain.radius, 2500, 0);
    spheres.set_motion(spheres.size() - 1, grain.velocity, grain.spin);
  }
  return {std::move(spheres), table(rules), std::move(walls), {rules.step, rules.gravity, rules.margin, 5e-3, rules.level}};
}

std::vector<Grain> heap(int across, Real speed, Real spacing) {
  std::uint64_t state = 5;
  const auto random = [&] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<Real>(state >> 11) / 4503599627370496.0 - 1;
  };
  const auto random_vector = [&] {  // drawn one after the other: compilers evaluate the arguments of a call in different orders
    const Real z = random(), y = random(), x = random();
    return Vector3(x, y, z);
  };
  std::vector<Grain> grains;
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < across; ++j)
      for (int k = 0; k < across; ++k) {
        Grain grain;
        grain.centre = spacing * Vector3(i, j, k) + Vector3(0.02, 0.02, 0.02);
        grain.radius = 0.009 + 0.001 * random();
        grain.velocity = speed * random_vector();
        grain.spin = 20 * speed * random_vector();
        grains.push_back(grain);
      }
  return grains;
}

std::vector<std::int8_t> levels_by_radius(const std::vector<Grain>& grains) {
  Real largest = 0;
  for (const Grain& grain : grains) largest = std::max(largest, grain.radius);
  std::vector<std::int8_t> level;
  for (const Grain& grain : grains)
    level.push_back(static_cast<std::int8_t>(std::ceil(std::log2(largest / grain.radius) - 1e-9)));
  return level;
}

std::size_t place_of(const methods::spheres::SphereStepper& stepper, Index number) {
  const auto& numbers = stepper.spheres().number;
  return static_cast<std::size_t>(std::ranges::find(numbers, number) - numbers.begin());
}

}  // namespace sazare::methods::spheres
