#include "sazare/methods/blocks/run/block_fragments.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "sazare/geometry/tetrahedron.hpp"

namespace sazare::runs {

namespace {

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

}  // namespace

FragmentMap find_fragments(Index elements, const methods::blocks::Joints& joints) {
  Sets sets(elements);
  const auto links = joints.links();
  for (Index joint = 0; joint < joints.count(); ++joint) {
    const auto [first, second] = links[at(joint)];
    if (sets.are_joined(first, second) || is_crack(joints.state(joint)) || joints.is_natural(joint)) continue;
    sets.join(first, second);
  }
  FragmentMap map;
  map.of_element.reserve(at(elements));
  for (Index element = 0; element < elements; ++element) {
    const Index root = sets.root(element);
    map.of_element.push_back(root == element ? map.count++ : map.of_element[at(root)]);
  }
  return map;
}

std::vector<Index> anchored_elements(const cases::BlocksCase& blocks, const methods::blocks::OuterFaces* faces,
                                     const state::Bodies<3>& bodies) {
  constexpr int all_axes = 7;
  std::vector<Index> anchored;
  for (Index element = 0; element < bodies.size(); ++element)
    if (bodies.locks[at(element)].translation == all_axes) anchored.push_back(element);
  if (faces != nullptr)
    for (const methods::blocks::OuterFace& face : faces->faces())
      if (blocks.boundaries[at(face.boundary)].kind != cases::BoundaryKind::frictionless) anchored.push_back(face.body);
  std::ranges::sort(anchored);
  anchored.erase(std::ranges::unique(anchored).begin(), anchored.end());
  return anchored;
}

void mark_staying(const FragmentMap& map, std::span<const Index> anchored, std::vector<Fragment>& largest_first) {
  constexpr Real hardly = 0.5;  // of the mean throw of the others
  std::vector<bool> holds(at(map.count), false);
  for (const Index element : anchored) holds[at(map.of_element[at(element)])] = true;
  for (Fragment& fragment : largest_first) fragment.stays = holds[at(fragment.number)];
  if (largest_first.empty()) return;
  Real mass = 0, thrown = 0;
  for (const Fragment& fragment : std::span(largest_first).subspan(1)) {
    mass += fragment.mass;
    thrown += fragment.mass * fragment.throw_distance;
  }
  Fragment& largest = largest_first.front();
  if (mass == 0 || largest.throw_distance < hardly * thrown / mass) largest.stays = true;
}

std::vector<Fragment> detached(std::span<const Fragment> fragments) {
  std::vector<Fragment> those;
  std::ranges::copy_if(fragments, std::back_inserter(those), [](const Fragment& fragment) { return !fragment.stays; });
  return those;
}

std::vector<Fragment> measure_fragments(const FragmentMap& map, const geometry::TetraMesh& mesh, const state::Bodies<3>& bodies,
                                        const levels::Snapshot<3>& now, std::span<const Vector3> start) {
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
    moved[number] += mass * (now.pose[element].position - start[element]);
  }
  finish_fragments(fragments, moved);
  return fragments;
}

}  // namespace sazare::runs
