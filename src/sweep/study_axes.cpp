#include "study_axes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "../io/number_file.hpp"
#include "../io/section.hpp"
#include "axis_values.hpp"
#include "slalom/base/options.hpp"
#include "study_draws.hpp"

namespace slalom::sweep {
namespace {

int count_of(const io::Value& value, int least) {
  const auto number = number_of(value);
  if (!number || *number != std::floor(*number) || *number < least || *number > kMaxTrials)
    throw InvalidValue(value.place.to_string(), value.describe(),
                       fmt::format("an integer from {} to {}", least, kMaxTrials));
  return static_cast<int>(*number);
}

/// Adds a key's next value as it stands in tables and identities: numbers in their shortest form.
void add_value(const io::Value& value, std::size_t key, AxisPoints& points) {
  if (value.kind == io::Value::Kind::scalar) {
    if (const auto number = number_of(value)) return points.add(key, *number);
    return points.add(key, value.text);
  }
  if (value.kind != io::Value::Kind::sequence)
    throw InvalidValue(value.place.to_string(), value.describe(), "a value, or a list of numbers");
  std::vector<std::string> items;
  for (const auto& item : value.items) items.push_back(fmt::format("{}", finite(item)));
  points.add(key, fmt::format("[{}]", fmt::join(items, ", ")));
}

io::Value* member_of(io::Value& map, const char* key) {
  for (auto& member : map.members)
    if (member.key == key) return &member.value;
  return nullptr;
}

/// {from, to, count}: evenly spaced, both ends included and met exactly.
void read_range(const io::Value& map, PlacedAxis& axis) {
  only(map, "range", {"from", "to", "count"});
  const double from = finite(io::require_key(map, "a range", "from"));
  const double to = finite(io::require_key(map, "a range", "to"));
  const int count = count_of(io::require_key(map, "a range", "count"), 1);
  if (count == 1 && from != to)
    throw InvalidValue(map.place.to_string(), "a range of one value with two ends",
                       "count >= 2, or from = to");
  for (int k = 0; k < count; ++k)
    axis.axis.points.add(0, k == count - 1 ? to : from + (to - from) * k / (count - 1));
  axis.computed = {map.place};
}

Sampling read_sampling(const io::Value& map) {
  const io::Value* method = map.find("method");
  if (method == nullptr) return Sampling::random;
  static const std::vector<std::string> names = {"random", "latin_hypercube", "sobol"};
  const auto& name = io::to_text(*method, "the name of a method");
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw InvalidValue(method->place.to_string(), fmt::format("method '{}'", name),
                       one_of(name, names));
  return static_cast<Sampling>(found - names.begin());
}

/// {count, of: [...], method}: points drawn from the distributions of all keys together.
void read_draw(const io::Value& map, int seed, std::size_t stream, PlacedAxis& axis) {
  only(map, "draw", {"count", "of", "method"});
  const int count = count_of(io::require_key(map, "a draw", "count"), 1);
  const auto& of =
      some_items(io::require_key(map, "a draw", "of"), "a list of keys and distributions");
  if (std::int64_t{count} * static_cast<std::int64_t>(of.size()) > kMaxDrawn)
    throw InvalidValue(map.place.to_string(), fmt::format("{} points of {} keys", count, of.size()),
                       fmt::format("at most {} values in one draw", kMaxDrawn));
  axis.drawn = true;
  std::vector<Distribution> distributions;
  for (const auto& item : of) {
    const auto& drawn = distributions.emplace_back(read_distribution(item));
    const io::Value& key = io::require_key(item, "a draw", "key");
    axis.axis.keys.push_back(io::to_text(key, "a key path"));
    axis.keys.push_back(key.place);
    axis.listed.push_back(drawn.choices);
    axis.computed.push_back(drawn.place);
  }
  const auto sampling = read_sampling(map);
  if (sampling == Sampling::sobol && of.size() > max_sobol_dimension())
    throw InvalidValue(map.place.to_string(), fmt::format("{} keys", of.size()),
                       fmt::format("at most {} for sobol", max_sobol_dimension()));
  for (auto& u : unit_points(sampling, count, of.size(), seed, stream)) {
    for (std::size_t i = 0; i < of.size(); ++i) {
      const auto& drawn = distributions[i];
      if (drawn.choices.empty())
        axis.axis.points.add(i, drawn.quantile(u[i]));
      else
        add_value(drawn.chosen(u[i]), i, axis.axis.points);
    }
    u = {};  // its memory goes to the values
  }
}

/// values: one for each key, or for several keys lists of one value each.
void read_values(const io::Value& list, PlacedAxis& axis) {
  const auto n = axis.axis.keys.size();
  axis.listed.resize(n);
  const auto add = [&](const io::Value& value, std::size_t key) {
    axis.listed[key].push_back(&value);
    add_value(value, key, axis.axis.points);
  };
  for (const auto& item : some_items(list, "a list of values")) {
    if (n == 1) {
      add(item, 0);
      continue;
    }
    const auto content = fmt::format("a list of {} values, one for each key", n);
    if (some_items(item, content).size() != n)
      throw InvalidValue(item.place.to_string(), fmt::format("{} values", item.items.size()),
                         content);
    for (std::size_t i = 0; i < n; ++i) add(item.items[i], i);
  }
}

void read_keys(const io::Value& map, PlacedAxis& axis) {
  const auto add = [&](const io::Value& key) {
    axis.axis.keys.push_back(io::to_text(key, "a key path such as planner.w_t"));
    axis.keys.push_back(key.place);
  };
  const io::Value *key = map.find("key"), *keys = map.find("keys");
  if (key != nullptr) add(*key);
  if (keys != nullptr)
    for (const auto& item : some_items(*keys, "a list of key paths")) add(item);
}

/// Throws InvalidValue unless the axis has exactly one of the forms it may have.
void check_form(const io::Value& map) {
  const auto has = [&](const char* key) { return map.find(key) != nullptr; };
  const int points = has("values") + has("range") + has("draw");
  const int keys = has("key") + has("keys");
  if (points == 1 && keys == (has("draw") ? 0 : 1) && !(has("keys") && has("range"))) return;
  throw InvalidValue(map.place.to_string(), "an axis that is none of the known forms",
                     "key and values, keys and values, key and range, or draw");
}

}  // namespace

void take_in_files(
    io::Value& map,
    const std::function<std::optional<OptionInfo>(const std::string& key)>& option_of) {
  const auto take_in = [&](const io::Value& key, io::Value& value) {
    if (value.kind != io::Value::Kind::scalar) return;
    const auto option = option_of(key.text);
    if (!option || option->kind != OptionKind::vector || option->length != 0) return;
    io::Value list;
    list.kind = io::Value::Kind::sequence;
    list.place = value.place;
    for (const double number : io::read_numbers(*option, value))
      list.items.push_back(scalar(number, value.place));
    value = std::move(list);
  };
  const io::Value *key = map.find("key"), *keys = map.find("keys");
  if (io::Value* values = member_of(map, "values"))
    for (auto& item : values->items) {
      if (key != nullptr) take_in(*key, item);
      if (keys == nullptr) continue;
      for (std::size_t i = 0; i < std::min(keys->items.size(), item.items.size()); ++i)
        take_in(keys->items[i], item.items[i]);
    }
  io::Value* draw = member_of(map, "draw");
  io::Value* of = draw != nullptr ? member_of(*draw, "of") : nullptr;
  if (of == nullptr) return;
  for (auto& drawn : of->items)
    if (io::Value* choice = member_of(drawn, "choice"); choice != nullptr)
      if (const io::Value* name = drawn.find("key"))
        for (auto& item : choice->items) take_in(*name, item);
}

PlacedAxis read_axis(const io::Value& map, int seed, std::size_t stream) {
  only(map, "an axis", {"key", "keys", "values", "range", "draw"});
  check_form(map);
  PlacedAxis axis;
  read_keys(map, axis);
  if (const io::Value* values = map.find("values")) read_values(*values, axis);
  if (const io::Value* range = map.find("range")) read_range(*range, axis);
  if (const io::Value* draw = map.find("draw")) read_draw(*draw, seed, stream, axis);
  axis.listed.resize(axis.keys.size());
  axis.computed.resize(axis.keys.size());
  return axis;
}

}  // namespace slalom::sweep
