#include "sazare/methods/fem/run/ties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/fem/case/case.hpp"

namespace sazare::runs {
namespace {

namespace fem = methods::fem;

constexpr Real tolerance = 1e-6;  // of the size of a group: how far a node may lie from its place opposite

std::vector<Index> nodes_of(const geometry::ElementGroup& group) {
  std::set<Index> nodes;
  for (const auto& element : group.elements) nodes.insert(element.node_list().begin(), element.node_list().end());
  return {nodes.begin(), nodes.end()};
}

Vector3 middle_of(const geometry::ElementMesh& mesh, const std::vector<Index>& nodes) {
  Vector3 low = mesh.nodes[at(nodes.front())], high = low;
  for (const Index node : nodes) {
    low = low.cwiseMin(mesh.nodes[at(node)]);
    high = high.cwiseMax(mesh.nodes[at(node)]);
  }
  return 0.5 * (low + high);
}

std::string place_text(const Vector3& place) {
  return fmt::format("({}, {}, {}) m", cases::short_number(place.x(), 6), cases::short_number(place.y(), 6),
                     cases::short_number(place.z(), 6));
}

/// One entry of the case.
struct Tie {
  const cases::CaseFile& file;
  const geometry::ElementMesh& mesh;
  std::string key;
  const cases::FemTie& given;

  /// Pairs of the nodes of both groups that differ by the way between their middles.
  std::vector<std::pair<Index, Index>> pairs(const MeshNames& names) const {
    const auto own = nodes_of(names.group(key + ".group", given.group, false));
    const auto other = nodes_of(names.group(key + ".opposite", given.opposite, false));
    const Vector3 way = middle_of(mesh, other) - middle_of(mesh, own);
    Real size = 0;
    for (const Index node : own) size = std::max(size, (mesh.nodes[at(node)] - mesh.nodes[at(own.front())]).norm());
    std::vector<std::pair<Index, Index>> pairs;
    for (const Index node : own) {
      const Vector3 wanted = mesh.nodes[at(node)] + way;
      const Index nearest =
          *std::ranges::min_element(other, {}, [&](Index one) { return (mesh.nodes[at(one)] - wanted).squaredNorm(); });
      if ((mesh.nodes[at(nearest)] - wanted).norm() > tolerance * size || nearest == node || own.size() != other.size())
        refuse(file, key + ".opposite",
               fmt::format("the node at {} of \"{}\" has no node of \"{}\" opposite, at {}", place_text(mesh.nodes[at(node)]),
                           given.group, given.opposite, place_text(wanted)),
               "mesh both sides alike, such as with Transfinite Curve or Periodic Curve in Gmsh");
      pairs.emplace_back(node, nearest);
    }
    return pairs;
  }

  using Motions = std::map<std::pair<Index, int>, Index>;

  void check_supports(Index node, Index other, const Motions& motions, int dimension) const {
    const auto motion = [&](Index which, int axis) {
      const auto found = motions.find({which, axis});
      return found == motions.end() ? std::optional<Index>() : found->second;
    };
    for (int axis = 0; axis < dimension; ++axis)
      if (motion(node, axis) != motion(other, axis))
        refuse(file, key + ".opposite",
               fmt::format("the nodes at {} and {} are tied, but boundaries hold them differently along {}",
                           place_text(mesh.nodes[at(node)]), place_text(mesh.nodes[at(other)]), "xyz"[axis]),
               "hold both in the same way, or neither");
  }
};

/// Joins the chains in which nodes are tied, such as at edges of a box: each node gets the last one of its chain.
class Chains {
public:
  void add(Index node, Index other) {
    const Index first = last_of(node), second = last_of(other);
    if (first != second) next_[first] = second;
  }
  std::vector<std::pair<Index, Index>> ends() const {
    std::vector<std::pair<Index, Index>> all;
    for (const auto& [node, next] : next_) all.emplace_back(node, last_of(node));
    return all;
  }

private:
  Index last_of(Index node) const {
    for (auto found = next_.find(node); found != next_.end(); found = next_.find(node)) node = found->second;
    return node;
  }

  std::map<Index, Index> next_;
};

}  // namespace

template <int D>
std::vector<std::pair<Index, Index>> tied_nodes(const cases::CaseFile& file, const geometry::ElementMesh& mesh,
                                                const MeshNames& names, const fem::Supports<D>& supports) {
  Tie::Motions motions;
  for (const fem::Support& support : supports.held) motions[{support.node, support.axis}] = support.motion;
  Chains chains;
  const auto& ties = file.as<cases::FemCase>().ties;
  for (std::size_t i = 0; i < ties.size(); ++i) {
    const Tie tie{file, mesh, fmt::format("ties.{}", i), ties[i]};
    for (const auto& [node, other] : tie.pairs(names)) {
      tie.check_supports(node, other, motions, D);
      chains.add(node, other);
    }
  }
  return chains.ends();
}

template std::vector<std::pair<Index, Index>> tied_nodes<2>(const cases::CaseFile&, const geometry::ElementMesh&, const MeshNames&,
                                                            const fem::Supports<2>&);
template std::vector<std::pair<Index, Index>> tied_nodes<3>(const cases::CaseFile&, const geometry::ElementMesh&, const MeshNames&,
                                                            const fem::Supports<3>&);

}  // namespace sazare::runs
