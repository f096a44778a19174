#pragma once

/// What a record of method fem says of members: their columns of the history, fields of snapshots and figures.

#include "sazare/core/archive.hpp"
#include "sazare/methods/fem/run/columns.hpp"
#include "sazare/methods/fem/stepper.hpp"
#include "sazare/observe/manifest.hpp"
#include "sazare/observe/vtkhdf.hpp"

namespace sazare::runs {

template <int D>
class MemberRecord {
public:
  explicit MemberRecord(const methods::fem::FemStepper<D>& stepper);

  void add_titles(std::vector<std::string>& history) const;
  void add_values(std::vector<Real>& row) const;
  /// Looks at every step for members that yield for the first time.
  void observe(Real time);
  /// Fields of the nodes, which live until the next call.
  std::vector<observe::CellData> fields();
  void add_results(std::vector<std::pair<std::string, observe::Figure>>& results) const;
  void columns(Archive& archive) { archive("yield_time", yield_time_); }

private:
  using Set = methods::fem::MemberSet;

  const methods::fem::Members<D>& members() const { return stepper_->body().members(); }
  methods::fem::MemberForces forces(std::size_t set) const;
  static bool has_force_limit(const Set& set);
  static bool has_moment_limit(const Set& set);

  const methods::fem::FemStepper<D>* stepper_;
  std::vector<Real> yield_time_;             ///< by set, negative where it has not yielded [s]
  std::vector<Real> elongation_, rotation_;  ///< by node of the mesh [m], [rad]
};

extern template class MemberRecord<2>;
extern template class MemberRecord<3>;

}  // namespace sazare::runs
