#include "slalom/sweep/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "../io/config_dir.hpp"
#include "../io/overrides.hpp"
#include "../io/section.hpp"
#include "../io/semantic_check.hpp"
#include "axis_values.hpp"
#include "digest.hpp"
#include "slalom/base/kernels.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/io/version.hpp"
#include "slalom/vehicle/derived.hpp"
#include "study_axes.hpp"
#include "study_bases.hpp"

namespace slalom::sweep {
namespace fs = std::filesystem;
namespace {

/// The instruction set by name: a study runs on one, "best" or not.
std::string kernel_name(KernelChoice choice) {
  switch (choice) {
    case KernelChoice::baseline:
      return to_string(KernelSet::baseline);
    case KernelChoice::avx2:
      return to_string(KernelSet::avx2);
    case KernelChoice::avx512:
      return to_string(KernelSet::avx512);
    case KernelChoice::best:
      break;
  }
  return to_string(best_kernels());
}

/// Reads one study file and what it refers to.
class StudyLoader {
 public:
  StudyLoader(fs::path file, const std::vector<std::string>& overrides)
      : file_(std::move(file)), overrides_(overrides) {}

  Study load() {
    root_ = io::parse_file(file_, "a study");
    io::require_map(root_, "a study (a map with scenario, planners, axes)");
    study_.name = file_.stem().string();
    if (const io::Value* name = root_.find("name")) study_.name = io::to_text(*name, "a name");
    if (const io::Value* title = root_.find("title")) study_.title = io::to_text(*title, "a title");
    io::Section("").add(study_options(), study_.settings).read(root_, places_, other_keys());
    bases_ = read_bases(root_, file_, overrides_, places_);
    check_size(bases_.all.size(), "scenarios");
    check_size(static_cast<std::size_t>(study_.settings.repeats), "repeats");
    if (const io::Value* axes = root_.find("axes")) read_axes(*axes);
    check_set_keys();
    check_goals();
    study_.kernels = kernel_name(study_.settings.kernels);
    study_.scenarios = std::move(bases_.scenarios);
    study_.stated = std::move(bases_.stated);
    study_.bases = std::move(bases_.all);
    return std::move(study_);
  }

 private:
  static const std::vector<std::string>& other_keys() {
    static const std::vector<std::string> keys = {"name",     "title", "scenario", "scenarios",
                                                  "planners", "set",   "axes"};
    return keys;
  }

  void read_axes(const io::Value& list) {
    if (list.kind == io::Value::Kind::null || list.kind != io::Value::Kind::sequence)
      throw InvalidValue(list.place.to_string(), list.describe(), "a list of axes");
    const auto option_of = [&](const std::string& key) {
      return io::option_at(key, bases_.all.front());
    };
    for (auto item : list.items) {
      take_in_files(item, option_of);
      auto placed = read_axis(item, study_.settings.seed, study_.axes.size());
      for (std::size_t i = 0; i < placed.axis.keys.size(); ++i)
        add_key(placed.axis.keys[i], placed.keys[i], "each key on one axis", varied_);
      check_size(placed.axis.points.size(), item.place);
      try_values(placed);
      for (std::size_t i = 0; i < placed.keys.size(); ++i)
        axes_[placed.axis.keys[i]] = placed.keys[i];
      study_.axes.push_back(std::move(placed.axis));
    }
  }

  /// What keys set, each with its key. Throws InvalidValue for what another key sets already.
  using Setters = std::map<std::string, std::string>;
  static void add_key(const std::string& key, const io::Place& place, const std::string& expected,
                      Setters& setters) {
    for (const auto& setting : io::settings_at(key)) {
      const auto [other, is_new] = setters.emplace(setting, key);
      if (is_new) continue;
      throw InvalidValue(place.to_string(),
                         other->second == key ? fmt::format("key '{}' a second time", key)
                                              : fmt::format("both {} and {}", other->second, key),
                         expected);
    }
  }

  /// What is set for all trials would be lost on an axis. Throws InvalidValue.
  void check_set_keys() const {
    const auto check = [&](const std::string& key, const std::string& where) {
      for (const auto& setting : io::settings_at(key))
        if (const auto axis = varied_.find(setting); axis != varied_.end())
          throw InvalidValue(where, fmt::format("a value for '{}', which an axis varies", key),
                             "a key that is the same in all trials");
    };
    Setters setters;
    if (const io::Value* set = root_.find("set"))
      for (const auto& member : set->members) {
        check(member.key, member.place.to_string());
        add_key(member.key, member.place, "one of them", setters);
      }
    for (const auto& assignment : overrides_) {
      const auto key = assignment.substr(0, assignment.find('='));
      check(key, "--set " + key);
    }
  }

