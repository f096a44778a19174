#pragma once

/// What a column of a table, or a field of a snapshot, is called and means: said once, written by the run that fills it and
/// printed by the reference.

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sazare/observe/vtkhdf.hpp"

namespace sazare::observe {

struct Column {
  std::string_view name;  ///< as the file has it; NAME stands for that of its owner, such as a gauge
  std::string_view unit;  ///< "-" for a number without one; none for words
  std::string_view meaning;
  int axes = 0;  ///< of a vector: a column NAME_x, NAME_y, NAME_z for so many of its axes
};

/// Adds their titles, "name [unit]"; `axes` is the most that vectors get.
void add_titles(std::vector<std::string>& titles, std::span<const Column> columns, std::string_view owner = {}, int axes = 3);

inline CellData cell_data(std::string_view name, const std::vector<Real>& values) {
  return {std::string(name), 1, std::span<const Real>(values)};
}
inline CellData cell_data(std::string_view name, const std::vector<std::int32_t>& values) {
  return {std::string(name), 1, std::span<const std::int32_t>(values)};
}
inline CellData cell_data(std::string_view name, const std::vector<Vector3>& values) {
  const Real* first = values.empty() ? nullptr : values.front().data();
  return {std::string(name), 3, std::span(first, 3 * values.size())};
}

template <class T>
CellData cell_data(std::string_view name, const MadeNumbers<T>& values) {
  return {std::string(name), 1, values};
}
/// Vectors that are made while they are written, three numbers each.
struct MadeVectors {
  MadeNumbers<Real> numbers;
};
inline CellData cell_data(std::string_view name, const MadeVectors& values) { return {std::string(name), 3, values.numbers}; }

/// The fields of a snapshot, values in the order of the columns.
template <std::size_t N, class... Values>
std::vector<CellData> cell_data(const std::array<Column, N>& columns, const Values&... values) {
  static_assert(sizeof...(Values) == N, "a field without values, or values without a field");
  std::size_t place = 0;
  return {cell_data(columns[place++].name, values)...};
}

}  // namespace sazare::observe
