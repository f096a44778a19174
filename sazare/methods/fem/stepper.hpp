#pragma once

/// Walks a body of finite elements through time, or through a sequence of equilibria.

#include <memory>
#include <optional>

#include "sazare/core/archive.hpp"
#include "sazare/methods/fem/body.hpp"
#include "sazare/methods/fem/linear_solver.hpp"
#include "sazare/methods/fem/supports.hpp"

namespace sazare::methods::fem {

struct FemRules {
  Real step = 0;             ///< [s]
  bool statics = false;      ///< no inertia and no damping: each step is an equilibrium, in which only water in pores may flow
  Real alpha = 0;            ///< of the HHT-alpha step, -1/3 to 0; 0 is Newmark's step of constant average acceleration
  Real tolerance = 1e-8;     ///< unbalanced force left, over the largest of the forces in play, unless round-off leaves more
  int most_iterations = 20;  ///< of the Newton iteration in a step
  int most_cuts = 8;         ///< a step that does not converge is halved so often
  laws::RayleighDamping damping;
};

/// Work done since the beginning, by cause [J]; in 2-D per metre of thickness [J/m].
struct FemWork {
  Real gravity = 0;
  Real loads = 0;      ///< tractions, and forces applied from outside
  Real water = 0;      ///< pressure of still water, on faces, in joints and in pores
  Real boundary = 0;   ///< of supports that move, and of the reactions that viscous boundaries and sides carry in equilibrium
  Real waves = 0;      ///< that come in through viscous boundaries
  Real damping = 0;    ///< dissipated by Rayleigh damping, in the motion relative to the base
  Real sides = 0;      ///< of the columns beside free-field sides
  Real radiation = 0;  ///< dissipated by viscous boundaries, and by the dashpots of free-field sides
  Real plastic = 0;    ///< dissipated by plastic flow
  Real friction = 0;   ///< dissipated by joints
  Real members = 0;    ///< dissipated by members that yield
  Real seepage = 0;    ///< dissipated by the flow of pore water
};

/// What free-field sides feel of their columns, on the nodes of the body.
struct SideMotion {
  methods::fem::NodalColumn displacement, velocity;  ///< of the columns [m], [m/s]
  methods::fem::NodalColumn force;                   ///< of their stress, and of dashpots on a body that stands still [N]
};

template <int D>
class FreeField;

/// All that a step changes: a copy of it is a place to which the stepper can return.
template <int D>
struct FemState {
  explicit FemState(const methods::fem::NodePattern& pattern) : tangent(pattern) {}

  std::int64_t steps = 0;
  std::int64_t iterations = 0;  ///< Newton iterations so far
  std::int64_t cuts = 0;        ///< halved steps so far
  methods::fem::NodalColumn displacement, velocity, acceleration;
  methods::fem::NodalColumn internal;  ///< forces of elements and joints [N]
  methods::fem::NodalColumn balance;   ///< damping and internal forces less external ones [N]
  methods::fem::NodalColumn applied;   ///< forces from outside [N]
  methods::fem::NodalColumn carried;   ///< those of them that act at the end of the last step [N]
  methods::fem::Memory memory;
  methods::fem::BlockMatrix<D> tangent;  ///< of the internal forces, with which the next step begins
  FemWork work;
  std::vector<FemState<D>> columns;  ///< beside free-field sides
  SideMotion sides_before, sides;    ///< at both ends of the last step, or of the one that is gone through; empty without sides
};

/// Step: M a(n+1) + (1 + alpha) b(n+1) - alpha b(n) = 0, with b = C v + f(u) - p of the damping, internal and external forces,
/// and Newmark's u(n+1) = u + dt v + dt^2 ((1/2 - beta) a(n) + beta a(n+1)), v(n+1) = v + dt ((1 - gamma) a(n) + gamma a(n+1));
/// beta = (1 - alpha)^2/4, gamma = 1/2 - alpha. Hilber, Hughes and Taylor, Earthquake Eng. Struct. Dyn. 5 (1977) 283-292. The
/// Rayleigh part of C v acts on the velocity relative to the base: with the velocity v_b of the base at all nodes, C (v - v_b).
/// In statics water in pores flows with v(n+1) = (u(n+1) - u(n))/dt and a(n+1) = (v(n+1) - v(n))/dt, Euler's implicit step.
template <int D>
class FemStepper {
public:
  FemStepper(std::unique_ptr<methods::fem::Body<D>> body, methods::fem::Supports<D> supports, const FemRules& rules);
  FemStepper(FemStepper&&) noexcept;
  ~FemStepper();

