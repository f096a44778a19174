#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sazare/cases/format/schema.hpp"
#include "sazare/core/vector.hpp"

/// A study: families of cases, every combination of some parameters, and what is sought in each.
namespace sazare::cases {

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

struct Study {
  std::filesystem::path path;
  std::string title;
  std::vector<StudyFamily> families;
  std::vector<StudyParameter> parameters;
  StudyLimit limit;

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
