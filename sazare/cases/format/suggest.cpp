#include "sazare/cases/format/suggest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace sazare::cases {
namespace {

std::string lower(std::string_view word) {
  std::string result(word);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

}  // namespace

int edit_distance(std::string_view from, std::string_view to) {
  const std::size_t columns = to.size() + 1;
  std::vector<int> before_last(columns), last(columns), row(columns);
  for (std::size_t j = 0; j < columns; ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= from.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j < columns; ++j) {
      const int replace = last[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1);
      row[j] = std::min({replace, last[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row.back();
}

std::string nearest_word(std::string_view word, std::span<const std::string> candidates) {
  const std::string wanted = lower(word);
  std::string best;
  int best_distance = std::max<int>(1, static_cast<int>(word.size()) / 3) + 1;
  for (const std::string& candidate : candidates) {
    int distance = edit_distance(wanted, lower(candidate));
    const bool is_part = wanted.size() >= 4 && lower(candidate).find(wanted) != std::string::npos;
    if (is_part) distance = std::min(distance, 1);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string quoted_list(std::span<const std::string> words, std::string_view last) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) out += i + 1 == words.size() ? fmt::format(" {} ", last) : ", ";
    out += fmt::format("\"{}\"", words[i]);
  }
  return out;
}

std::string suggestion(std::string_view word, std::span<const std::string> candidates, std::string_view plural) {
  if (candidates.empty()) return fmt::format("there are no {}", plural);
  const std::string near = nearest_word(word, candidates);
  if (!near.empty()) return fmt::format("did you mean \"{}\"?", near);
  if (candidates.size() == 1) return fmt::format("there is only \"{}\"", candidates[0]);
  return fmt::format("the {} are {}", plural, quoted_list(candidates));
}

std::string full_suggestion(std::string_view word, std::span<const std::string> candidates, std::string_view plural) {
  const std::string near = suggestion(word, candidates, plural);
  if (!near.starts_with("did you mean") || candidates.size() == 1) return near;
  return fmt::format("{} the {} are {}", near, plural, quoted_list(candidates));
}

}  // namespace sazare::cases
