#include "sazare/levels/level_keeper.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace sazare::levels {

namespace {

/// By body, at the beginning.
template <int D>
std::vector<Index> count_links(const TermList<D>& terms, Index bodies) {
  std::vector<Index> counts(at(bodies), 0);
  for (const auto& term : terms)
    for (const Index number : term->first_links()) {
      const Link& link = term->links()[at(number)];
      for (const Index body : {link.first, link.second})
        if (body != Link::outside) ++counts[at(body)];
    }
  return counts;
}

}  // namespace

template <int D>
LevelKeeper<D>::LevelKeeper(const StepRules& rules, const TermList<D>& terms, const state::Bodies<D>& bodies)
    : rules_(rules),
      clocks_(terms.size()),
      inactive_(terms.size()),
      links_(count_links(terms, bodies.size())),
      level_(at(bodies.size()), 0),
      by_rates_(at(bodies.size())),
      asked_(at(bodies.size()), -1),
      terms_(&terms) {
  if (terms.size() > at(LinkOf::most_terms)) throw std::length_error("more terms than there are numbers for");
  for (std::size_t level = 0; level < steps_.size(); ++level) {
    steps_[level] = rules_.base_step / static_cast<Real>(Tick{1} << level);
    const Real fastest = travel_speed(steps_[level], rules_.travel_length);
    fastest_squared_[level] = fastest * fastest;
  }
  for (Index body = 0; body < bodies.size(); ++body) {
    by_rates_[at(body)] = static_cast<std::int8_t>(wanted_by_rates(body));
    active_levels_.insert(body, 0);
  }
  for (std::size_t term = 0; term < terms.size(); ++term)
    for (const Index link : terms[term]->first_links()) join(term, link, 0);
}

template <int D>
int LevelKeeper<D>::wanted_by_rates(Index body) const {
  if (!rules_.stability) return 0;
  terms::Rates sum;
  for (const auto& term : *terms_) sum += term->rates(body);
  return schedule::level_for(rules_.stability_fraction * stable_step(sum), rules_.base_step);
}

template <int D>
const Link& LevelKeeper<D>::bodies_of(const LinkOf& link) const {
  return (*terms_)[at(link.term)]->links()[at(link.link)];
}

template <int D>
bool LevelKeeper<D>::is_inactive(const LinkOf& of) const {
  const auto& inactive = inactive_[at(of.term)];
  return at(of.link) < inactive.size() && inactive[at(of.link)] != 0;
}

template <int D>
int LevelKeeper<D>::link_level(const LinkOf& of) const {
  if (is_inactive(of)) return 0;
  const Link& link = bodies_of(of);
  const int first = level(link.first);
  return link.second == Link::outside ? first : std::max(first, level(link.second));
}

template <int D>
void LevelKeeper<D>::join(std::size_t term, Index link, Tick now) {
  const Link& bodies = (*terms_)[term]->links()[at(link)];
  if (link >= LinkOf::most_links) throw std::length_error("more links than a process can number");
  const LinkOf of{static_cast<Index>(term), link};
  clocks_[term].add(link, link_level(of), now);
  for (const Index body : {bodies.first, bodies.second}) {
    if (body == Link::outside) continue;
    links_.add(body, of);
    quicken(body, link_level(of));
  }
}

template <int D>
void LevelKeeper<D>::part(std::size_t term, Index link) {
  const Link& bodies = (*terms_)[term]->links()[at(link)];
  clocks_[term].remove(link);
  if (is_inactive({static_cast<Index>(term), link})) inactive_[term][at(link)] = 0;
  for (const Index body : {bodies.first, bodies.second}) {
    if (body == Link::outside) continue;
    links_.remove(body, {static_cast<Index>(term), link});
    calmed_.push_back(body);
  }
}

template <int D>
void LevelKeeper<D>::set_level(Index body, int level) {
  if (level_[at(body)] == level) return;
  const bool calms = level < level_[at(body)];
  level_[at(body)] = static_cast<std::int8_t>(level);
  quicken(body, level);
  if (calms) calmed_.push_back(body);
  for (const LinkOf& of : links_.of(body)) {
    const Link& link = bodies_of(of);
    const int finer = link_level(of);
    clocks_[at(of.term)].set_level(of.link, finer);
    for (const Index other : {link.first, link.second}) {
      if (other == Link::outside) continue;
      quicken(other, finer);
      if (calms && other != body) calmed_.push_back(other);
    }
  }
}

template <int D>
void LevelKeeper<D>::quicken(Index body, int level) {
  if (level <= active_levels_.level(body)) return;
  active_levels_.move(body, level);
  quickened_.push_back(body);
}

