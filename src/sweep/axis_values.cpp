#include "axis_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../io/number.hpp"
#include "../io/section.hpp"

namespace slalom::sweep {

std::optional<double> number_of(const io::Value& value) {
  if (value.kind != io::Value::Kind::scalar || value.quoted) return std::nullopt;
  const auto number = io::read_number(value.text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

double finite(const io::Value& value) {
  const auto number = number_of(value);
  if (!number) throw InvalidValue(value.place.to_string(), value.describe(), "a finite number");
  return *number;
}

io::Value scalar(double number, const io::Place& place) {
  io::Value value;
  value.kind = io::Value::Kind::scalar;
  value.place = place;
  value.text = fmt::format("{}", number);
  return value;
}

void only(const io::Value& map, const std::string& path, const std::vector<std::string>& known) {
  io::require_map(map, fmt::format("the map of {}", path));
  for (const auto& member : map.members)
    if (std::find(known.begin(), known.end(), member.key) == known.end())
      io::unknown_key(member.key, member.place, path, known);
}

const std::vector<io::Value>& some_items(const io::Value& value, const std::string& content) {
  const auto& items = io::items_of(value, content);
  if (items.empty()) throw InvalidValue(value.place.to_string(), "an empty list", content);
  return items;
}

}  // namespace slalom::sweep