  /// An axis of what the goals of all trials have no use for would be a column without effect.
  void check_goals() const {
    for (const char* key : {"goal.s", "goal.time", "goal.laps", "goal.length"})
      if (axes_.count(key) > 0) return;  // what a trial's goal is shows when it is resolved
    for (const auto& base : bases_.all)
      apply_to(bases_, base, [&] { io::check_goal_keys(base, axes_); });
  }

  /// Sets every value once, on its own: whether values get along shows when a trial is resolved.
  /// What a key takes is the same in every scenario; that they all have it is not.
  void try_values(const PlacedAxis& placed) const {
    for (const auto& base : bases_.all) {
      const bool is_first = &base == &bases_.all.front();
      for (std::size_t i = 0; i < placed.keys.size(); ++i)
        apply_to(bases_, base, [&] { try_values_of(placed, i, base, is_first); });
    }
  }

  /// Of one key: all values, or the first.
  static void try_values_of(const PlacedAxis& placed, std::size_t key, const sim::Scenario& base,
                            bool all) {
    const auto set = [&](const std::vector<const io::Value*>& values) {
      io::try_settings(placed.axis.keys[key], placed.keys[key], values, base);
    };
    const auto& listed = placed.listed[key];
    if (!listed.empty()) return set(all ? listed : std::vector{listed.front()});
    const auto& numbers = placed.axis.points.numbers(key);
    std::vector<double> tried = {numbers.front()};
    if (all && placed.drawn) {
      // What a key takes is an interval, and of whole numbers alone a drawn one is none.
      const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
      tried.insert(tried.end(), {*least, *most});
    } else if (all) {
      tried = numbers;
    }
    constexpr std::size_t kAtOnce = 4096;  // values with their places take far more than numbers
    for (std::size_t begin = 0; begin < tried.size(); begin += kAtOnce) {
      std::vector<io::Value> values;
      std::vector<const io::Value*> list;
      for (std::size_t k = begin; k < std::min(tried.size(), begin + kAtOnce); ++k)
        values.push_back(scalar(tried[k], placed.computed[key]));
      for (const auto& value : values) list.push_back(&value);
      set(list);
    }
  }

  /// Of a key of the study, which may be left out.
  void check_size(std::size_t points, const std::string& key) {
    const io::Value* value = root_.find(key);
    check_size(points, value != nullptr ? value->place : root_.place);
  }

  /// Before an axis is gone through, for a slip of a few digits makes billions.
  void check_size(std::size_t points, const io::Place& place) {
    factors_.push_back(points);
    double size = 1;
    std::string product;
    for (const auto factor : factors_) {
      size *= static_cast<double>(factor);
      if (factor > 1) product += fmt::format("{}{}", product.empty() ? "" : " x ", factor);
    }
    if (size > static_cast<double>(kMaxTrials))
      throw InvalidValue(place.to_string(), fmt::format("{:.10g} trials ({})", size, product),
                         fmt::format("at most {} in one study", kMaxTrials));
  }

  fs::path file_;
  const std::vector<std::string>& overrides_;
  io::Value root_;
  Study study_;
  StudyBases bases_;
  std::vector<std::size_t> factors_;  ///< whose product is the number of trials
  io::Places places_;
  Setters varied_;   ///< by the axes
  io::Places axes_;  ///< where each of their keys stands
};

}  // namespace

void AxisPoints::Column::add(const std::string& word) {
  const auto [found, is_new] = index.emplace(word, static_cast<std::uint32_t>(words.size()));
  if (is_new) words.push_back(word);
  chosen.push_back(found->second);
}

AxisPoints::Column& AxisPoints::column(std::size_t key) {
  if (columns_.size() <= key) columns_.resize(key + 1);
  return columns_[key];
}

void AxisPoints::add(std::size_t key, double number) {
  auto& values = column(key);
  if (values.chosen.empty())
    values.numbers.push_back(number);
  else
    values.add(fmt::format("{}", number));
}

void AxisPoints::add(std::size_t key, const std::string& word) {
  auto& values = column(key);
  for (const double number : std::exchange(values.numbers, {}))
    values.add(fmt::format("{}", number));
  values.add(word);
}

std::vector<std::string> AxisPoints::operator[](std::size_t point) const {
  std::vector<std::string> texts;
  for (const auto& values : columns_)
    texts.push_back(values.numbers.empty() ? values.words[values.chosen[point]]
                                           : fmt::format("{}", values.numbers[point]));
  return texts;
}

std::int64_t Study::size() const {
  auto size = static_cast<std::int64_t>(bases.size()) * settings.repeats;
  for (const auto& axis : axes) size *= static_cast<std::int64_t>(axis.points.size());
  return size;
}

std::vector<std::string> Study::planners() const {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const auto& base : bases)
    if (seen.insert(base.planner.name).second) names.push_back(base.planner.name);
  return names;
}

