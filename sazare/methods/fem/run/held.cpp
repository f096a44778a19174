#include "sazare/methods/fem/run/held.hpp"

#include <fmt/format.h>

#include <numeric>
#include <set>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/format/counted.hpp"

namespace sazare::runs {
namespace {

/// Nodes that hang together.
class Parts {
public:
  explicit Parts(std::size_t nodes) : parent_(nodes) { std::iota(parent_.begin(), parent_.end(), Index{0}); }

  Index of(Index node) {
    while (parent_[at(node)] != node) node = parent_[at(node)] = parent_[at(parent_[at(node)])];
    return node;
  }

  template <class Nodes>
  void unite(const Nodes& nodes) {
    for (const Index node : nodes) parent_[at(of(node))] = of(nodes[0]);
  }

private:
  std::vector<Index> parent_;
};

template <int D>
Parts find_parts(const FemModel<D>& model) {
  const auto& body = model.stepper->body();
  Parts parts(model.mesh().nodes.size());
  for (const geometry::MeshElement& element : model.mesh().elements) parts.unite(element.node_list());
  for (std::size_t i = 0; i < body.joints().size(); ++i) parts.unite(body.joints().nodes(i));
  for (const auto& [node, other] : model.stepper->supports().tied) parts.unite(std::array{node, other});
  for (std::size_t i = 0; i < body.members().size(); ++i) parts.unite(body.members().nodes(i).first(2));
  return parts;
}

/// Axes along which each node is carried at rest, a bit per axis.
template <int D>
std::vector<int> carried_axes(const FemModel<D>& model) {
  const auto& supports = model.stepper->supports();
  std::vector<int> axes(model.mesh().nodes.size(), 0);
  for (const auto& support : supports.held)
    if (at(support.node) < axes.size()) axes[at(support.node)] |= 1 << support.axis;
  for (const auto& boundary : supports.viscous)
    for (const Index node : boundary.nodes) axes[at(node)] |= (1 << D) - 1;
  for (const auto& side : supports.sides)
    for (const Index node : side.nodes) axes[at(node)] |= 1 << side.across;
  return axes;
}

std::string axis_names(int axes) {
  std::string names;
  for (int axis = 0; axis < 3; ++axis)
    if (axes >> axis & 1) names += fmt::format("{}{}", names.empty() ? "" : ", ", "xyz"[axis]);
  return names;
}

}  // namespace

template <int D>
std::string held_text(const FemModel<D>& model, Real end) {
  constexpr int all = (1 << D) - 1;
  const auto& nodes = model.mesh().nodes;
  const std::vector<int> axes = carried_axes(model);
  Parts parts = find_parts(model);
  std::set<Index> there, held;
  for (const geometry::MeshElement& element : model.mesh().elements) there.insert(parts.of(element.node_list()[0]));
  int held_axes = 0;
  std::int64_t count = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (axes[i] == 0) continue;
    ++count;
    held_axes |= axes[i];
    held.insert(parts.of(static_cast<Index>(i)));
  }
  std::string text = cases::counted(count, "nodes");
  if (held_axes != all && count > 0)
    text += fmt::format(" along {}; nothing is held along {}", axis_names(held_axes), axis_names(all & ~held_axes));
  const auto free = std::ranges::find_if(there, [&](Index part) { return !held.contains(part); });
  if (free == there.end()) return cases::line("held", text);
  const auto loose = std::ranges::count_if(there, [&](Index part) { return !held.contains(part); });
  text += there.size() == 1 ? std::string("; nothing holds the body")
                            : fmt::format("; nothing holds {} of {} parts, such as that of the node at {} m", loose, there.size(),
                                          cases::vector_text(nodes[at(*free)]));
  if (const Real fall = 0.5 * model.stepper->supports().gravity.norm() * end * end; fall > 0)
    text += fmt::format(", which falls {} m in the time of the run", cases::number(fall));
  return cases::line("held", text);
}

template std::string held_text(const FemModel<2>&, Real);
template std::string held_text(const FemModel<3>&, Real);

}  // namespace sazare::runs
