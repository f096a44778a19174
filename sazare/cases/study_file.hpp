#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/cases/format/schema.hpp"
#include "sazare/core/vector.hpp"

/// A study: families of cases, every combination of some parameters, and what is sought in each.
namespace sazare::cases {

enum class Sought { time_step, factor_of_safety };

struct StudyFamily {
  std::string name;
  std::filesystem::path file;
};

struct StudyParameter {
  std::string name;
  std::string unit;
  std::vector<std::string> keys;  // of the case; one for all families, or one for each
  std::vector<Real> values;
};

struct StudyLimit {
  Real ratio = 1.01;
  int steps = 4000;
  Real divergence = 1e15;  // m/s2
};

struct StudyFactor {
  Real lower = 0.5;
  Real upper = 4;
  Real ratio = 1.01;
  std::optional<Real> displacement_ratio;  // of the ground to that without a limit of strength; without it that of the method
};

struct Study : CaseSource {
  std::string title;
  Sought find = Sought::time_step;
  std::vector<StudyFamily> families;
  std::vector<StudyParameter> parameters;
  StudyLimit limit;
  StudyFactor factor;

  /// Cases of the study; a family's stand together, and the last parameter changes first.
  std::size_t size() const;
  const StudyFamily& family(std::size_t number) const;
  std::vector<Real> values(std::size_t number) const;
  std::vector<std::string> overrides(std::size_t number) const;
};

/// The tables of a study file.
std::span<const Table> study_schema();

/// Reads and checks a study file. Throws a UserError that lists everything that is wrong with it; its cases are not read.
Study read_study(const std::filesystem::path& path);

}  // namespace sazare::cases
