#pragma once

/// Sides beyond which the ground goes on as layers: columns beside them, and forces of ground that stands between such sides.
///
/// A column has the layers of its side and is periodic across: it moves as layers without end. The particles of the side are cut
/// in half, as those of a viscous boundary are, and dashpots act between them and their row of the column. A copy of the ground
/// at the side, some particles thick, is moved as the column moves; what its particles get from their links is less than what the
/// column's get, since the ground beyond is missing, and the particles of the side get the difference:
///
///     a = g + (g_c - g_k) - c/m (v - v_c)
///
///     g         acceleration by the links of the particle itself [m/s2]      v, v_c  velocity, and that of its row of the column
///     g_c, g_k  of its row of the column, and of its particle in the copy    c       impedance times area
///
/// A broken particle, which nothing ties to its place any more, gets less of g_c - g_k beyond a quarter of a spacing from its row
/// of the column, and nothing beyond three quarters: ground that has gone is not pushed on by the ground beyond.
///
/// Where all ground moves as the column, g = g_k and v = v_c: so does the side, whatever the law. All other waves meet the
/// dashpots alone. The links of the particles beside the side see that it is cut in half, so they have a difference, too. Columns
/// go ahead and do not feel the ground. Zienkiewicz, Bicanic and Shen, in Advances in Computational Nonlinear Mechanics (1989)
/// 109-138; Bielak and others, Bull. Seism. Soc. Am. 93 (2003) 817-824, for forces that bring a known motion in.

#include <memory>
#include <vector>

#include "sazare/methods/mps/failing_forces.hpp"
#include "sazare/particles/uniform_stepper.hpp"

namespace sazare::methods::mps {

/// The ground at a side as it is without what lies beyond, moved as a column moves.
template <int D>
struct SideCopy {
  /// A particle, whose difference a particle of the ground gets.
  struct Pair {
    Index of_copy = 0, of_ground = 0;
  };

  std::size_t column = 0;
  state::Particles<D> particles;
  std::unique_ptr<particles::ParticleForces<D>> forces;
  std::vector<Index> follows;  ///< by particle: that of the column
  std::vector<Pair> pairs;
};

/// A dashpot of the ground, and the particle of a column against which it moves.
struct SideDashpot {
  std::size_t dashpot = 0, column = 0;
  Index particle = 0;
};

/// What stands beside the ground.
template <int D>
struct SideGround {
  std::vector<std::unique_ptr<particles::UniformStepper<D>>> columns;
  std::vector<SideCopy<D>> copies;
  std::vector<SideDashpot> dashpots;
};

template <int D>
class FreeFieldForces final : public particles::ParticleForces<D> {
public:
  FreeFieldForces(std::unique_ptr<particles::ParticleForces<D>> ground, SideGround<D> beside);

  /// Finds the equilibrium of a column, before that of the ground. Returns the largest acceleration left [m/s2].
  Real relax(std::size_t column, const particles::RelaxationRules& rules);
  std::size_t column_count() const { return beside_.columns.size(); }
  const particles::UniformStepper<D>& column(std::size_t number) const { return *beside_.columns[number]; }

  /// Of what the sides give besides their dashpots, since the beginning [J; J/m in 2-D].
  Real work() const { return work_; }

  void begin() override;
  void go_ahead() override;
  void move_beyond(std::span<particles::Dashpot> dashpots) const override;
  void evaluate(const state::Particles<D>& particles, state::FreedomColumns<D>& acceleration) override;
  void add_undamped(Real factor, state::FreedomColumns<D>& acceleration) const override {
    ground_->add_undamped(factor, acceleration);
  }
  Real energy(const state::Particles<D>& particles) override { return ground_->energy(particles); }
  void columns(Archive& archive) override;

private:
  void follow(std::size_t copy);
  std::vector<state::FreedomColumns<D>> given(const state::Particles<D>& particles) const;
  Real share(const state::Particles<D>& particles, const SideCopy<D>& copy, const typename SideCopy<D>::Pair& pair) const;
  void add_work(const state::Particles<D>& particles, const std::vector<state::FreedomColumns<D>>& now);
  /// Calls visit(copy, pair) for all.
  template <class Visit>
  void each_pair(Visit&& visit) const;

  std::unique_ptr<particles::ParticleForces<D>> ground_;
  const FailingForces<D>* failing_;  ///< these, where the ground has a strength; else null
  SideGround<D> beside_;
  std::vector<state::FreedomColumns<D>> differences_;  ///< by copy and particle of it, at the last evaluation of the columns
  std::vector<state::FreedomColumns<D>> before_;       ///< those that the ground got last
  bool counts_ = false;                                ///< whether the coming evaluation ends a step
  Real work_ = 0;
};

extern template class FreeFieldForces<2>;
extern template class FreeFieldForces<3>;

}  // namespace sazare::methods::mps
