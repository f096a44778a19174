#include "validation/common/body_modes.hpp"

#include <map>
#include <vector>

namespace sazare::validation {

namespace {

/// A checkpoint in which the motion of the bodies is set.
class SetMotion final : public Archive {
public:
  explicit SetMotion(levels::Simulation<3>& simulation) : simulation_(simulation) { simulation.columns(*this); }

  void set(std::vector<state::Motion<3>> motion) {
    reading_ = true;
    const auto bytes = std::as_bytes(std::span(motion));
    columns_["motion"].assign(bytes.begin(), bytes.end());
    simulation_.columns(*this);
  }
  bool reading() const override { return reading_; }

protected:
  void write(const std::string& name, std::span<const std::byte> bytes) override {
    columns_[name].assign(bytes.begin(), bytes.end());
  }
  std::vector<std::byte> read(const std::string& name) override { return columns_.at(name); }

private:
  levels::Simulation<3>& simulation_;
  std::map<std::string, std::vector<std::byte>> columns_;
  bool reading_ = false;
};

}  // namespace

void set_motion(levels::Simulation<3>& simulation, const Mode& mode) {
  SetMotion start(simulation);
  auto motion = simulation.bodies().motion;
  for (std::size_t body = 0; body < motion.size(); ++body) {
    const auto [velocity, spin] = mode(motion[body].position);
    const Vector3 moments = simulation.bodies().inertia[body].inverse_moments.cwiseInverse();
    motion[body].velocity = 1e-3 * velocity;
    motion[body].spin = 1e-3 * spin;
    const Matrix3 rotation = motion[body].rotation;
    motion[body].angular_momentum = rotation * moments.asDiagonal() * rotation.transpose() * motion[body].spin;
  }
  start.set(motion);
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
