#include "section.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <numbers>
#include <optional>
#include <string_view>

#include "number.hpp"
#include "number_file.hpp"

namespace slalom::io {
namespace {

/// A number, or nothing; whole ones as such.
std::optional<OptionValue> to_number(std::string_view text) {
  const auto number = read_number(text);
  if (!number) return std::nullopt;
  const bool negative = text.starts_with('-');
  if (text.starts_with('+')) text.remove_prefix(1);
  const char* end = text.data() + text.size();
  std::int64_t integer = 0;
  const auto read = std::from_chars(text.data(), end, integer);
  // -0 stays a real number, so that it keeps its sign.
  if (read.ec == std::errc() && read.ptr == end && (integer != 0 || !negative)) return integer;
  return *number;
}

OptionValue scalar_value(const Value& value) {
  if (!value.quoted) {
    if (value.text == "true") return true;
    if (value.text == "false") return false;
    if (const auto number = to_number(value.text)) return *number;
  }
  return "'" + value.text + "'";
}

OptionValue list_value(const Value& value) {
  std::vector<double> numbers;
  for (const auto& item : value.items) {
    const auto number =
        item.kind == Value::Kind::scalar && !item.quoted ? to_number(item.text) : std::nullopt;
    if (!number) throw InvalidValue(item.place.to_string(), item.describe(), "a number");
    numbers.push_back(std::holds_alternative<double>(*number)
                          ? std::get<double>(*number)
                          : static_cast<double>(std::get<std::int64_t>(*number)));
  }
  return numbers;
}

/// The inner value of {value: ..., unit: ..., source: ...}.
const Value& unwrap(const OptionInfo& info, const Value& map) {
  for (const auto& member : map.members)
    if (member.key != "value" && member.key != "unit" && member.key != "source")
      unknown_key(member.key, member.place, info.name, {"value", "unit", "source"});
  const Value* value = map.find("value");
  if (value == nullptr)
    throw InvalidValue(map.place.to_string(), fmt::format("a map without value for {}", info.name),
                       fmt::format("{} or {{value: ..., unit: ...}}", rule_of(info)));
  if (const Value* unit = map.find("unit")) {
    const auto& text = to_text(*unit, "a unit");
    if (text != info.unit)
      throw InvalidValue(unit->place.to_string(), fmt::format("unit '{}' of {}", text, info.name),
                         info.unit.empty() ? "no unit" : fmt::format("'{}'", info.unit));
  }
  if (const Value* source = map.find("source")) to_text(*source, "a source");
  return *value;
}

}  // namespace

std::string rule_of(const OptionInfo& info) {
  const bool may_be_file = info.kind == OptionKind::vector && info.length == 0;
  return info.rule() + (may_be_file ? ", or a file of them" : "");
}

void unknown_key(const std::string& key, const Place& place, const std::string& path,
                 const std::vector<std::string>& known) {
  const auto nearest = nearest_name(key, known);
  const auto of = path.empty() ? std::string() : " of " + path;
  throw InvalidValue(place.to_string(), fmt::format("unknown key '{}'{}", key, of),
                     nearest.empty() ? fmt::format("one of {}", fmt::join(known, ", "))
                                     : fmt::format("a known one (did you mean '{}'?)", nearest));
}

void require_map(const Value& value, const std::string& content) {
  if (value.kind != Value::Kind::map)
    throw InvalidValue(value.place.to_string(), value.describe(), content);
}

const Value& require_key(const Value& map, const std::string& what, const std::string& key) {
  const Value* value = map.find(key);
  if (value == nullptr)
    throw InvalidValue(map.place.to_string(), fmt::format("{} without '{}'", what, key),
                       fmt::format("the key '{}'", key));
  return *value;
}

const std::vector<Value>& items_of(const Value& list, const std::string& content) {
  if (list.kind != Value::Kind::sequence)
    throw InvalidValue(list.place.to_string(), list.describe(), content);
  return list.items;
}

const std::string& to_text(const Value& value, const std::string& what) {
  if (value.kind != Value::Kind::scalar)
    throw InvalidValue(value.place.to_string(), value.describe(), what);
  return value.text;
}

OptionValue to_option_value(const OptionInfo& info, const Value& value) {
  switch (value.kind) {
    case Value::Kind::null:
      throw InvalidValue(value.place.to_string(), fmt::format("nothing for {}", info.name),
                         rule_of(info));
    case Value::Kind::map:
      if (const Value& inner = unwrap(info, value); inner.kind != Value::Kind::map)
        return to_option_value(info, inner);
      throw InvalidValue(value.place.to_string(), fmt::format("a map for {}", info.name),
                         rule_of(info));
    case Value::Kind::sequence:
      if (info.kind != OptionKind::vector)
        throw InvalidValue(value.place.to_string(), fmt::format("a list for {}", info.name),
                           rule_of(info));
      return list_value(value);
    case Value::Kind::scalar:
      if (info.kind == OptionKind::text || info.kind == OptionKind::choice) return value.text;
      if (info.kind == OptionKind::vector && info.length == 0) return read_numbers(info, value);
      return scalar_value(value);
  }
  return value.text;
}

Section& Section::add(Field field) {
  fields_.push_back(std::move(field));
  return *this;
}

Section& Section::add_degrees(const std::string& key) {
  const Field base = *find(key);
  Field degrees = base;
  degrees.info.name = key + "_deg";
  degrees.info.unit = "deg";
  degrees.info.range = OptionRange::any();
  degrees.info.doc = "The same in degrees.";
  // Division first: 90 / 180 is exact, so 90 gives pi/2 to the bit.
  degrees.store = [base](const OptionValue& value) {
    base.store(std::get<double>(value) / 180 * std::numbers::pi);
  };
  degrees.load = [base] {
    return OptionValue(std::get<double>(base.load()) / std::numbers::pi * 180);
  };
  degrees.excludes = {key};
  return add(std::move(degrees));
}

std::vector<std::string> Section::keys() const {
  std::vector<std::string> names;
  for (const auto& field : fields_) names.push_back(field.info.name);
  return names;
}

const Field* Section::find(const std::string& key) const {
  for (const auto& field : fields_)
    if (field.info.name == key) return &field;
  return nullptr;
}

void Section::read(const Value& map, Places& places, const std::vector<std::string>& others) const {
  require_map(map, fmt::format("the map of {}", path_));
  auto known = keys();
  known.insert(known.end(), others.begin(), others.end());
  for (const auto& member : map.members) {
    if (std::find(others.begin(), others.end(), member.key) != others.end()) continue;
    const Field* field = find(member.key);
    if (field == nullptr) unknown_key(member.key, member.place, path_, known);
    for (const auto& other : field->excludes)
      if (map.find(other) != nullptr)
        throw InvalidValue(member.place.to_string(),
                           fmt::format("both {} and {}", member.key, other), "one of them");
    set(member.key, member.value, member.place, places);
  }
}

void Section::set(const std::string& key, const Value& value, const Place& key_place,
                  Places& places) const {
  const Field* field = find(key);
  if (field == nullptr) unknown_key(key, key_place, path_, keys());
  field->store(field->info.checked(to_option_value(field->info, value), value.place.to_string()));
  places[path_ + "." + key] = value.place;
  for (const auto& other : field->excludes) places[path_ + "." + other] = value.place;
}

}  // namespace slalom::io
