#include "sazare/runs/fragments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "sazare/observe/csv_writer.hpp"
#include "sazare/runs/record_columns.hpp"

namespace sazare::runs {

namespace {

std::vector<observe::CsvField> fragment_row(const Fragment& fragment, FragmentTable table) {
  std::vector<observe::CsvField> row = {std::int64_t{fragment.number}, std::int64_t{fragment.elements}, fragment.volume,
                                        fragment.mass, fragment.size};
  row.insert(row.end(), fragment.center.begin(), fragment.center.end());
  row.insert(row.end(), fragment.velocity.begin(), fragment.velocity.end());
  row.emplace_back(fragment.throw_distance);
  if (table == FragmentTable::with_stays) row.emplace_back(std::int64_t{fragment.stays});
  return row;
}

}  // namespace

void finish_fragments(std::vector<Fragment>& fragments, std::span<const Vector3> moved) {
  for (std::size_t number = 0; number < fragments.size(); ++number) {
    Fragment& fragment = fragments[number];
    fragment.number = static_cast<Index>(number);
    fragment.size = std::cbrt(6 * fragment.volume / std::numbers::pi);
    fragment.center /= fragment.mass;
    fragment.velocity /= fragment.mass;
    fragment.throw_distance = moved[number].norm() / fragment.mass;
  }
  std::ranges::stable_sort(fragments, std::ranges::greater{}, &Fragment::volume);
}

void write_fragments(const std::filesystem::path& file, std::span<const Fragment> fragments, FragmentTable table) {
  std::vector<std::vector<observe::CsvField>> rows;
  for (const Fragment& fragment : fragments) rows.push_back(fragment_row(fragment, table));
  std::vector<std::string> titles;
  observe::add_titles(titles, columns::fragments);
  if (table == FragmentTable::with_stays) observe::add_titles(titles, columns::stays);
  observe::write_csv(file, titles, rows);
}

Real passing_size(std::span<const Fragment> largest_first, Real share) {
  if (largest_first.empty()) return std::numeric_limits<Real>::quiet_NaN();
  Real total = 0;
  for (const Fragment& fragment : largest_first) total += fragment.mass;
  Real passed = 0, size = largest_first.back().size;
  for (auto fragment = largest_first.rbegin(); fragment != largest_first.rend(); ++fragment) {
    const Real before = std::exchange(passed, passed + fragment->mass / total);
    if (passed >= share && fragment != largest_first.rbegin())
      return size + (fragment->size - size) * std::max(Real{0}, share - before) / (passed - before);
    if (passed >= share) return fragment->size;
    size = fragment->size;
  }
  return size;
}

}  // namespace sazare::runs