std::vector<std::string> Study::columns() const {
  std::vector<std::string> columns;
  for (const auto& axis : axes) columns.insert(columns.end(), axis.keys.begin(), axis.keys.end());
  return columns;
}

Trial Study::trial(std::int64_t number) const {
  Trial trial;
  trial.number = number;
  std::int64_t rest = number - 1;
  trial.repeat = static_cast<int>(rest % settings.repeats) + 1;
  rest /= settings.repeats;
  // The last axis varies fastest: take the axes apart from the back.
  std::vector<std::size_t> points(axes.size());
  for (std::size_t i = axes.size(); i-- > 0;) {
    const auto n = static_cast<std::int64_t>(axes[i].points.size());
    points[i] = static_cast<std::size_t>(rest % n);
    rest /= n;
  }
  for (std::size_t i = 0; i < axes.size(); ++i)
    for (auto& value : axes[i].points[points[i]]) trial.values.push_back(std::move(value));
  trial.base = static_cast<std::size_t>(rest);
  return trial;
}

sim::Scenario Study::resolve(const Trial& trial) const {
  return resolve_trial(bases.at(trial.base), {columns(), stated}, trial);
}

sim::Scenario resolve_trial(sim::Scenario base, const TrialKeys& keys, const Trial& trial) {
  const auto where = fmt::format("trial {}", trial.number);
  io::Places places;
  for (std::size_t i = 0; i < keys.axes.size(); ++i) {
    const io::Place place{where + ": " + keys.axes[i], 0, 0};
    io::apply_setting(keys.axes[i], place, io::parse_argument(trial.values.at(i), place.source),
                      base, places);
  }
  vehicle::derive(base.vehicle, io::stated_of_vehicle(keys.axes),
                  {keys.stated.begin(), keys.stated.end()});
  io::follow_footprint(base, places);
  io::check_goal_keys(base, places);
  base.goal = world::placed(base.goal, base.road.get());
  io::check_scenario(base, {where, 0, 0}, places);
  return base;
}

std::vector<std::string> Study::resolved_bases() const {
  std::vector<std::string> resolved;
  const auto keys = columns();
  // What follows from an axis must not be stated; all else is, for studies to stay what they are.
  const bool varied = std::find(keys.begin(), keys.end(), "vehicle.footprint") != keys.end();
  for (const auto& base : bases)
    resolved.push_back(varied ? io::to_yaml_as_stated(base) : io::to_yaml(base));
  return resolved;
}

std::string Study::identity(const std::vector<std::string>& resolved) const {
  Digest digest;
  digest.add("slalom study 1").add(io::kVersion).add(kernels);
  digest.add(std::to_string(settings.repeats)).add(settings.keep == Keep::drives ? "d" : "f");
  for (const auto& base : resolved) digest.add(base);
  for (const auto& axis : axes) {
    digest.add("axis");
    for (const auto& key : axis.keys) digest.add(key);
    for (std::size_t k = 0; k < axis.points.size(); ++k)
      for (const auto& value : axis.points[k]) digest.add(value);
  }
  for (const auto& setting : stated) digest.add("stated").add(setting);
  return digest.hex();
}

Study load_study(const std::string& name_or_file, const std::vector<std::string>& overrides) {
  return StudyLoader(io::find_config("study", name_or_file, "", "STUDY"), overrides).load();
}

std::string trial_identity(const std::string& resolved, const std::string& kernels, int repeat) {
  return Digest().add(resolved).add(kernels).add(std::to_string(repeat)).hex();
}

}  // namespace slalom::sweep
