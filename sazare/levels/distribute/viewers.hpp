#pragma once

/// Which ranks need the motion of a body that another one owns: those that have a body linked to it.

#include <map>
#include <span>
#include <vector>

#include "sazare/core/links.hpp"
#include "sazare/levels/distribute/owners.hpp"
#include "sazare/parallel/ranks.hpp"
#include "sazare/state/bodies.hpp"

namespace sazare::distribute {

/// A rank that sees a body of another one.
struct Viewer {
  int rank = 0;
  bool sees_steps = false;  ///< a link of theirs looks at velocity and spin, see Term::looks_at_steps
};

/// What is sent of a body at a border: what forces need of its motion, for what time it is right, and its strain.
template <int D>
struct BorderBytes {
  std::size_t always = state::bytes_for_forces<D> + sizeof(Tick);
  std::size_t of_steps = sizeof(Vector<D>) + sizeof(Angular<D>);

  explicit BorderBytes(const state::Bodies<D>& bodies) {
    if (!bodies.strain.empty()) always += sizeof(state::Strain);
  }
  std::size_t for_viewer(const Viewer& viewer) const { return always + (viewer.sees_steps ? of_steps : 0); }
};

class Viewers {
public:
  void begin(Index bodies) { by_body_.assign(static_cast<std::size_t>(bodies), {}); }

  /// Shows the two bodies of a link to each other's owner. Returns whether they have two.
  bool add(const Link& link, bool looks_at_steps, const Owners& owners);

  /// Ranks that see a body, without its owner.
  std::span<const Viewer> of(Index body) const { return by_body_[static_cast<std::size_t>(body)]; }

  /// How a rank sees a body. It must see it.
  const Viewer& find(Index body, int rank) const;

  /// How many bodies of a rank others see.
  Index seen_of(int rank, const Owners& owners) const;

  /// What a rank sends about its bodies in a base step, were their active levels to stay as they are: a body at every step of
  /// its level, to every rank that sees it, and what goes to one rank at a tick in one message.
  template <int D, class LevelOf>
  parallel::Sent motion_of(int rank, const Owners& owners, const BorderBytes<D>& bytes, LevelOf&& active_level) const;

private:
  std::vector<std::vector<Viewer>> by_body_;
};

template <int D, class LevelOf>
parallel::Sent Viewers::motion_of(int rank, const Owners& owners, const BorderBytes<D>& bytes, LevelOf&& active_level) const {
  parallel::Sent sum;
  std::map<int, int> finest;  // by rank that sees something: the level of it
  for (const BodyRange& range : owners.ranges(rank))
    for (Index body = range.begin; body < range.end; ++body)
      for (const Viewer& viewer : of(body)) {
        const int level = active_level(body);
        sum.bytes += static_cast<std::int64_t>(bytes.for_viewer(viewer)) << level;
        int& most = finest[viewer.rank];
        most = level > most ? level : most;
      }
  for (const auto& [viewer, level] : finest) sum.messages += std::int64_t{1} << level;
  return sum;
}

}  // namespace sazare::distribute
