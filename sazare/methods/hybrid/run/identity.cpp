#include "sazare/methods/hybrid/run/identity.hpp"

#include "sazare/methods/hybrid/case/format.hpp"

namespace sazare::runs {

RunIdentity identify(const cases::HybridCase& hybrid, const RunIdentity& continuum, const RunIdentity& bodies) {
  cases::HybridCase plain = hybrid;
  plain.sides = {};
  plain.output = {};
  return {cases::write_resolved(plain) + continuum.case_text + bodies.case_text, continuum.mesh + bodies.mesh,
          continuum.tables + bodies.tables, program_text()};
}

}  // namespace sazare::runs
