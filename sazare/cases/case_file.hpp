#pragma once

#include <any>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sazare/cases/outside_history.hpp"

namespace sazare::cases {

struct CaseText;

/// Where a case stands and its text: all that a message about one of its keys needs.
struct CaseSource {
  std::filesystem::path path;
  std::shared_ptr<const CaseText> text;
};

/// A case that was read and checked. Its content is the struct of its method, such as cases::MpsCase.
struct CaseFile : CaseSource {
  std::string method;
  std::any content;
  std::string warnings;                         ///< ready to print; empty when there are none
  std::vector<OutsideHistory> histories = {};   ///< functions of time that only the caller of the engine knows

  template <class Case>
  bool holds() const {
    return std::any_cast<Case>(&content) != nullptr;
  }
  /// The content; throws std::bad_any_cast where the case is of another method.
  template <class Case>
  const Case& as() const {
    return std::any_cast<const Case&>(content);
  }
  template <class Case>
  Case& as() {
    return std::any_cast<Case&>(content);
  }
};

/// Throws a UserError that points at a key of the case, for what only the engine finds out. `key` is written
/// as for overrides: "gauges.2.point", or "time" for the table; the nearest place that exists is shown.
[[noreturn]] void refuse(const CaseSource& source, const std::string& key, std::string what, std::string help);

/// The text of a warning at the same place; with `time.strict` use `refuse` instead.
std::string warning(const CaseSource& source, const std::string& key, std::string what, std::string help);

/// Throws a UserError where a case has a history that only a caller in Python can give.
void refuse_outside_histories(const CaseFile& file);

}  // namespace sazare::cases