template <int D>
std::vector<Index> LevelKeeper<D>::take_quickened(int level) {
  if (quickened_.empty()) return {};
  const auto due = std::ranges::partition(quickened_, [&](Index body) { return active_levels_.level(body) < level; });
  std::vector<Index> taken(due.begin(), due.end());
  quickened_.erase(due.begin(), due.end());
  return taken;
}

/// The active level that a body is to have: the finest one among its links and its own.
template <int D>
int LevelKeeper<D>::finest_around(Index body) const {
  int finest = level(body);
  for (const LinkOf& of : links_.of(body)) finest = std::max(finest, link_level(of));
  return finest;
}

/// Lowers the active level of bodies whose links or neighbours have become coarser or have ended.
template <int D>
void LevelKeeper<D>::slow_down() {
  for (const Index body : calmed_)
    if (const int active = finest_around(body); active != active_levels_.level(body)) active_levels_.move(body, active);
  calmed_.clear();
}

template <int D>
void LevelKeeper<D>::ask(Index body, int level) {
  if (level <= level_[at(body)]) return;
  auto& asked = asked_[at(body)];
  if (asked < 0) asking_.push_back(body);
  asked = std::max(asked, static_cast<std::int8_t>(level));
}

/// Whoever is linked to a body of this level may be coarser by `neighbor_levels` at most.
template <int D>
void LevelKeeper<D>::ask_neighbors(Index body) {
  const int least = level(body) - rules_.neighbor_levels;
  if (least <= 0) return;
  for (const LinkOf& of : links_.of(body)) {
    const Link& link = bodies_of(of);
    if (link.second != Link::outside) ask(link.first == body ? link.second : link.first, least);
  }
}

template <int D>
void LevelKeeper<D>::set_inactive(const LinkOf& of, bool is_inactive) {
  auto& inactive = inactive_[at(of.term)];
  if (inactive.size() <= at(of.link)) inactive.resize(at(of.link) + 1, 0);
  inactive[at(of.link)] = is_inactive;
  const int level = link_level(of);
  clocks_[at(of.term)].set_level(of.link, level);
  for (const Index body : {bodies_of(of).first, bodies_of(of).second}) {
    if (body == Link::outside) continue;
    quicken(body, level);
    if (is_inactive) calmed_.push_back(body);
  }
}

/// Raises levels until linked bodies differ by `neighbor_levels` at most: from the finest level downwards, each body once
/// per level.
template <int D>
void LevelKeeper<D>::spread(std::vector<std::int8_t>& wanted) const {
  std::array<std::span<const Link>, LinkOf::most_terms> links;  // asked for once: it takes as long as a link
  for (std::size_t term = 0; term < terms_->size(); ++term) links[term] = (*terms_)[term]->links();
  std::array<std::vector<Index>, schedule::level_count> at_level;
  for (Index body = 0; body < static_cast<Index>(wanted.size()); ++body)
    if (wanted[at(body)] > rules_.neighbor_levels) at_level[static_cast<std::size_t>(wanted[at(body)])].push_back(body);
  for (int level = schedule::deepest_level; level > rules_.neighbor_levels; --level) {
    const auto& bodies = at_level[static_cast<std::size_t>(level)];
    for (std::size_t next = 0; next < bodies.size(); ++next) {  // grows while it is walked where no difference is allowed
      const Index body = bodies[next];
      if (wanted[at(body)] != level) continue;
      const int least = level - rules_.neighbor_levels;
      for (const LinkOf& of : links_.of(body)) {
        const Link& link = links[at(of.term)][at(of.link)];
        if (link.second == Link::outside) continue;
        const Index other = link.first == body ? link.second : link.first;
        if (wanted[at(other)] >= least) continue;
        wanted[at(other)] = static_cast<std::int8_t>(least);
        at_level[static_cast<std::size_t>(least)].push_back(other);
      }
    }
  }
}

template <int D>
void LevelKeeper<D>::relevel(const state::Bodies<D>& bodies) {
  choose_levels(bodies);
  quickened_ = {};  // all are due, and none had planned beyond a base step
}

