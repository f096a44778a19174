#pragma once

#include <span>
#include <string>
#include <string_view>

/// "Did you mean": the nearest of the words that would have been right.
namespace sazare::cases {

/// Number of characters to insert, delete, replace or swap with their neighbour to turn one word into the
/// other.
int edit_distance(std::string_view from, std::string_view to);

/// The nearest candidate, or an empty string when none is near enough to be what was meant.
std::string nearest_word(std::string_view word, std::span<const std::string> candidates);

/// `did you mean "x"?` where one is near, otherwise the list of what exists.
std::string suggestion(std::string_view word, std::span<const std::string> candidates, std::string_view plural);

/// Like `suggestion`, but always followed by the list of candidates.
std::string full_suggestion(std::string_view word, std::span<const std::string> candidates, std::string_view plural);

/// "a", "b" and "c"
std::string quoted_list(std::span<const std::string> words, std::string_view last = "and");

}  // namespace sazare::cases
