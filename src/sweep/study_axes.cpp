#include "study_axes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

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

/// A value as it stands in tables and identities: numbers in their shortest form.
std::string text_of(const io::Value& value) {
  if (value.kind == io::Value::Kind::scalar) {
    const auto number = number_of(value);
    return number ? fmt::format("{}", *number) : value.text;
  }
  if (value.kind != io::Value::Kind::sequence)
    throw InvalidValue(value.place.to_string(), value.describe(), "a value, or a list of numbers");
  std::vector<std::string> items;
  for (const auto& item : value.items) items.push_back(fmt::format("{}", finite(item)));
  return fmt::format("[{}]", fmt::join(items, ", "));
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
    axis.values.push_back(
        {scalar(k == count - 1 ? to : from + (to - from) * k / (count - 1), map.place)});
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
  std::vector<Quantile> quantiles;
  for (const auto& item : of) {
    quantiles.push_back(read_distribution(item));
    const io::Value& key = io::require_key(item, "a draw", "key");
    axis.axis.keys.push_back(io::to_text(key, "a key path"));
    axis.keys.push_back(key.place);
  }
  const auto sampling = read_sampling(map);
  if (sampling == Sampling::sobol && of.size() > max_sobol_dimension())
    throw InvalidValue(map.place.to_string(), fmt::format("{} keys", of.size()),
                       fmt::format("at most {} for sobol", max_sobol_dimension()));
  for (const auto& u : unit_points(sampling, count, of.size(), seed, stream)) {
    auto& point = axis.values.emplace_back();
    for (std::size_t i = 0; i < of.size(); ++i) point.push_back(quantiles[i](u[i]));
  }
}

/// values: one a key, or for several keys lists of one value each.
void read_values(const io::Value& list, PlacedAxis& axis) {
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

PlacedAxis read_axis(const io::Value& map, int seed, std::size_t stream) {
  only(map, "an axis", {"key", "keys", "values", "range", "draw"});
  check_form(map);
  PlacedAxis axis;
  read_keys(map, axis);
  if (const io::Value* values = map.find("values")) read_values(*values, axis);
  if (const io::Value* range = map.find("range")) read_range(*range, axis);
  if (const io::Value* draw = map.find("draw")) read_draw(*draw, seed, stream, axis);
  for (const auto& point : axis.values) {
    auto& texts = axis.axis.points.emplace_back();
    for (const auto& value : point) texts.push_back(text_of(value));
  }
  return axis;
}

}  // namespace slalom::sweep
