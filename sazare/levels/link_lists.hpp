#pragma once

/// The links of every body, in one table: a list for each body would take as much memory again.

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sazare/core/links.hpp"

namespace sazare::levels {

/// A link of one of the terms, in four bytes.
struct LinkOf {
  Index term : 5 = 0;
  Index link : 27 = 0;

  static constexpr Index most_terms = 1 << 4, most_links = 1 << 26;

  friend bool operator==(const LinkOf&, const LinkOf&) = default;
};

class LinkLists {
public:
  /// With room for so many links of each body.
  explicit LinkLists(std::span<const Index> room) : lists_(room.size()) {
    Index place = 0;
    for (std::size_t body = 0; body < room.size(); ++body) {
      lists_[body] = {place, 0, room[body]};
      place += room[body];
    }
    links_.resize(static_cast<std::size_t>(place));
  }

  std::span<const LinkOf> of(Index body) const {
    const List& list = lists_[static_cast<std::size_t>(body)];
    return std::span(links_).subspan(static_cast<std::size_t>(list.begin), static_cast<std::size_t>(list.count));
  }

  /// Adds a link at the end of a body's list, which moves to the end of the table where it has no room.
  void add(Index body, const LinkOf& link) {
    List& list = lists_[static_cast<std::size_t>(body)];
    if (list.count == list.room) make_room(list);
    links_[static_cast<std::size_t>(list.begin + list.count++)] = link;
  }

  /// Takes a link out of a body's list; the others keep their order.
  void remove(Index body, const LinkOf& link) {
    List& list = lists_[static_cast<std::size_t>(body)];
    const auto begin = links_.begin() + list.begin, end = begin + list.count;
    list.count = static_cast<Index>(std::remove(begin, end, link) - begin);
  }

  void clear() {
    for (List& list : lists_) list.count = 0;
  }

private:
  struct List {
    Index begin = 0;
    Index count = 0;
    Index room = 0;
  };

  void make_room(List& list) {
    const std::size_t begin = links_.size();
    const Index room = 2 * list.room + 2;
    if (left_behind_ > static_cast<std::int64_t>(begin) / 2) return gather(list, room);
    left_behind_ += list.room;
    links_.resize(begin + static_cast<std::size_t>(room));
    std::copy_n(links_.begin() + list.begin, list.count, links_.begin() + static_cast<std::ptrdiff_t>(begin));
    list.begin = static_cast<Index>(begin);
    list.room = room;
  }

  /// Lays all lists side by side again, one of them with more room.
  void gather(List& larger, Index room) {
    std::vector<LinkOf> links;
    larger.room = room;
    for (List& list : lists_) {
      const auto begin = static_cast<Index>(links.size());
      links.insert(links.end(), links_.begin() + list.begin, links_.begin() + list.begin + list.count);
      links.resize(static_cast<std::size_t>(begin + list.room));
      list.begin = begin;
    }
    links_ = std::move(links);
    left_behind_ = 0;
  }

  std::vector<List> lists_;
  std::vector<LinkOf> links_;
  std::int64_t left_behind_ = 0;  ///< places of lists that have moved
};

}  // namespace sazare::levels
