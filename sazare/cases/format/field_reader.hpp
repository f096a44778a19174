#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sazare/cases/format/case_text.hpp"
#include "sazare/cases/format/enum_words.hpp"
#include "sazare/core/vector.hpp"

namespace sazare::cases {

/// Fills a struct from one table of the document, with the defaults of the schema for keys that are not
/// given. Values that were found wrong before are left alone.
class FieldReader {
public:
  FieldReader(const Entry& entry, const std::filesystem::path& folder) : entry_(entry), folder_(folder) {}

  template <class Member>
  void operator()(std::string_view key, Member& member) {
    const Key& known = schema_key(key);
    if (entry_.gives(key))
      assign(*entry_.value->find(key), member);
    else if (!entry_.has(key) && !known.default_text.empty())
      assign(default_value(known), member);
  }

  bool has(std::string_view key, bool) const { return entry_.has(key); }

  void friction(Real& coefficient);

private:
  const Key& schema_key(std::string_view key) const;
  static Value default_value(const Key& key);

  void assign(const Value& value, std::string& member) { member = *value.text(); }
  void assign(const Value& value, bool& member) { member = std::get<bool>(value.data); }
  void assign(const Value& value, int& member) { member = static_cast<int>(std::get<std::int64_t>(value.data)); }
  void assign(const Value& value, Real& member);
  void assign(const Value& value, std::optional<Real>& member);
  void assign(const Value& value, Vector3& member);
  void assign(const Value& value, std::filesystem::path& member);
  void assign(const Value& value, std::vector<std::string>& member);
  void assign(const Value& value, std::array<std::string, 2>& member);
  void assign(const Value& value, std::array<bool, 3>& axes);
  void assign(const Value& value, std::vector<std::pair<std::string, Real>>& member);
  void assign(const Value& value, std::vector<std::array<Real, 2>>& member);
  void assign(const Value& value, std::vector<Real>& member);

  template <class Enum>
  requires requires { EnumWords<Enum>::words; }
  void assign(const Value& value, Enum& member) {
    const auto& words = EnumWords<Enum>::words;
    member = static_cast<Enum>(std::ranges::find(words, *value.text()) - words.begin());
  }

  const Entry& entry_;
  const std::filesystem::path& folder_;
};

}  // namespace sazare::cases
