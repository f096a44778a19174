#include <algorithm>
#include <cmath>
#include <string>

#include "sazare/runs/record_columns.hpp"
#include "validation/common/blast.hpp"
#include "validation/common/rows.hpp"

int main() {
  using namespace sazare;
  using terms::Account;
  auto model = validation::started_blast({});
  Real worst = 0;
  for (int i = 1; i <= 10; ++i) {
    validation::advance_to(model, 5e-5 * i);
    const auto ledger = model.simulation->ledger();
    if (i >= 2) worst = std::max(worst, std::abs(ledger.residual()) / ledger[Account::work]);
  }
  const auto ledger = model.simulation->ledger();
  validation::print_row("residual", std::abs(ledger.residual()) / ledger[Account::work]);
  validation::print_row("residual-on-the-way", worst);
  for (const Account account : {Account::work, Account::kinetic, Account::elastic, Account::joint_dashpot, Account::slip,
                                Account::fracture, Account::release, Account::contact_dashpot, Account::friction}) {
    const std::string column(runs::columns::blocks::energies[static_cast<std::size_t>(account)].name);
    validation::print_row(column.substr(std::string("energy_").size()).c_str(), ledger[account]);
  }
}
