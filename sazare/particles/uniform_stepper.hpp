#pragma once

/// Walks in equal steps: all particles at once, by one of three integrators.

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "sazare/laws/rayleigh_damping.hpp"
#include "sazare/particles/particle_forces.hpp"
#include "sazare/particles/particle_supports.hpp"

namespace sazare::particles {

/// How a step goes, with a(x, v) the acceleration; [Yoshida2010], section 2.
enum class Integrator {
  verlet,        ///< x(k+1) = x(k) + (x(k) - x(k-1)) + dt^2 a(k)                            (8)
  leapfrog,      ///< v(k+1/2) = v(k-1/2) + dt a(k), then x(k+1) = x(k) + dt v(k+1/2)        (4), (5)
  euler,         ///< x(k+1) = x(k) + dt v(k), then v(k+1) = v(k) + dt a(x(k), v(k))         (2), (3)
  euler_lagged,  ///< the same, with the damping force of the step before: (A24) as it is printed
};

inline bool is_euler(Integrator integrator) { return integrator == Integrator::euler || integrator == Integrator::euler_lagged; }

struct UniformRules {
  Real step = 0;  ///< dt [s]
  Integrator integrator = Integrator::verlet;
  laws::RayleighDamping damping;
};

struct RelaxationRules {
  Real tolerance = 0;  ///< largest acceleration left in equilibrium [m/s2]
  std::int64_t most_steps = 0;
  /// Asked after every step with the largest acceleration left: whether to go on.
  std::function<bool(std::int64_t step, Real left)> goes_on = [](std::int64_t, Real) { return true; };
};

/// Work on the particles since the beginning by what is not a force between them [J; J/m in 2-D].
struct WorkByCause {
  Real gravity = 0;
  Real boundary = 0;    ///< viscous boundaries and the waves that come in through them
  Real prescribed = 0;  ///< supports that move as histories say, and damping as far as it carries bodies along with their base
  Real damping = 0;     ///< Rayleigh damping, on the motion relative to the base: what it takes is negative
  Real applied = 0;     ///< forces applied from outside

  Real sum() const { return gravity + boundary + prescribed + damping + applied; }
};

/// The damping of a particle follows from its ratio h. Its part a2 h K v is a2 h (g(k) - g(k-1))/dt, g the elastic acceleration:
/// one stored vector per particle, (A24). In Euler's step, where x(k+1) is known before v(k+1), it is the difference g(k+1) -
/// g(k), which is that of the velocity v(k); lagged, it is g(k) - g(k-1), that of v(k-1). The part a1 h (v - v_b), v_b the
/// velocity of the base at the kick, and dashpots of supports take the mean of the velocities before and after the kick.
///
/// Work of a force of the kick from v(k-1/2) to v(k+1/2) is its mean over two kicks times the displacement between them. With m
/// v(k-1/2) v(k+1/2)/2 as kinetic energy the energy balance of linear forces then closes to round-off at any step.
template <int D>
class UniformStepper {
public:
  UniformStepper(state::Particles<D> particles, std::unique_ptr<particles::ParticleForces<D>> forces,
                 particles::ParticleSupports<D> supports, const UniformRules& rules);

  /// Evaluates the beginning; call once before the first `advance`, not after a resume.
  void start();

  void advance();

  /// Forces on the first particles from outside [N; N/m in 2-D]. They act from `time()` on, until others are given, all of them;
  /// before `start` from the beginning.
  void apply(std::span<const Vector3> forces);

  /// Finds the equilibrium under gravity before the beginning: `start` begins from it, with viscous boundaries that keep carrying
  /// their reactions and motions from t = 0. Boundaries are held meanwhile, but for dashpots that settle. Kinetic damping: all
  /// velocities are set to zero whenever the kinetic energy has passed a maximum. Cundall, The Explicit Finite-Difference Method
  /// (1982). Returns the largest acceleration left [m/s2].
  Real relax(const RelaxationRules& rules);

  std::int64_t steps() const { return step_; }
  Real time() const { return static_cast<Real>(step_) * rules_.step; }
  const UniformRules& rules() const { return rules_; }
  const state::Particles<D>& particles() const { return particles_; }
  const particles::ParticleSupports<D>& supports() const { return supports_; }
  particles::ParticleForces<D>& forces() { return *forces_; }

  /// Displacements at the beginning: those of the equilibrium under gravity [m].
  const std::array<state::Column, D>& initial_displacement() const { return initial_displacement_; }

  /// At `time()`: translations [m/s], [m/s2] and rotations [rad/s], [rad/s2].
  state::FreedomColumns<D> velocity() const;
  state::FreedomColumns<D> acceleration() const;

