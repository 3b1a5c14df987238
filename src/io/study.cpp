#include "slalom/io/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "config_dir.hpp"
#include "digest.hpp"
#include "overrides.hpp"
#include "section.hpp"
#include "slalom/base/kernels.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/io/version.hpp"
#include "study_axes.hpp"
#include "study_tables.hpp"

namespace slalom::io {
namespace fs = std::filesystem;
namespace {

/// The instruction set by name: a study runs on one, "best" or not.
std::string kernel_name(KernelChoice choice) {
  if (choice == KernelChoice::best) return to_string(best_kernels());
  return to_string(choice == KernelChoice::avx2 ? KernelSet::avx2 : KernelSet::baseline);
}

/// Reads one study file and what it refers to.
class StudyLoader {
 public:
  StudyLoader(fs::path file, const std::vector<std::string>& overrides)
      : file_(std::move(file)), overrides_(overrides) {}

  Study load() {
    root_ = parse_file(file_, "a study");
    require_map(root_, "a study (a map with scenario, planners, axes)");
    study_.name = file_.stem().string();
    if (const Value* name = root_.find("name")) study_.name = to_text(*name, "a name");
    if (const Value* title = root_.find("title")) study_.title = to_text(*title, "a title");
    Section("").add(study_options(), study_.settings).read(root_, places_, other_keys());
    read_scenarios();
    if (const Value* axes = root_.find("axes")) read_axes(*axes);
    check_size();
    study_.kernels = kernel_name(study_.settings.kernels);
    return std::move(study_);
  }

 private:
  static const std::vector<std::string>& other_keys() {
    static const std::vector<std::string> keys = {"name",     "title", "scenario",
                                                  "planners", "set",   "axes"};
    return keys;
  }

  /// The scenario or planner file a value names, which must be there.
  fs::path referenced(const std::string& what, const Value& value) const {
    const auto& name = to_text(value, fmt::format("the name of a {}, or a file", what));
    const auto file = find_config(what, name, file_.parent_path(), value.place.to_string());
    std::error_code error;
    if (!fs::is_regular_file(file, error))
      throw InvalidValue(value.place.to_string(), fmt::format("{} '{}'", what, name),
                         fmt::format("an existing file ({} is none)", file.string()));
    return file;
  }

  void read_scenarios() {
    const Value* scenario = root_.find("scenario");
    if (scenario == nullptr)
      throw InvalidValue(root_.place.to_string(), "a study without 'scenario'",
                         "the key 'scenario'");
    ScenarioRequest request;
    request.name_or_file = fs::absolute(referenced("scenario", *scenario)).string();
    const Value* planners = root_.find("planners");
    if (planners == nullptr) {
      add_scenario(request);
    } else {
      if (planners->kind != Value::Kind::sequence || planners->items.empty())
        throw InvalidValue(planners->place.to_string(),
                           planners->items.empty() ? "no planner" : planners->describe(),
                           "a list of planners");
      for (const auto& planner : planners->items) {
        request.planner = fs::absolute(referenced("planner", planner)).string();
        add_scenario(request);
        check_name(planner);
      }
    }
    study_.scenario = study_.planners.front().name;
  }

  /// Rows of the table name their planner, so that two must not share a name.
  void check_name(const Value& planner) const {
    const auto& name = study_.planners.back().planner.name;
    for (std::size_t i = 0; i + 1 < study_.planners.size(); ++i)
      if (study_.planners[i].planner.name == name)
        throw InvalidValue(planner.place.to_string(),
                           fmt::format("a second planner named '{}'", name), "a name of its own");
  }

  void add_scenario(const ScenarioRequest& request) {
    auto scenario = load_scenario(request);
    if (const Value* set = root_.find("set")) {
      require_map(*set, "a map from key paths to values");
      for (const auto& member : set->members)
        apply_setting(member.key, member.place, member.value, scenario, places_);
    }
    for (const auto& assignment : overrides_) apply_override(assignment, scenario, places_);
    study_.planners.push_back(std::move(scenario));
  }

  void read_axes(const Value& list) {
    if (list.kind == Value::Kind::null || list.kind != Value::Kind::sequence)
      throw InvalidValue(list.place.to_string(), list.describe(), "a list of axes");
    std::set<std::string> keys;
    for (const auto& item : list.items) {
      auto placed = read_axis(item, study_.settings.seed, study_.axes.size());
      for (std::size_t i = 0; i < placed.axis.keys.size(); ++i)
        if (!keys.insert(placed.axis.keys[i]).second)
          throw InvalidValue(placed.keys[i].to_string(),
                             fmt::format("key '{}' a second time", placed.axis.keys[i]),
                             "each key on one axis");
      try_values(placed);
      study_.axes.push_back(std::move(placed.axis));
    }
  }

