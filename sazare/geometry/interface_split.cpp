#include "sazare/geometry/interface_split.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace sazare::geometry {
namespace {

/// Corner nodes in ascending order: what names a face from either side.
using FaceName = std::vector<Index>;

FaceName name_of(const MeshElement& element) {
  FaceName name(element.nodes.begin(), element.nodes.begin() + facts(element.shape).corners);
  std::ranges::sort(name);
  return name;
}

MeshElement face_of(const MeshElement& element, const ElementFace& face) {
  MeshElement result{face.shape, {}, element.tag};
  for (std::size_t i = 0; i < face.nodes.size(); ++i) result.nodes[i] = element.nodes[static_cast<std::size_t>(face.nodes[i])];
  return result;
}

struct Side {
  Index element = 0;
  int face = 0;
};

/// The elements at every face of the mesh, in the mesh's order.
std::map<FaceName, std::vector<Side>> sides_of(const ElementMesh& mesh) {
  std::map<FaceName, std::vector<Side>> sides;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto faces = faces_of(mesh.elements[e].shape);
    for (std::size_t f = 0; f < faces.size(); ++f)
      sides[name_of(face_of(mesh.elements[e], faces[f]))].push_back({static_cast<Index>(e), static_cast<int>(f)});
  }
  return sides;
}

const MeshElement& element_at(const ElementMesh& mesh, Index element) { return mesh.elements[static_cast<std::size_t>(element)]; }

const ElementFace& face_at(const ElementMesh& mesh, Index element, int face) {
  return faces_of(element_at(mesh, element).shape)[static_cast<std::size_t>(face)];
}

/// Which elements hang together around a node.
class Clusters {
public:
  explicit Clusters(std::vector<Index> elements) : elements_(std::move(elements)), parent_(elements_.size()) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  void join(Index one, Index other) {
    const std::size_t a = root(place(one)), b = root(place(other));
    parent_[std::max(a, b)] = std::min(a, b);
  }

  /// The first element of the cluster.
  Index leader(Index element) { return elements_[root(place(element))]; }
  const std::vector<Index>& elements() const { return elements_; }

private:
  std::size_t place(Index element) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(elements_, element) - elements_.begin());
  }
  std::size_t root(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }

  std::vector<Index> elements_;  // ascending
  std::vector<std::size_t> parent_;
};

using SidesOfFaces = std::map<FaceName, std::vector<Side>>;

/// Nodes on the cuts, each with the elements around it.
std::map<Index, Clusters> nodes_on(const ElementMesh& mesh, const std::set<FaceName>& cut, const SidesOfFaces& sides) {
  std::set<Index> nodes;
  for (const FaceName& name : cut) {
    const Side side = sides.at(name).front();
    const MeshElement face = face_of(element_at(mesh, side.element), face_at(mesh, side.element, side.face));
    nodes.insert(face.node_list().begin(), face.node_list().end());
  }
  std::map<Index, std::vector<Index>> around;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (const Index node : mesh.elements[e].node_list())
      if (nodes.contains(node)) around[node].push_back(static_cast<Index>(e));
  std::map<Index, Clusters> clusters;
  for (auto& [node, elements] : around) clusters.emplace(node, std::move(elements));
  return clusters;
}

/// A node of its own for every further cluster; those of groups follow the element beside them.
class Renaming {
public:
  Renaming(ElementMesh& mesh, std::map<Index, Clusters>& clusters) {
    for (auto& [node, around] : clusters)
      for (const Index element : around.elements()) {
        const Index leader = around.leader(element);
        const Index first = around.leader(around.elements().front());
        if (leader == first) continue;
        const auto [place, added] = copies_.try_emplace({node, leader}, static_cast<Index>(mesh.nodes.size()));
        if (added) {
          mesh.nodes.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
          mesh.node_tags.push_back(mesh.node_tags[static_cast<std::size_t>(node)]);
        }
        of_element_[{node, element}] = place->second;
      }
  }

