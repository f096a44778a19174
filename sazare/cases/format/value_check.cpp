#include "sazare/cases/format/value_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/suggest.hpp"
#include "sazare/cases/format/units.hpp"
#include "sazare/cases/format/usual_values.hpp"

namespace sazare::cases {
namespace {

std::optional<Real> number_in(const Value& value) {
  if (const auto* real = std::get_if<double>(&value.data)) return *real;
  if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return static_cast<Real>(*whole);
  return std::nullopt;
}

class ValueCheck {
public:
  ValueCheck(const Key& key, Problems& problems) : key_(key), problems_(problems) {}

  bool accepts(Value& value) {
    switch (key_.type) {
      case Type::text:
      case Type::file:
        return is_text(value);
      case Type::choice:
        return is_choice(value);
      case Type::boolean:
        return is_boolean(value);
      case Type::number:
        return is_number(value);
      case Type::integer:
        return is_integer(value);
      case Type::vector:
        return is_vector(value);
      case Type::names:
        return is_list_of_names(value, 1, 0);
      case Type::two_names:
        return is_list_of_names(value, 2, 2);
      case Type::axes:
        return is_axes(value);
      case Type::numbers:
        return is_numbers(value);
      case Type::points:
        return is_points(value);
      case Type::values:
        return is_values(value);
    }
    return false;
  }

private:
  bool refuse(const Value& value, std::string help) {
    problems_.error(value.place, fmt::format("{}: {} was expected, found {}", key_.name, type_text(key_), describe(value)),
                    std::move(help));
    return false;
  }

  bool is_text(const Value& value) {
    if (value.text() == nullptr) return refuse(value, "enclose the text in double quotes");
    return is_good_text(value);
  }

  bool is_good_text(const Value& value) {
    const std::string& text = *value.text();
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    if (!text.empty() && std::ranges::none_of(text, is_control)) return true;
    const std::string subject =
        std::string(key_.name) + (key_.type == Type::names || key_.type == Type::two_names ? ": a name" : "");
    const std::string what = text.empty() ? "is empty" : "contains a control character, such as a line break";
    problems_.error(value.place, fmt::format("{} {}", subject, what), std::string(key_.sentence));
    return false;
  }

  bool is_choice(const Value& value) {
    const std::vector<std::string> words(key_.choices.begin(), key_.choices.end());
    if (value.text() == nullptr) return refuse(value, "enclose the word in double quotes");
    if (std::ranges::find(words, *value.text()) != words.end()) return true;
    const std::string near = nearest_word(*value.text(), words);
    return refuse(value, near.empty() ? std::string(key_.sentence) : fmt::format("did you mean \"{}\"?", near));
  }

  bool is_boolean(const Value& value) {
    return std::holds_alternative<bool>(value.data) || refuse(value, "write true or false without quotes");
  }

  std::string assignment() const { return fmt::format("{} = ", key_.name); }

  std::string help_for_number(const Value& value) const {
    const auto quantity = value.text() != nullptr ? parse_quantity(*value.text()) : std::nullopt;
    if (!quantity) return std::string(key_.sentence);
    const std::string in_unit = key_.unit.empty() ? "it has no unit" : fmt::format("the unit is {}", key_.unit);
    if (const auto number = converted(*quantity, key_.unit))
      return fmt::format("write {}{}, without quotes and unit; {}", key_.type == Type::vector ? "" : assignment(),
                         short_number(*number, 12), in_unit);
    return fmt::format("write the number alone; {}, and \"{}\" is not a unit of that kind", in_unit, quantity->unit);
  }

  bool is_number(const Value& value) {
    const auto number = number_in(value);
    if (!number) return refuse(value, help_for_number(value));
    if (!is_in_range(value, *number)) return false;
    return warn_of_unusual(key_, value, *number, problems_);
  }

  bool is_in_range(const Value& value, Real number) {
    const bool finite = std::isfinite(number) || (key_.range.infinite && number > 0 && !std::isnan(number));
    if (finite && in_range(key_.range, number)) return true;
    std::string range = finite || std::isinf(number) ? range_text(key_.range) : "";
    if (!finite) range = range.empty() ? "a finite number" : "finite and " + range;
    const std::string unit = key_.unit.empty() ? "" : fmt::format(" {}", key_.unit);
    problems_.error(value.place, fmt::format("{} must be {}, found {}{}", key_.name, range, short_number(number, 12), unit),
                    std::string(key_.sentence));
    return false;
  }

