#pragma once

#include "sazare/cases/checks.hpp"
#include "sazare/methods/blocks/case/case.hpp"

/// What can be found wrong from the text of a case of method blocks alone: each function reports what it finds.
namespace sazare::cases {

void check_names(const CheckContext& context, const BlocksCase& blocks);
void check_joints(const CheckContext& context, const BlocksCase& blocks);
/// What only a natural joint takes, and what it does not.
void check_natural_joint(const CheckContext& context, const Entry& entry, const Joint& joint);
void check_contact(const CheckContext& context, const BlocksCase& blocks);
void check_constraints(const CheckContext& context, const BlocksCase& blocks);
void check_initial_stress(const CheckContext& context, const BlocksCase& blocks);
void check_settling(const CheckContext& context, const BlocksCase& blocks);

/// Checks the blasts and reads their pressure tables.
void check_blasts(const CheckContext& context, BlocksCase& blocks);

void check_charges(const CheckContext& context, const BlocksCase& blocks);

}  // namespace sazare::cases
