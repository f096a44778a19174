#include "sazare/observe/column.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sazare::observe {

namespace {

constexpr std::string_view owner_word = "NAME";
constexpr std::array axis_names = {'x', 'y', 'z'};

std::string with_owner(std::string_view name, std::string_view owner) {
  std::string whole(name);
  if (const std::size_t place = whole.find(owner_word); place != std::string::npos)
    whole.replace(place, owner_word.size(), owner);
  return whole;
}

}  // namespace

void add_titles(std::vector<std::string>& titles, std::span<const Column> columns, std::string_view owner, int axes) {
  for (const Column& column : columns) {
    const std::string name = with_owner(column.name, owner);
    if (column.axes == 0) titles.push_back(column.unit.empty() ? name : fmt::format("{} [{}]", name, column.unit));
    for (int axis = 0; axis < std::min(column.axes, axes); ++axis)
      titles.push_back(fmt::format("{}_{} [{}]", name, axis_names[static_cast<std::size_t>(axis)], column.unit));
  }
}

}  // namespace sazare::observe
