#include "study_axes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>

#include "section.hpp"

namespace slalom::io {
namespace {

/// The number a scalar states, or nothing.
std::optional<double> number_of(const Value& value) {
  if (value.kind != Value::Kind::scalar || value.quoted) return std::nullopt;
  const char* end = value.text.data() + value.text.size();
  double number = 0;
  const auto read = std::from_chars(value.text.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

double finite(const Value& value) {
  const auto number = number_of(value);
  if (!number) throw InvalidValue(value.place.to_string(), value.describe(), "a finite number");
  return *number;
}

int count_of(const Value& value, int least) {
  const auto number = number_of(value);
  if (!number || *number != std::floor(*number) || *number < least || *number > kMaxTrials)
    throw InvalidValue(value.place.to_string(), value.describe(),
                       fmt::format("an integer from {} to {}", least, kMaxTrials));
  return static_cast<int>(*number);
}

Value scalar(double number, const Place& place) {
  Value value;
  value.kind = Value::Kind::scalar;
  value.place = place;
  value.text = fmt::format("{}", number);
  return value;
}

/// A value as it stands in tables and identities: numbers in their shortest form.
std::string text_of(const Value& value) {
  if (value.kind == Value::Kind::scalar) {
    const auto number = number_of(value);
    return number ? fmt::format("{}", *number) : value.text;
  }
  if (value.kind != Value::Kind::sequence)
    throw InvalidValue(value.place.to_string(), value.describe(), "a value, or a list of numbers");
  std::vector<std::string> items;
  for (const auto& item : value.items) items.push_back(fmt::format("{}", finite(item)));
  return fmt::format("[{}]", fmt::join(items, ", "));
}

const Value& required(const Value& map, const std::string& key, const std::string& what) {
  const Value* value = map.find(key);
  if (value == nullptr)
    throw InvalidValue(map.place.to_string(), fmt::format("{} without '{}'", what, key),
                       fmt::format("the key '{}'", key));
  return *value;
}

void only(const Value& map, const std::string& path, const std::vector<std::string>& known) {
  require_map(map, fmt::format("the map of {}", path));
  for (const auto& member : map.members)
    if (std::find(known.begin(), known.end(), member.key) == known.end())
      unknown_key(member.key, member.place, path, known);
}

/// The items of a list that must have some.
const std::vector<Value>& some_items(const Value& value, const std::string& content) {
  const auto& items = items_of(value, content);
  if (items.empty()) throw InvalidValue(value.place.to_string(), "an empty list", content);
  return items;
}

/// {from, to, count}: evenly spaced, both ends included and met exactly.
void read_range(const Value& map, PlacedAxis& axis) {
  only(map, "range", {"from", "to", "count"});
  const double from = finite(required(map, "from", "a range"));
  const double to = finite(required(map, "to", "a range"));
  const int count = count_of(required(map, "count", "a range"), 1);
  if (count == 1 && from != to)
    throw InvalidValue(map.place.to_string(), "a range of one value with two ends",
                       "count >= 2, or from = to");
  for (int k = 0; k < count; ++k)
    axis.values.push_back(
        {scalar(k == count - 1 ? to : from + (to - from) * k / (count - 1), map.place)});
}

/// One drawn key: {key, uniform: [low, high]} or {key, normal: [mean, standard deviation]}.
struct Distribution {
  bool normal = false;
  double first = 0, second = 0;

  /// The draws are spelt out, for those of the standard library differ from one to another.
  double operator()(std::mt19937_64& generator) const {
    const auto unit = [&] { return (static_cast<double>(generator() >> 11U) + 0.5) * 0x1p-53; };
    const double u = unit();
    if (!normal) return first + (second - first) * u;
    // Box and Muller.
    return first + second * std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * unit());
  }
};

Distribution read_distribution(const Value& map) {
  only(map, "a draw", {"key", "uniform", "normal"});
  const Value *uniform = map.find("uniform"), *normal = map.find("normal");
  if ((uniform == nullptr) == (normal == nullptr))
    throw InvalidValue(map.place.to_string(), uniform != nullptr ? "two distributions" : "none",
                       "either uniform: [low, high] or normal: [mean, standard deviation]");
  const Value& value = uniform != nullptr ? *uniform : *normal;
  const auto& items = some_items(value, "a list of two numbers");
  if (items.size() != 2)
    throw InvalidValue(value.place.to_string(), fmt::format("{} numbers", items.size()), "two");
  const Distribution d{normal != nullptr, finite(items[0]), finite(items[1])};
  if (!d.normal && !(d.first < d.second))
    throw InvalidValue(items[1].place.to_string(), items[1].describe(), "low < high");
  if (d.normal && !(d.second > 0))
    throw InvalidValue(items[1].place.to_string(), items[1].describe(), "a standard deviation > 0");
  return d;
}

/// {count, of: [...]}: points drawn from the distributions of all keys together.
void read_draw(const Value& map, int seed, std::size_t stream, PlacedAxis& axis) {
  only(map, "draw", {"count", "of"});
  const int count = count_of(required(map, "count", "a draw"), 1);
  const auto& of = some_items(required(map, "of", "a draw"), "a list of keys and distributions");
  std::vector<Distribution> distributions;
  for (const auto& item : of) {
    distributions.push_back(read_distribution(item));
    const Value& key = required(item, "key", "a draw");
    axis.axis.keys.push_back(to_text(key, "a key path"));
    axis.keys.push_back(key.place);
  }
  // Each point of each axis has draws of its own: more points leave the first ones as they were.
  for (int k = 0; k < count; ++k) {
    std::seed_seq mix{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(stream),
                      static_cast<std::uint32_t>(k)};
    std::mt19937_64 generator(mix);
    auto& point = axis.values.emplace_back();
    for (std::size_t i = 0; i < of.size(); ++i)
      point.push_back(scalar(distributions[i](generator), of[i].place));
  }
}

/// values: one a key, or for several keys lists of one value each.
void read_values(const Value& list, PlacedAxis& axis) {
  const auto n = axis.axis.keys.size();
  for (const auto& item : some_items(list, "a list of values")) {
    if (n == 1) {
      axis.values.push_back({item});
      continue;
    }
    const auto content = fmt::format("a list of {} values, one a key", n);
    if (some_items(item, content).size() != n)
      throw InvalidValue(item.place.to_string(), fmt::format("{} values", item.items.size()),
                         content);
    axis.values.push_back(item.items);
  }
}

void read_keys(const Value& map, PlacedAxis& axis) {
  const auto add = [&](const Value& key) {
    axis.axis.keys.push_back(to_text(key, "a key path such as planner.w_t"));
    axis.keys.push_back(key.place);
  };
  const Value *key = map.find("key"), *keys = map.find("keys");
  if (key != nullptr) add(*key);
  if (keys != nullptr)
    for (const auto& item : some_items(*keys, "a list of key paths")) add(item);
}

/// Throws InvalidValue unless the axis has exactly one of the forms it may have.
void check_form(const Value& map) {
  const auto has = [&](const char* key) { return map.find(key) != nullptr; };
  const int points = has("values") + has("range") + has("draw");
  const int keys = has("key") + has("keys");
  if (points == 1 && keys == (has("draw") ? 0 : 1) && !(has("keys") && has("range"))) return;
  throw InvalidValue(map.place.to_string(), "an axis that is none of the known forms",
                     "key and values, keys and values, key and range, or draw");
}

}  // namespace

PlacedAxis read_axis(const Value& map, int seed, std::size_t stream) {
  only(map, "an axis", {"key", "keys", "values", "range", "draw"});
  check_form(map);
  PlacedAxis axis;
  read_keys(map, axis);
  if (const Value* values = map.find("values")) read_values(*values, axis);
  if (const Value* range = map.find("range")) read_range(*range, axis);
  if (const Value* draw = map.find("draw")) read_draw(*draw, seed, stream, axis);
  for (const auto& point : axis.values) {
    auto& texts = axis.axis.points.emplace_back();
    for (const auto& value : point) texts.push_back(text_of(value));
  }
  return axis;
}

}  // namespace slalom::io
