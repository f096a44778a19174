#pragma once

/// Histories of a case that are functions of time which only the caller of the engine knows, such as a program in Python. The
/// case shares their samples with the run; the caller adds them ahead of its time.

#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "sazare/cases/tables.hpp"
#include "sazare/laws/pressure_table.hpp"

namespace sazare::cases {

struct OutsideHistory {
  std::string name;
  std::string key;  ///< of the case that asks for it, as for overrides
  std::string what;
  Real begin = 0;  ///< time of the run at which its own is 0 [s]
  std::variant<std::shared_ptr<laws::Record>, std::shared_ptr<laws::PressureTable>> samples;

  /// Adds values after those that are there, at equal steps [s] from 0.
  void add(Real step, std::span<const Real> values) const;
};

/// The histories of functions among the motions of a case, in their order.
std::vector<OutsideHistory> outside_motions(std::span<const Motion> motions);

}  // namespace sazare::cases