  bool is_integer(const Value& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return is_in_range(value, static_cast<Real>(*whole));
    return refuse(value, std::string(key_.sentence));
  }

  bool is_vector(Value& value) {
    const auto* items = value.items();
    if (items == nullptr || items->size() != 3) return refuse(value, "write [x, y, z]");
    bool good = true;
    for (const Value& item : *items) {
      if (number_in(item)) {
        good = is_in_range(item, *number_in(item)) && warn_of_unusual(key_, item, *number_in(item), problems_) && good;
        continue;
      }
      problems_.error(item.place, fmt::format("{}: a number was expected, found {}", key_.name, describe(item)),
                      help_for_number(item));
      good = false;
    }
    return good;
  }

  bool is_list_of_names(const Value& value, std::size_t least, std::size_t most) {
    const auto* items = value.items();
    const bool one_name = value.text() != nullptr && most != 2;
    if (one_name) return refuse(value, fmt::format("write {} = [{}]", key_.name, string_text(*value.text())));
    if (items == nullptr || items->size() < least || (most > 0 && items->size() > most))
      return refuse(value, std::string(key_.sentence));
    bool good = true;
    for (auto item = items->begin(); item != items->end(); ++item) {
      if (item->text() == nullptr) {
        problems_.error(item->place, fmt::format("{}: a name was expected, found {}", key_.name, describe(*item)),
                        "enclose names in double quotes");
        good = false;
        continue;
      }
      good = is_good_text(*item) && good;
      const auto same = [&](const Value& other) { return other.text() != nullptr && *other.text() == *item->text(); };
      if (most == 2 || std::none_of(items->begin(), item, same)) continue;
      problems_.error(item->place, fmt::format("{}: \"{}\" occurs twice in the list", key_.name, *item->text()),
                      "write each name once");
      good = false;
    }
    return good;
  }

  bool is_axes(const Value& value) {
    const auto* items = value.items();
    if (items == nullptr) return refuse(value, fmt::format("write {} = [\"x\", \"z\"], for example", key_.name));
    bool good = true;
    for (const Value& item : *items) {
      const std::string axis = item.text() != nullptr ? *item.text() : "";
      if (axis == "x" || axis == "y" || axis == "z") continue;
      problems_.error(item.place, fmt::format("{}: an axis was expected, found {}", key_.name, describe(item)),
                      "the axes are \"x\", \"y\" and \"z\"");
      good = false;
    }
    return good;
  }

  bool is_values(const Value& value) {
    const auto* items = value.items();
    if (items == nullptr || items->empty()) return refuse(value, "write [1.0, 2.0], for example");
    bool good = true;
    for (const Value& item : *items) {
      if (number_in(item)) {
        good = is_in_range(item, *number_in(item)) && good;
        continue;
      }
      problems_.error(item.place, fmt::format("{}: a number was expected, found {}", key_.name, describe(item)),
                      help_for_number(item));
      good = false;
    }
    return good;
  }

  bool is_points(const Value& value) {
    const auto* items = value.items();
    if (items == nullptr || items->size() < 3) return refuse(value, "write [[x, y], [x, y], [x, y]]");
    bool good = true;
    for (const Value& item : *items) {
      const auto* pair = item.items();
      const auto is_finite = [](const Value& part) { return number_in(part) && std::isfinite(*number_in(part)); };
      if (pair != nullptr && pair->size() == 2 && std::ranges::all_of(*pair, is_finite)) continue;
      problems_.error(item.place, fmt::format("{}: a point [x, y] was expected, found {}", key_.name, describe(item)),
                      "a point is a list of two finite numbers");
      good = false;
    }
    return good;
  }

  bool is_numbers(const Value& value) {
    if (!value.is_table()) return refuse(value, std::string(key_.sentence));
    bool good = true;
    for (const Member& member : *value.members()) {
      const auto number = number_in(member.value);
      if (number && std::isfinite(*number)) continue;
      problems_.error(member.value.place,
                      fmt::format("{}: a finite number was expected, found {}", member.key, describe(member.value)),
                      std::string(key_.sentence));
      good = false;
    }
    return good;
  }

  const Key& key_;
  Problems& problems_;
};

}  // namespace

void check_value(const Key& key, Value& value, Problems& problems) {
  if (!ValueCheck(key, problems).accepts(value)) value.wrong = true;
}

}  // namespace sazare::cases