  /// Sets every value once, on its own: whether values get along shows when a trial is resolved.
  void try_values(const PlacedAxis& placed) {
    for (const auto& base : study_.planners) {
      auto scenario = base;
      for (const auto& point : placed.values)
        for (std::size_t i = 0; i < point.size(); ++i)
          apply_setting(placed.axis.keys[i], placed.keys[i], point[i], scenario, places_);
    }
  }

  void check_size() const {
    double size = static_cast<double>(study_.planners.size()) * study_.settings.repeats;
    for (const auto& axis : study_.axes) size *= static_cast<double>(axis.points.size());
    if (size > static_cast<double>(kMaxTrials))
      throw InvalidValue(file_.string(), fmt::format("{:.3g} trials", size),
                         fmt::format("at most {} in one study", kMaxTrials));
  }

  fs::path file_;
  const std::vector<std::string>& overrides_;
  Value root_;
  Study study_;
  Places places_;
};

}  // namespace

const OptionTable<StudySettings>& study_options() {
  static const auto table = [] {
    using S = StudySettings;
    OptionTable<S> t;
    t.integer("repeats", &S::repeats, OptionRange::closed(1, kMaxTrials), "1",
              "How often each trial is run; the drives are the same, the solve times are not.")
        .choice("keep", &S::keep, {"figures", "drives"},
                "figures: a row a trial; drives: the folder of each drive too.")
        .integer("seed", &S::seed, OptionRange::closed(0, 2147483647), "1",
                 "Of the random draws; the same seed gives the same trials.")
        .real("time_limit", &S::time_limit, OptionRange::positive(), "s",
              "Wall clock of one trial; beyond it the trial counts as hung.")
        .integer("retries", &S::retries, OptionRange::closed(0, 10), "1",
                 "How often a trial is tried again whose worker died or hung.")
        .choice("kernels", &S::kernels, {"best", "baseline", "avx2"},
                "Instruction set all trials run on; best is the best this processor has.");
    return t;
  }();
  return table;
}

std::int64_t Study::size() const {
  auto size = static_cast<std::int64_t>(planners.size()) * settings.repeats;
  for (const auto& axis : axes) size *= static_cast<std::int64_t>(axis.points.size());
  return size;
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
  std::vector<const std::vector<std::string>*> points(axes.size());
  for (std::size_t i = axes.size(); i-- > 0;) {
    const auto n = static_cast<std::int64_t>(axes[i].points.size());
    points[i] = &axes[i].points[static_cast<std::size_t>(rest % n)];
    rest /= n;
  }
  for (const auto* point : points)
    trial.values.insert(trial.values.end(), point->begin(), point->end());
  trial.planner = static_cast<std::size_t>(rest);
  return trial;
}

sim::Scenario Study::resolve(const Trial& trial) const {
  auto resolved = planners.at(trial.planner);
  const auto where = fmt::format("trial {}", trial.number);
  const auto keys = columns();
  Places places;
  for (std::size_t i = 0; i < keys.size(); ++i)
    apply_setting(keys[i], {where, 0, 0}, parse_argument(trial.values[i], where), resolved, places);
  sim::check(resolved, where);
  return resolved;
}

std::string Study::identity() const {
  Digest digest;
  digest.add("slalom study 1").add(kVersion).add(kernels);
  digest.add(std::to_string(settings.repeats)).add(settings.keep == Keep::drives ? "d" : "f");
  for (const auto& one : planners) digest.add(to_yaml(one));
  for (const auto& axis : axes) {
    digest.add("axis");
    for (const auto& key : axis.keys) digest.add(key);
    for (const auto& point : axis.points)
      for (const auto& value : point) digest.add(value);
  }
  return digest.hex();
}

Study load_study(const std::string& name_or_file, const std::vector<std::string>& overrides) {
  return StudyLoader(find_config("study", name_or_file, "", "STUDY"), overrides).load();
}

std::string trial_identity(const std::string& resolved, const std::string& kernels, int repeat) {
  return Digest().add(resolved).add(kernels).add(std::to_string(repeat)).hex();
}

}  // namespace slalom::io
