#include "sazare/cases/format/field_reader.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace sazare::cases {

const Key& FieldReader::schema_key(std::string_view key) const {
  const Key* found = find_key(*entry_.table, key);
  if (found == nullptr) throw std::logic_error("key " + std::string(key) + " is missing from the schema");
  return *found;
}

Value FieldReader::default_value(const Key& key) {
  Problems problems;
  const std::string text = "value = " + std::string(key.default_text);
  problems.add_source(source_from_text(std::string(key.name), text));
  auto document = parse_document(text, 0, problems);
  if (!document) throw std::logic_error("default of " + std::string(key.name) + ": " + problems.error_text());
  return *document->find("value");
}

void FieldReader::friction(Real& coefficient) {
  if (!entry_.has("friction_angle")) {
    (*this)("friction_coefficient", coefficient);
    return;
  }
  Real degrees = 0;
  (*this)("friction_angle", degrees);
  coefficient = std::tan(degrees * std::numbers::pi / 180);
}

void FieldReader::assign(const Value& value, Real& member) {
  const auto* whole = std::get_if<std::int64_t>(&value.data);
  member = whole != nullptr ? static_cast<Real>(*whole) : std::get<double>(value.data);
}

void FieldReader::assign(const Value& value, std::optional<Real>& member) {
  Real number = 0;
  assign(value, number);
  member = number;
}

void FieldReader::assign(const Value& value, Vector3& member) {
  for (int axis = 0; axis < 3; ++axis) assign((*value.items())[static_cast<std::size_t>(axis)], member[axis]);
}

void FieldReader::assign(const Value& value, std::filesystem::path& member) {
  member = (folder_ / std::filesystem::path(*value.text())).lexically_normal();
}

void FieldReader::assign(const Value& value, std::vector<std::string>& member) {
  member.clear();
  for (const Value& item : *value.items()) member.push_back(*item.text());
}

void FieldReader::assign(const Value& value, std::array<std::string, 2>& member) {
  for (std::size_t i = 0; i < 2; ++i) member[i] = *(*value.items())[i].text();
}

void FieldReader::assign(const Value& value, std::array<bool, 3>& axes) {
  axes = {false, false, false};
  for (const Value& item : *value.items()) axes.at(static_cast<std::size_t>((*item.text())[0] - 'x')) = true;
}

void FieldReader::assign(const Value& value, std::vector<Real>& member) {
  member.assign(value.items()->size(), 0);
  for (std::size_t i = 0; i < member.size(); ++i) assign((*value.items())[i], member[i]);
}

void FieldReader::assign(const Value& value, std::vector<std::array<Real, 2>>& member) {
  member.clear();
  for (const Value& item : *value.items()) {
    auto& point = member.emplace_back();
    for (std::size_t i = 0; i < 2; ++i) assign((*item.items())[i], point[i]);
  }
}

void FieldReader::assign(const Value& value, std::vector<std::pair<std::string, Real>>& member) {
  member.clear();
  for (const Member& item : *value.members()) {
    member.emplace_back(item.key, 0);
    assign(item.value, member.back().second);
  }
}

}  // namespace sazare::cases
