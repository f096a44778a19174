#include "sazare/runs/fragments.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/observe/csv_writer.hpp"
#include "sazare/runs/record_columns.hpp"

namespace sazare::runs {

namespace {

std::size_t at(Index index) { return static_cast<std::size_t>(index); }

/// Joined sets; the smallest element of each is its root.
class Sets {
public:
  explicit Sets(Index count) : parent_(at(count)) { std::iota(parent_.begin(), parent_.end(), 0); }

  Index root(Index element) {
    while (parent_[at(element)] != element) {
      parent_[at(element)] = parent_[at(parent_[at(element)])];
      element = parent_[at(element)];
    }
    return element;
  }

  /// Whether they are known to hang together: most joints' elements are by the time they are asked about.
  bool are_joined(Index a, Index b) const { return parent_[at(a)] == parent_[at(b)]; }

  void join(Index a, Index b) {
    a = root(a);
    b = root(b);
    parent_[at(std::max(a, b))] = std::min(a, b);
  }

private:
  std::vector<Index> parent_;
};

std::vector<observe::CsvField> fragment_row(const Fragment& fragment) {
  std::vector<observe::CsvField> row = {std::int64_t{fragment.number}, std::int64_t{fragment.elements}, fragment.volume,
                                        fragment.mass, fragment.size};
  row.insert(row.end(), fragment.center.begin(), fragment.center.end());
  row.insert(row.end(), fragment.velocity.begin(), fragment.velocity.end());
  row.emplace_back(fragment.throw_distance);
  return row;
}

}  // namespace

FragmentMap find_fragments(Index elements, const methods::blocks::Joints& joints) {
  Sets sets(elements);
  const auto links = joints.links();
  for (Index joint = 0; joint < joints.count(); ++joint) {
    const auto [first, second] = links[at(joint)];
    if (!sets.are_joined(first, second) && joints.state(joint) != methods::blocks::JointState::broken) sets.join(first, second);
  }
  FragmentMap map;
  map.of_element.reserve(at(elements));
  for (Index element = 0; element < elements; ++element) {
    const Index root = sets.root(element);
    map.of_element.push_back(root == element ? map.count++ : map.of_element[at(root)]);
  }
  return map;
}

std::vector<Fragment> measure_fragments(const FragmentMap& map, const geometry::TetraMesh& mesh, const state::Bodies<3>& bodies,
                                        const engine::Snapshot<3>& now) {
  std::vector<Fragment> fragments(at(map.count));
  std::vector<Vector3> moved(at(map.count), Vector3::Zero());
  for (std::size_t element = 0; element < mesh.tetrahedra.size(); ++element) {
    const auto number = at(map.of_element[element]);
    Fragment& fragment = fragments[number];
    const Real mass = bodies.inertia[element].mass;
    ++fragment.elements;
    fragment.volume += geometry::volume(geometry::corners_of(mesh, static_cast<Index>(element)));
    fragment.mass += mass;
    fragment.center += mass * now.pose[element].position;
    fragment.velocity += mass * now.velocity[element];
    moved[number] += mass * (now.pose[element].position - bodies.start[element]);
  }
  finish_fragments(fragments, moved);
  return fragments;
}

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

void write_fragments(const std::filesystem::path& file, std::span<const Fragment> fragments) {
  std::vector<std::vector<observe::CsvField>> rows;
  for (const Fragment& fragment : fragments) rows.push_back(fragment_row(fragment));
  std::vector<std::string> titles;
  observe::add_titles(titles, columns::fragments);
  observe::write_csv(file, titles, rows);
}

Real passing_size(std::span<const Fragment> largest_first, Real share) {
  if (largest_first.empty()) return 0;
  Real total = 0;
  for (const Fragment& fragment : largest_first) total += fragment.volume;
  Real passed = 0, size = largest_first.back().size;
  for (auto fragment = largest_first.rbegin(); fragment != largest_first.rend(); ++fragment) {
    const Real before = std::exchange(passed, passed + fragment->volume / total);
    if (passed >= share && fragment != largest_first.rbegin())
      return size + (fragment->size - size) * std::max(Real{0}, share - before) / (passed - before);
    if (passed >= share) return fragment->size;
    size = fragment->size;
  }
  return size;
}

}  // namespace sazare::runs