  /// A freedom that nothing holds when the body is at rest, joints closed; none where the stiffness is regular.
  std::optional<methods::fem::Freedom> find_loose_freedom();

  /// Finds the equilibrium under gravity, the pressure of the water there is at the beginning, and forces on nodes that go on
  /// acting [N], before it: viscous boundaries carry what they carry in it, and motions begin from there. With other forces it
  /// may be found again from the state that was there before. Throws PhysicsError where there is none.
  void relax(methods::fem::NodalColumn applied = {});

  /// Finds the accelerations at the beginning; call once before the first `advance`, not after a resume.
  void start();

  /// Throws PhysicsError, saying what was tried, where Newton's iteration does not converge.
  void advance();

  /// Forces on nodes from outside, such as from bodies that touch a face [N]; they act in full until others are given.
  /// Accelerations jump with them, so that the impulse of a step is that of the force, and so is its work.
  void apply(methods::fem::NodalColumn force);

  /// For windows that are gone through again: `restore(saved)` and `advance` give the same bits as the first time.
  const FemState<D>& state() const { return state_; }
  void restore(const FemState<D>& saved);

  std::int64_t steps() const { return state_.steps; }
  Real time() const { return static_cast<Real>(state_.steps) * rules_.step; }
  const FemRules& rules() const { return rules_; }
  const methods::fem::Body<D>& body() const { return *body_; }
  const methods::fem::Supports<D>& supports() const { return supports_; }
  /// Mass of the body, of the water that moves with it, and on pressure nodes the storage of the pores [kg].
  const methods::fem::BlockMatrix<D>& mass() const { return mass_; }
  const methods::fem::NodalColumn& initial_displacement() const { return initial_displacement_; }
  std::size_t free_freedoms() const { return solver_->freedoms(); }
  std::int64_t factorizations() const { return factorizations_; }  ///< of the matrix of a step, in this process

  /// Forces of supports on the nodes that they hold, 0 on all others [N].
  methods::fem::NodalColumn reactions() const;

  /// Force of a viscous boundary on the body [N].
  Vector<D> viscous_force(std::size_t number) const;

  /// Force of a free-field side on the body [N].
  Vector<D> side_force(std::size_t number) const;

  /// Force of a still water on the body, of its pressure and of the part that moves with the body; of water in a joint, on the
  /// first side [N].
  Vector<D> water_force(std::size_t number) const;

  Real kinetic_energy() const;
  /// Of the water that moves with the body, which is part of the whole [J].
  Real kinetic_energy_of_water() const;
  /// Stored, since the beginning, in the ground and in the water of its pores [J].
  Real elastic_energy() const;
  /// Of the water in the pores alone [J].
  Real elastic_energy_of_water() const;
  const FemWork& work() const { return state_.work; }
  /// Residual of the energy balance [J]; with alpha < 0 it contains what the step itself dissipates.
  Real energy_residual() const;
  /// Energy that round-off may have made up so far, where internal forces are differences of displacements [J].
  Real round_off_energy() const;

  void columns(Archive& archive);

private:
  enum class Stage { relaxing, running };
  /// The time of a step or of a part of it [s]; while relaxing, shares of gravity. The length is the very same number in all steps,
  /// which the difference of both ends is not: the matrix of the step and its factors follow from it.
  struct Span {
    Real from = 0, to = 0, length = 0;

    Real middle() const { return from + 0.5 * length; }
    Span first_half() const { return {from, middle(), 0.5 * length}; }
    Span second_half() const { return {middle(), to, 0.5 * length}; }
  };
  /// Factors of the mass, damping and tangent in the matrix of a step.
  struct Factors {
    Real mass = 0, damping = 0, stiffness = 1;
    bool operator==(const Factors&) const = default;
  };
  struct PoreMatrices {
    methods::fem::BlockMatrix<D> storage;  ///< S, as a mass
    methods::fem::BlockMatrix<D> seepage;  ///< H, as a damping
    methods::fem::BlockMatrix<D> rates;    ///< H, and the coupling of pressures with strains and with joints

    explicit PoreMatrices(const methods::fem::Body<D>& body)
        : storage(body.pattern()), seepage(body.pattern()), rates(body.pattern()) {
      body.pores().add_storage(storage);
      body.pores().add_seepage(seepage);
      rates.values() = seepage.values();
      body.pores().add_coupling(rates);
      body.joint_pores().add_coupling(rates);
    }
  };
  struct Trial {
    methods::fem::NodalColumn displacement, velocity, acceleration, internal, external;
    methods::fem::Memory memory;
  };