  /// By the forces between them alone [m/s2], [rad/s2].
  const state::FreedomColumns<D>& acceleration_by_forces() const { return elastic_; }

  Real kinetic_energy() const;
  Real elastic_energy() { return forces_->energy(particles_); }

  /// m v(k-1/2) v(k+1/2)/2, for the energy balance. It may be slightly negative.
  Real kinetic_energy_of_kick() const;
  /// Work by cause; all zero for Euler's steps, which have no energy balance.
  WorkByCause work() const;
  /// Work of the external forces alone [J].
  Real applied_work() const { return support_work_.applied + 0.5 * rules_.step * applied_power(); }

  /// The largest acceleration of any translation [m/s2]; infinite when one is no number.
  Real largest_acceleration() const;

  void columns(Archive& archive);

private:
  void prepare_factors();
  void hold(Index particle, int freedom);
  void stand_still();
  void begin_halfway();
  Real at_rest(const particles::Dashpot& dashpot) const;
  Real kinetic_sum() const;
  Real largest_unbalance() const;
  Real total_acceleration(std::size_t freedom, std::size_t i) const {
    const Real g = elastic_[freedom][i];
    return g + memory_[i] * (g - previous_[freedom][i]);
  }
  void kick_and_drift();
  void evaluate_next();
  template <bool damped>
  void kick(std::size_t tile, std::size_t begin, std::size_t end);
  void find_even_tiles();
  void drift_and_kick();
  void kick_by_euler();
  void drift(std::size_t begin, std::size_t end, Real factor);
  void turn(std::size_t begin, std::size_t end);
  void set_loads();
  void add_loads();
  Real applied_to(std::size_t freedom, std::size_t i) const {
    return freedom < D && !applied_[0].empty() ? applied_[freedom][i] : 0;
  }
  Real applied_power() const;
  void drive();
  void look_at_base();
  /// Acceleration with which damping carries a particle along with its base.
  Real carried(std::size_t freedom, std::size_t i) const { return drag_[i] * base_velocity_[freedom]; }

  bool is_damped() const;
  bool has_energy_balance() const { return !is_euler(rules_.integrator); }
  Real velocity_after(std::size_t freedom, std::size_t i) const;
  Real velocity_after(const particles::DrivenFreedom& driven) const;
  void remember_supports();
  void add_work_of_supports();
  void add_work_of_boundary(const particles::Dashpot& dashpot, Real before, Real after, Real way, WorkByCause& work) const;
  void add_work_of_prescribed(const particles::DrivenFreedom& driven, Real before, Real after, Real way, WorkByCause& work) const;
  WorkByCause first_half_of_kick() const;

  state::Particles<D> particles_;
  std::unique_ptr<particles::ParticleForces<D>> forces_;
  particles::ParticleSupports<D> supports_;
  UniformRules rules_;
  std::int64_t step_ = 0;
  state::FreedomColumns<D> elastic_;      ///< g(k) [m/s2], [rad/s2]
  state::FreedomColumns<D> previous_;     ///< g(k-1), but for what is not damped, which is that of g(k)
  state::FreedomColumns<D> load_;         ///< from nowhere: gravity, incoming waves, what is applied from outside
  std::array<state::Column, D> applied_;  ///< of the load, what is applied from outside [m/s2]; empty while nothing was
  state::FreedomColumns<D> keep_;         ///< what a kick leaves of the velocity
  state::FreedomColumns<D> gain_;         ///< what it adds per acceleration [s]
  state::Column memory_;                  ///< a2 h/dt
  state::Column drag_;                    ///< a1 h [1/s]
  /// Velocity of the base by freedom at the present time [m/s]; 0 where there is none, and for rotations.
  std::array<Real, state::particle_freedoms<D>> base_velocity_{};
  /// By tile: whether its particles share load, keep, gain, memory and drag.
  std::vector<std::array<std::uint8_t, state::particle_freedoms<D>>> is_even_;
  std::array<state::Column, D> initial_displacement_;  ///< displacements at the beginning [m]

  std::array<state::Column, 2> damping_work_;  ///< over the mass, and over the inertia of rotation [m2/s2], [rad2/s2]
  state::Column base_work_;                    ///< of damping, on the motion of the base, over the mass [m2/s2]
  WorkByCause support_work_;                   ///< of whole kicks; its damping is what the columns lack
  std::vector<Real> before_kick_;              ///< velocities of dashpots, then of driven freedoms
};

extern template class UniformStepper<2>;
extern template class UniformStepper<3>;

}  // namespace sazare::particles