template <int D>
void LevelKeeper<D>::choose_levels(const state::Bodies<D>& bodies) {
  for (const Index body : asking_) asked_[at(body)] = -1;
  asking_.clear();
  slow_down();
  active_levels_.sort();
  for (auto& clock : clocks_) clock.sort();
  const bool travels = rules_.travel_length < std::numeric_limits<Real>::infinity();
  if (!stale_ && !travels) return;
  std::vector<std::int8_t> wanted = relaxes_ ? std::vector<std::int8_t>(by_rates_.size(), 0) : by_rates_;
  if (travels)
    for (Index body = 0; body < bodies.size(); ++body)
      wanted[at(body)] =
          static_cast<std::int8_t>(level_for_speed(wanted[at(body)], bodies.motion[at(body)].velocity.squaredNorm()));
  if (rules_.uniform)
    std::fill(wanted.begin(), wanted.end(), wanted.empty() ? std::int8_t{0} : *std::max_element(wanted.begin(), wanted.end()));
  else
    spread(wanted);
  for (Index body = 0; body < bodies.size(); ++body) set_level(body, wanted[at(body)]);
  slow_down();
  stale_ = false;
}

template <int D>
void LevelKeeper<D>::refine_asked() {
  if (asking_.empty()) return;
  if (rules_.uniform) {
    const int level = *std::max_element(asked_.begin(), asked_.end());
    for (Index body = 0; body < static_cast<Index>(level_.size()); ++body) ask(body, level);
  }
  stale_ = true;
  for (std::size_t next = 0; next < asking_.size(); ++next) {  // grows while it is walked
    const Index body = asking_[next];
    const int asked = std::exchange(asked_[at(body)], std::int8_t{-1});
    if (asked > level(body)) set_level(body, asked);
    ask_neighbors(body);
  }
  asking_.clear();
}

template <int D>
void LevelKeeper<D>::refined(Index body, int level) {
  set_level(body, level);
  stale_ = true;
  if (rules_.uniform) {
    for (Index other = 0; other < static_cast<Index>(asked_.size()); ++other) ask(other, level);
    return;
  }
  ask_neighbors(body);
}

template <int D>
void LevelKeeper<D>::apply(std::size_t term, const terms::Changes& changes, Tick now) {
  for (const Index link : changes.ended_links)
    if (clocks_[term].holds(link)) part(term, link);
  for (const Index link : changes.new_links) {
    const Link& bodies = (*terms_)[term]->links()[at(link)];
    if (bodies.first == Link::outside) continue;  // begun and ended in the same step
    join(term, link, now);
    if (bodies.second == Link::outside) continue;
    ask(bodies.first, level(bodies.second) - rules_.neighbor_levels);
    ask(bodies.second, level(bodies.first) - rules_.neighbor_levels);
  }
  // A link that has ended in the same step is neither inactive nor watched.
  for (const Index link : changes.inactive)
    if (clocks_[term].holds(link)) set_inactive({static_cast<Index>(term), link}, true);
  for (const Index link : changes.watching)
    if (clocks_[term].holds(link)) set_inactive({static_cast<Index>(term), link}, false);
  for (const Index body : changes.softer) by_rates_[at(body)] = static_cast<std::int8_t>(wanted_by_rates(body));
  for (const Index body : changes.stiffer) {
    by_rates_[at(body)] = static_cast<std::int8_t>(wanted_by_rates(body));
    if (!relaxes_) ask(body, by_rates_[at(body)]);
  }
  stale_ = stale_ || !changes.softer.empty() || !changes.stiffer.empty() || !changes.new_links.empty();
}

template <int D>
void LevelKeeper<D>::look_again(std::span<const Index> bodies) {
  for (const Index body : bodies) by_rates_[at(body)] = static_cast<std::int8_t>(wanted_by_rates(body));
  stale_ = true;
}

template <int D>
void LevelKeeper<D>::columns(Archive& archive) {
  std::vector<std::int8_t> active = active_levels_.levels();
  archive("level", level_);
  archive("active_level", active);
  archive("by_rates", by_rates_);
  archive("asked", asked_);
  archive("asking", asking_);
  archive("calmed", calmed_);
  archive("quickened", quickened_);
  std::int8_t stale = stale_;
  archive("stale", stale);
  for (std::size_t term = 0; term < clocks_.size(); ++term)
    archive.folder(std::string((*terms_)[term]->name()), [&] {
      clocks_[term].columns(archive);
      archive("inactive", inactive_[term]);
    });
  if (!archive.reading()) return;
  stale_ = stale != 0;
  active_levels_.assign(std::move(active));
  links_.clear();
  for (std::size_t term = 0; term < clocks_.size(); ++term) {
    const auto links = (*terms_)[term]->links();
    for (Index link = 0; link < static_cast<Index>(links.size()); ++link)
      if (clocks_[term].holds(link))
        for (const Index body : {links[at(link)].first, links[at(link)].second})
          if (body != Link::outside) links_.add(body, {static_cast<Index>(term), link});
  }
}

template class LevelKeeper<2>;
template class LevelKeeper<3>;

}  // namespace sazare::levels
