#include "validation/common/body_modes.hpp"

#include <map>
#include <vector>

namespace sazare::validation {

namespace {

/// A checkpoint in which the motion of the bodies is set.
class SetMotion final : public Archive {
public:
  explicit SetMotion(levels::Simulation<3>& simulation) : simulation_(simulation) { simulation.columns(*this); }

  void set(const std::vector<state::Motion<3>>& motion, const std::vector<state::Strain>& strain) {
    reading_ = true;
    put("motion", std::as_bytes(std::span(motion)));
    if (!strain.empty()) put("strain", std::as_bytes(std::span(strain)));
    simulation_.columns(*this);
  }
  bool reading() const override { return reading_; }

protected:
  void write(const std::string& name, std::span<const std::byte> bytes) override {
    columns_[name].assign(bytes.begin(), bytes.end());
  }
  std::vector<std::byte> read(const std::string& name) override { return columns_.at(name); }

private:
  void put(const std::string& name, std::span<const std::byte> bytes) { columns_[name].assign(bytes.begin(), bytes.end()); }

  levels::Simulation<3>& simulation_;
  std::map<std::string, std::vector<std::byte>> columns_;
  bool reading_ = false;
};

/// Gradient of the velocity of a mode at a place [1/s].
Matrix3 gradient_of(const Mode& mode, const Vector3& place) {
  constexpr Real step = 1e-4;  // [m]
  Matrix3 gradient;
  for (int axis = 0; axis < 3; ++axis)
    gradient.col(axis) =
        (mode(place + step * Vector3::Unit(axis)).first - mode(place - step * Vector3::Unit(axis)).first) / (2 * step);
  return gradient;
}

}  // namespace

void set_motion(levels::Simulation<3>& simulation, const Mode& mode) {
  SetMotion start(simulation);
  auto motion = simulation.bodies().motion;
  auto strain = simulation.bodies().strain;
  for (std::size_t body = 0; body < motion.size(); ++body) {
    const auto [velocity, spin] = mode(motion[body].position);
    const Vector3 moments = simulation.bodies().inertia[body].inverse_moments.cwiseInverse();
    motion[body].velocity = 1e-3 * velocity;
    motion[body].spin = 1e-3 * spin;
    const Matrix3 rotation = motion[body].rotation;
    if (!strain.empty())
      strain[body].rate = 1e-3 * numbers_of(rotation.transpose() * gradient_of(mode, motion[body].position) * rotation);
    motion[body].angular_momentum = rotation * moments.asDiagonal() * rotation.transpose() * motion[body].spin;
  }
  start.set(motion, strain);
}

Real half_period(levels::Simulation<3>& simulation, const Mode& mode,
                 const std::function<void(const levels::Snapshot<3>&)>& look) {
  constexpr std::size_t half_periods = 4;
  constexpr Real longest = 0.1;  // s
  set_motion(simulation, mode);
  const auto component = [&](const levels::Snapshot<3>& at) {
    Real sum = 0;
    for (std::size_t body = 0; body < at.velocity.size(); ++body)
      sum += simulation.bodies().inertia[body].mass * at.velocity[body].dot(mode(simulation.bodies().start[body]).first);
    return sum;
  };
  simulation.start();
  std::vector<Real> crossings;
  Real before = component(simulation.snapshot());
  while (crossings.size() <= half_periods && simulation.now().seconds() < longest) {
    simulation.advance();
    const auto at = simulation.snapshot();
    const Real now = component(at);
    const Real since_crossing = simulation.levels().step(0) * now / (now - before);
    if (before * now < 0) crossings.push_back(simulation.now().seconds() - since_crossing);
    before = now;
    look(at);
  }
  return (crossings.at(half_periods) - crossings.at(0)) / half_periods;
}

}  // namespace sazare::validation