  Index operator()(Index node, Index element) const {
    const auto found = of_element_.find({node, element});
    return found == of_element_.end() ? node : found->second;
  }

  void apply(MeshElement& item, Index element) const {
    for (std::size_t i = 0; i < item.node_list().size(); ++i) item.nodes[i] = (*this)(item.nodes[i], element);
  }

private:
  std::map<std::pair<Index, Index>, Index> copies_;      // by node and leader
  std::map<std::pair<Index, Index>, Index> of_element_;  // by node and element
};

}  // namespace

std::vector<SharedFace> faces_between(const ElementMesh& mesh, Index first, Index second) {
  std::vector<SharedFace> found;
  for (const auto& [name, sides] : sides_of(mesh)) {
    if (sides.size() != 2) continue;
    const auto region = [&](const Side& side) { return mesh.region[static_cast<std::size_t>(side.element)]; };
    for (std::size_t i = 0; i < 2; ++i)
      if (region(sides[i]) == first && region(sides[1 - i]) == second)
        found.push_back({sides[i].element, sides[i].face, sides[1 - i].element});
  }
  return found;
}

std::vector<SharedFace> faces_of_group(const ElementMesh& mesh, const ElementGroup& group) {
  const auto sides = sides_of(mesh);
  std::vector<SharedFace> found;
  for (const MeshElement& element : group.elements) {
    const auto at = sides.find(name_of(element));
    if (at != sides.end() && at->second.size() == 2)
      found.push_back({at->second[0].element, at->second[0].face, at->second[1].element});
  }
  return found;
}

std::vector<Index> elements_beside(const ElementMesh& mesh, const ElementGroup& group) {
  const auto sides = sides_of(mesh);
  std::vector<Index> found;
  for (const MeshElement& element : group.elements) {
    const auto at = sides.find(name_of(element));
    found.push_back(at == sides.end() ? -1 : at->second.front().element);
  }
  return found;
}

std::vector<std::vector<InterfaceFace>> split(ElementMesh& mesh, const std::vector<std::vector<SharedFace>>& cuts) {
  const auto sides = sides_of(mesh);
  std::set<FaceName> cut;
  for (const auto& faces : cuts)
    for (const SharedFace& shared : faces)
      cut.insert(name_of(face_of(element_at(mesh, shared.first), face_at(mesh, shared.first, shared.face))));
  auto clusters = nodes_on(mesh, cut, sides);
  for (const auto& [name, at] : sides) {
    if (at.size() != 2 || cut.contains(name)) continue;
    const MeshElement face = face_of(element_at(mesh, at[0].element), face_at(mesh, at[0].element, at[0].face));
    for (const Index node : face.node_list())
      if (const auto found = clusters.find(node); found != clusters.end()) found->second.join(at[0].element, at[1].element);
  }
  std::vector<std::vector<Index>> beside;
  for (const ElementGroup& group : mesh.groups)
    beside.push_back(group.dimension == mesh.dimension - 1 ? elements_beside(mesh, group) : std::vector<Index>{});
  const Renaming renaming(mesh, clusters);
  std::vector<std::vector<InterfaceFace>> result;
  for (const auto& faces : cuts) {
    auto& list = result.emplace_back();
    for (const SharedFace& shared : faces) {
      const MeshElement face = face_of(element_at(mesh, shared.first), face_at(mesh, shared.first, shared.face));
      list.push_back({face, face});
      renaming.apply(list.back().first, shared.first);
      renaming.apply(list.back().second, shared.second);
    }
  }
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) renaming.apply(mesh.elements[e], static_cast<Index>(e));
  for (std::size_t g = 0; g < mesh.groups.size(); ++g)
    for (std::size_t i = 0; i < beside[g].size(); ++i)
      if (beside[g][i] >= 0) renaming.apply(mesh.groups[g].elements[i], beside[g][i]);
  return result;
}

}  // namespace sazare::geometry