  void move_sides();
  methods::fem::NodalColumn at_sides(Real at, methods::fem::NodalColumn SideMotion::*quantity) const;
  void add_work_of_sides(const Trial& trial, const Span& span, const methods::fem::NodalColumn& moved);
  bool inertia() const { return stage_ == Stage::running && !rules_.statics; }
  /// Whether velocities count: with inertia, or where water flows.
  bool in_time() const { return inertia() || (stage_ == Stage::running && pore_matrices_); }
  /// What acts with accelerations, and with velocities.
  const methods::fem::BlockMatrix<D>& inertia_matrix() const { return rules_.statics ? pore_matrices_->storage : mass_; }
  const methods::fem::BlockMatrix<D>& rate_matrix() const { return rules_.statics ? pore_matrices_->rates : damping_; }
  methods::fem::NodalColumn widened(methods::fem::NodalColumn column) const;
  void add_pores();
  void widen_loads();
  Factors factors(Real length) const;
  methods::fem::NodalColumn external(Real at) const;
  methods::fem::NodalColumn incoming(Real at) const;
  Vector<D> base_motion(Real at, Real laws::MotionState::*quantity) const;
  bool is_unloaded() const;
  methods::fem::NodalColumn carried_at_start() const;
  void add_water(Real at, Real factor, methods::fem::NodalColumn& force) const;
  void add_work_of_damping(const Trial& trial, const Span& span, const methods::fem::NodalColumn& moved);
  void walk(const Span& span, int cuts_left);
  void push(const methods::fem::NodalColumn& change);
  void jump(const Span& span);
  bool attempt(const Span& span);
  Trial predict(const Span& span, methods::fem::NodalColumn& prescribed);
  bool iterate(Trial& trial, const Factors& by, const methods::fem::NodalColumn& prescribed);
  Real search(Trial& trial, const methods::fem::NodalColumn& change, const Factors& by, Real before, bool may_shorten);
  void move(Trial& trial, const methods::fem::NodalColumn& change, Real share, const Factors& by) const;
  void evaluate(Trial& trial);
  methods::fem::NodalColumn balance_of(const Trial& trial) const;
  methods::fem::NodalColumn unbalance(const Trial& trial, Real& scale) const;
  Real round_off(const methods::fem::NodalColumn& prescribed) const;
  bool factorize(const Factors& by);
  void commit(Trial& trial, const Span& span);
  void add_work(const Trial& trial, const methods::fem::NodalColumn& balance, const Span& span);
  void prepare_solver(bool at_rest);
  void find_unknowns(bool at_rest);
  void hold_sides();
  void find_leaders();
  bool moves_what_settles() const;
  [[noreturn]] void give_up(const Span& span) const;

  std::unique_ptr<methods::fem::Body<D>> body_;
  methods::fem::Supports<D> supports_;
  FemRules rules_;
  methods::fem::BlockMatrix<D> mass_;               ///< of the body, of the water that moves with it, and of storage in pores
  methods::fem::BlockMatrix<D> rayleigh_;           ///< C of the body
  methods::fem::BlockMatrix<D> viscous_;            ///< C of the viscous boundaries
  methods::fem::BlockMatrix<D> damping_;            ///< all C, with that of pores and of free-field sides
  std::unique_ptr<PoreMatrices> pore_matrices_;     ///< where pressures in pores are unknowns
  std::unique_ptr<FreeField<D>> free_field_;
  methods::fem::NodalColumn weight_;                ///< M g of the body [N]
  methods::fem::NodalColumn pore_;                  ///< forces of the water in the pores [N]
  methods::fem::NodalColumn reaction_;              ///< what viscous boundaries and free-field sides carry at rest [N]
  methods::fem::NodalColumn initial_displacement_;  ///< displacements at the beginning [m]
  bool columns_rest_ = false;                       ///< those beside free-field sides, in their equilibrium
  typename methods::fem::LinearSolver<D>::Unknowns unknowns_;
  Stage stage_ = Stage::running;
  FemState<D> state_;
  Real elastic_at_start_ = 0;  ///< [J]
  std::unique_ptr<methods::fem::LinearSolver<D>> solver_;
  std::unique_ptr<methods::fem::LinearSolver<D>> mass_solver_;  ///< made when forces from outside first change
  std::int64_t factorizations_ = 0;
  std::optional<Factors> factorized_;                           ///< of what the solver holds, while the tangent has not changed
  std::string last_failure_;                                    ///< of an attempt
};

extern template class FemStepper<2>;
extern template class FemStepper<3>;

}  // namespace sazare::methods::fem
