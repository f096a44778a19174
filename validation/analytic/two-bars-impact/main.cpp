#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/networks.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

constexpr Real length = 10, modulus = 1, density = 1, area = 1, speed = 0.1;
constexpr Real gap = 0.01;  // the bars meet at gap / (2 speed)

/// A bar along x: a chain of equal masses in the middle of their segments.
void add_bar(test::Network<2>& network, int masses, Real from, Real velocity) {
  const Vector<2> centre = Vector<2>::Zero();
  const Real segment = length / masses;
  for (int i = 0; i < masses; ++i) {
    const Vector<2> place(from + (i + 0.5) * segment, 0);
    const Index body = state::add_body(network.bodies, density * area * segment, place, 1.0, 0.0);
    network.bodies.motion.back().velocity.x() = velocity;
    if (i > 0) network.springs.push_back({body - 1, body, centre, centre, segment, modulus * area / segment, 0, 0});
  }
}

/// Between the last mass of the left bar and the first of the right one: only pushes.
terms::Spring<2> contact(int left, int right) {
  const Real rest = 0.5 * length / left + 0.5 * length / right;
  return {left - 1, left, Vector<2>::Zero(), Vector<2>::Zero(), rest, modulus * area / rest, 0, 1};
}

test::Network<2> two_bars(int left, int right) {
  test::Network<2> network;
  add_bar(network, left, -length, speed);
  add_bar(network, right, gap, -speed);
  network.springs.push_back(contact(left, right));
  return network;
}

class Bars {
public:
  Bars(int left_masses, int right_masses, const levels::StepRules& rules)
      : left_(left_masses),
        right_(right_masses),
        contact_(contact(left_masses, right_masses)),
        simulation_(two_bars(left_masses, right_masses).simulation(rules)) {
    simulation_.start();
  }

  levels::Simulation<2>& simulation() { return simulation_; }

  /// Force between the bars [N].
  Real contact_force(const levels::Snapshot<2>& at) const {
    const auto place = [&](Index body) { return at.pose[static_cast<std::size_t>(body)].position.x(); };
    return std::max(0.0, contact_.stiffness * (contact_.length - (place(contact_.second) - place(contact_.first))));
  }

  /// Mean velocity of a bar.
  Real velocity(bool right) const {
    const auto at = simulation_.snapshot();
    Real sum = 0;
    const Index first = right ? left_ : 0, count = right ? right_ : left_;
    for (Index body = first; body < first + count; ++body) sum += at.velocity[static_cast<std::size_t>(body)].x();
    return sum / count;
  }

private:
  Index left_, right_;
  terms::Spring<2> contact_;
  levels::Simulation<2> simulation_;
};

/// Collides the bars and prints when they part, the force between them and their motion afterwards.
void print_impact(const std::string& name, int left, int right, bool mixed) {
  levels::StepRules rules;
  const int finest = std::max(left, right);
  rules.base_step = (mixed ? 4.0 : 1.0) * 0.1 * length / finest;  // a tenth of what a wave takes over the finest segment
  rules.stability = mixed;
  rules.stability_fraction = 0.1;
  Bars bars(left, right, rules);
  const Real meets = gap / (2 * speed);
  Real parts = 0, force = 0, energy = 0;
  int samples = 0;
  const Real initial_energy = density * area * length * speed * speed;
  while (bars.simulation().now().seconds() < meets + 30) {
    bars.simulation().advance();
    const auto at = bars.simulation().snapshot();
    const Real since = bars.simulation().now().seconds() - meets, now = bars.contact_force(at);
    if (now > 0) parts = since;
    if (since > 2 && since < 18) {
      force += now;
      ++samples;
    }
    energy = std::max(energy, std::abs(test::mechanical(bars.simulation().energy_balance(at))) / initial_energy);
  }
  const auto print = [&](const char* row, Real value) { validation::print_row((name + "-" + row).c_str(), value); };
  print("contact-ends", parts);
  print("force", force / samples);
  print("rebound-left", bars.velocity(false));
  print("rebound-right", bars.velocity(true));
  print("energy", energy);
  const auto [lowest, highest] = test::level_range(bars.simulation());
  print("levels", highest - lowest);
}

}  // namespace

int main() {
  print_impact("one-level", 400, 400, false);
  print_impact("mixed", 100, 400, true);
}
