#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "slalom/sim/scenario.hpp"

namespace slalom::sweep {

/// Most trials a study may have, and points an axis: a larger one is more likely a slip.
inline constexpr std::int64_t kMaxTrials = 1'000'000;
/// Most values that one axis may draw, points times keys: they are kept in memory.
inline constexpr std::int64_t kMaxDrawn = 20'000'000;

/// What a sweep keeps of each trial: its row, or the whole folder of its drive too.
enum class Keep { figures, drives };
/// The instruction set of all trials; best: best_kernels().
enum class KernelChoice { best, baseline, avx2, avx512 };

/// How a study's trials are run, beside what they are.
struct StudySettings {
  int repeats = 1;            ///< how often each trial is run
  Keep keep = Keep::figures;  ///< what is kept of each
  int seed = 0;               ///< of the random draws
  double time_limit = 600;    ///< of one trial, wall clock [s]; then it counts as hung
  int retries = 2;            ///< how often a trial is tried again when its worker dies or hangs
  KernelChoice kernels = KernelChoice::best;
};

/// The plain keys of a study file.
const OptionTable<StudySettings>& study_options();

/// The values that keys take together along an axis. They are texts; numbers are kept as such, and
/// each word once, since there may be millions.
class AxisPoints {
 public:
  /// Adds a key's value at its next point; of all keys as many.
  void add(std::size_t key, double number);
  void add(std::size_t key, const std::string& word);

  std::size_t size() const { return columns_.empty() ? 0 : columns_.front().size(); }
  /// One value a key.
  std::vector<std::string> operator[](std::size_t point) const;
  /// A key's numbers; empty where some of its values are none.
  const std::vector<double>& numbers(std::size_t key) const { return columns_[key].numbers; }

 private:
  struct Column {
    std::vector<double> numbers;        ///< one for each point, while all are numbers
    std::vector<std::string> words;     ///< else what there is, each once,
    std::vector<std::uint32_t> chosen;  ///< and which of them each point has
    std::unordered_map<std::string, std::uint32_t> index;  ///< of words

    std::size_t size() const { return numbers.size() + chosen.size(); }
    void add(const std::string& word);
  };
  Column& column(std::size_t key);

  std::vector<Column> columns_;
};

/// One direction of the study's grid.
struct Axis {
  std::vector<std::string> keys;  ///< as --set takes them
  AxisPoints points;
};

/// What tells one trial from the others.
struct Trial {
  std::int64_t number = 0;          ///< 1, 2, ... in the study's order
  std::size_t base = 0;             ///< index into Study::bases
  std::vector<std::string> values;  ///< one for each column of Study::columns()
  int repeat = 1;                   ///< 1, ..., repeats
};

/// A study with its references read: scenarios, planners, and the axes whose product its trials
/// are. The order of trials is fixed: scenarios vary slowest, then planners, then the axes as
/// written, repeats fastest.
struct Study {
  std::string name, title;
  std::vector<std::string> scenarios;  ///< by name, in the study's order
  /// Each scenario with each planner and all of `set` applied; planners vary fastest.
  std::vector<sim::Scenario> bases;
  /// Settings of the vehicle that `set` and the command line state: what an axis says of others
  /// does not make anything else of them.
  std::vector<std::string> stated;
  std::vector<Axis> axes;
  StudySettings settings;
  std::string kernels;  ///< the instruction set by name: baseline, avx2 or avx512

  std::int64_t size() const;
  /// The names of all planners, each once, in the study's order.
  std::vector<std::string> planners() const;
  /// The key paths of all axes, in order.
  std::vector<std::string> columns() const;
  /// 1 <= number <= size().
  Trial trial(std::int64_t number) const;
  /// The trial's own scenario. Throws InvalidValue, naming the trial and the key at fault, for
  /// values that contradict each other.
  sim::Scenario resolve(const Trial& trial) const;
  /// Each base as a resolved file, which states it to the bit.
  std::vector<std::string> resolved_bases() const;
  /// A hash of all that determines the trials and their order: two studies are the same when theirs
  /// are. `resolved` is resolved_bases(), where that is known already.
  std::string identity(const std::vector<std::string>& resolved) const;
  std::string identity() const { return identity(resolved_bases()); }
};

/// Reads a built-in study ("paper") or a file. `overrides` ("key.path=value") hold for every trial.
/// Throws InvalidValue with file:line:column, what was found and what was expected; each value of
/// each axis is tried, so that a wrong key path or a value out of range shows before the first
/// trial.
Study load_study(const std::string& name_or_file, const std::vector<std::string>& overrides = {});

/// The keys of a study that its trials are made by: Study::columns() and Study::stated.
struct TrialKeys {
  std::vector<std::string> axes, stated;
};

/// `base` with a trial's values in the place of its own. Throws InvalidValue, naming the trial and
/// the key at fault, for values that contradict each other.
sim::Scenario resolve_trial(sim::Scenario base, const TrialKeys& keys, const Trial& trial);

/// A hash of a trial's resolved configuration (the YAML of its scenario, instruction set, repeat).
std::string trial_identity(const std::string& resolved, const std::string& kernels, int repeat);

}  // namespace slalom::sweep
