#include <algorithm>
#include <cmath>
#include <string>

#include "sazare/methods/blocks/run/columns.hpp"
#include "sazare/runs/record_columns.hpp"
#include "validation/common/blast.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
using terms::EnergyKind;

/// With the case as it is.
void print_residuals() {
  auto model = validation::started_blast({});
  Real worst = 0, share = 0;
  for (int i = 1; i <= 10; ++i) {
    validation::advance_to(model, 5e-5 * i);
    const auto balance = model.simulation->energy_balance();
    share = std::abs(balance.residual()) / balance[EnergyKind::work];
    if (i >= 2) worst = std::max(worst, share);
  }
  validation::print_row("residual", share);
  validation::print_row("residual-on-the-way", worst);
}

/// With contact dashpots capped as in the independent calculation.
void print_accounts() {
  auto model = validation::started_blast({"contact.damping_cap=\"critical\""});
  validation::advance_to(model, 5e-4);
  const auto balance = model.simulation->energy_balance();
  for (const EnergyKind account : {EnergyKind::work, EnergyKind::kinetic, EnergyKind::elastic, EnergyKind::joint_dashpot,
                                   EnergyKind::slip, EnergyKind::fracture, EnergyKind::release}) {
    const std::string column(runs::columns::blocks::energies[static_cast<std::size_t>(account)].name);
    validation::print_row(column.substr(std::string("energy_").size()).c_str(), balance[account]);
  }
  validation::print_row("contacts", balance[EnergyKind::contact_dashpot] + balance[EnergyKind::friction]);
}

}  // namespace

int main() {
  print_residuals();
  print_accounts();
}
