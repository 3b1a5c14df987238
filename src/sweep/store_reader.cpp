#include "store_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "slalom/base/error.hpp"
#include "slalom/base/kernels.hpp"
#include "slalom/sim/drive.hpp"
#include "slalom/sweep/study.hpp"
#include "trial_store.hpp"

namespace slalom::sweep {
namespace fs = std::filesystem;
namespace {

using report::SweepTable;
using report::TrialRecord;

template <class T>
bool among(const T& value, const std::vector<T>& known) {
  return std::find(known.begin(), known.end(), value) != known.end();
}

/// For messages: damage may be any bytes, and many of them.
std::string shown_text(const std::string& text) {
  constexpr std::size_t kShown = 60;
  std::string shown;
  for (const char c : text.substr(0, kShown))
    shown += c >= ' ' && c <= '~' ? std::string(1, c)
                                  : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  return fmt::format("'{}{}'", shown, text.size() > kShown ? "..." : "");
}

/// The row a statement stands at, value by value, each as it must be.
class Row {
 public:
  /// `place` names the file, and the trial where it is known.
  Row(const Statement& row, std::string place) : row_(row), place_(std::move(place)) {}

  std::int64_t integer(std::int64_t least, std::int64_t most) {
    take(SQLITE_INTEGER);
    const auto value = row_.integer(column_);
    require(value >= least && value <= most, fmt::format("{}", value),
            fmt::format("an integer from {} to {}", least, most));
    return value;
  }
  int count() { return static_cast<int>(integer(0, std::numeric_limits<int>::max())); }
  /// NULL stands for NaN.
  double real() {
    const int type = row_.type(++column_);
    require(type == SQLITE_FLOAT || type == SQLITE_NULL, "no number", "a number, or nothing");
    return row_.real(column_);
  }
  std::string text() {
    take(SQLITE_TEXT);
    return row_.text(column_);
  }
  std::string one_of(const std::vector<std::string>& known, const char* rule) {
    auto value = text();
    require(among(value, known), shown_text(value), rule);
    return value;
  }
  std::vector<std::string> list() {
    const auto value = text();
    const auto json = nlohmann::json::parse(value, nullptr, false);
    const bool texts =
        json.is_array() &&
        std::all_of(json.begin(), json.end(), [](const auto& item) { return item.is_string(); });
    require(texts, shown_text(value), "a list of texts");
    return json.get<std::vector<std::string>>();
  }
  /// Of the value read last.
  void require(bool holds, const std::string& found, const std::string& rule) const {
    if (!holds)
      throw InvalidValue(fmt::format("{}: damaged: {}", place_, row_.name(column_)), found, rule);
  }

 private:
  void take(int type) {
    require(row_.type(++column_) == type, "a value of another type",
            type == SQLITE_TEXT ? "text" : "an integer");
  }

  const Statement& row_;
  std::string place_;
  int column_ = -1;
};

const std::vector<std::string>& outcomes() {
  static const auto names = [] {
    auto all = sim::outcome_names();
    all.insert(all.end(), {"failed", "invalid"});
    return all;
  }();
  return names;
}

/// A trial of `study`. The row has kTrialColumns.
TrialRecord read_trial(const Statement& statement, const SweepTable& study, const fs::path& file) {
  Row row(statement, fmt::format("{}: trial {}", file.string(), statement.integer(0)));
  TrialRecord r;
  r.trial = row.integer(1, study.size);
  r.identity = row.text();
  r.scenario = row.one_of(study.scenarios, "a scenario of the study");
  r.planner = row.one_of(study.planners, "a planner of the study");
  r.values = row.list();
  row.require(r.values.size() == study.columns.size(), fmt::format("{} values", r.values.size()),
              fmt::format("{}, one for each column of the study", study.columns.size()));
  r.repeat = static_cast<int>(row.integer(1, study.repeats));
  r.outcome = row.one_of(outcomes(), "a known outcome");
  r.hit = row.text();
  r.message = row.text();
  r.least_clearance_obstacle = row.text();
  r.time = row.real();
  r.goal_time = row.real();
  r.least_clearance = row.real();
  r.least_wheel_load = row.real();
  r.cycles = row.count();
  r.failed_cycles = row.count();
  r.iterations = row.count();
  r.max_solve_time = row.real();
  r.median_solve_time = row.real();
  r.max_cpu_time = row.real();
  r.median_cpu_time = row.real();
  r.p99_cpu_time = row.real();
  r.new_plans = row.count();
  r.rests = row.count();
  r.least_bads = row.count();
  r.marks = row.text();
  return r;
}

SweepTable read_study(const Database& database, const fs::path& file) {
  // A process killed while it made the file leaves one that states nothing yet.
  if (!Statement(database, "SELECT 1 FROM sqlite_master WHERE name = 'study'").step()) return {};
  Statement format(database, "SELECT format FROM study");
  if (!format.step())
    throw InvalidValue(file.string() + ": damaged", "no study stated", "the study of its trials");
  if (format.integer(0) != kStoreFormat && format.integer(0) != kFormatBeforeStated)
    throw InvalidValue(file.string(),
                       fmt::format("format {}, of another version of Slalom", format.integer(0)),
                       fmt::format("format {}", kStoreFormat));
  const char* stated = format.integer(0) == kFormatBeforeStated ? "'[]' AS stated" : "stated";
  Statement statement(database,
                      fmt::format("SELECT name, title, scenarios, identity, kernels, planners, "
                                  "columns, {}, repeats, size FROM study",
                                  stated)
                          .c_str());
  (void)statement.step();
  Row row(statement, file.string());
  SweepTable study;
  study.name = row.text();
  study.title = row.text();
  study.scenarios = row.list();
  row.require(!study.scenarios.empty(), "none", "a list of scenarios");
  study.identity = row.text();
  row.require(!study.identity.empty(), "nothing", "the study's identity");
  std::vector<std::string> sets;
  for (const auto set : kKernelSets) sets.emplace_back(to_string(set));
  study.kernels = row.one_of(sets, "an instruction set");
  study.planners = row.list();
  row.require(!study.planners.empty(), "none", "a list of planners");
  study.columns = row.list();
  study.stated = row.list();
  study.repeats = static_cast<int>(row.integer(1, kMaxTrials));
  study.size = row.integer(1, kMaxTrials);
  return study;
}

std::string select_trials(const Database& database, const char* rest) {
  const char* trials = has_marks(database) ? "trials" : "(SELECT *, '' AS marks FROM trials)";
  return fmt::format("SELECT {} FROM {} {}", kTrialColumns, trials, rest);
}

}  // namespace

bool has_marks(const Database& database) {
  return Statement(database, "SELECT 1 FROM pragma_table_info('trials') WHERE name = 'marks'")
      .step();
}

/// One store, read trial by trial.
class TrialStream::Cursor {
 public:
  explicit Cursor(const fs::path& file) : file_(file), database_(file, Database::Mode::read) {
    study_ = read_study(database_, file);
    if (study_.identity.empty()) return;
    rows_ =
        std::make_unique<Statement>(database_, select_trials(database_, "ORDER BY trial").c_str());
    advance();
  }

  /// The number of the trial that stands next; the greatest there is at the end.
  std::int64_t number() const {
    return next_ ? next_->trial : std::numeric_limits<std::int64_t>::max();
  }
  std::optional<TrialRecord> take() {
    auto taken = std::move(next_);
    advance();
    return taken;
  }

 private:
  void advance() {
    next_.reset();
    if (!rows_) return;
    if (rows_->step())
      next_ = read_trial(*rows_, study_, file_);
    else
      rows_.reset();  // another step would begin again
  }

  fs::path file_;
  Database database_;
  SweepTable study_;
  std::unique_ptr<Statement> rows_;
  std::optional<TrialRecord> next_;
};

TrialStream::TrialStream(const std::vector<fs::path>& stores) {
  for (const auto& file : stores) cursors_.push_back(std::make_unique<Cursor>(file));
}

TrialStream::~TrialStream() = default;

std::optional<TrialRecord> TrialStream::next() {
  const auto first =
      std::min_element(cursors_.begin(), cursors_.end(),
                       [](const auto& a, const auto& b) { return a->number() < b->number(); });
  if (first == cursors_.end()) return std::nullopt;
  auto record = (*first)->take();
  if (!record) return std::nullopt;
  for (const auto& cursor : cursors_)
    if (cursor->number() == record->trial)
      if (auto other = cursor->take(); record->outcome == "failed") record = std::move(other);
  return record;
}

SweepTable stored_study(const fs::path& file) {
  const Database database(file, Database::Mode::read);
  return read_study(database, file);
}

std::vector<std::string> stored_bases(const fs::path& file) {
  const Database database(file, Database::Mode::read);
  std::vector<std::string> bases;
  if (read_study(database, file).identity.empty()) return bases;
  Statement statement(database, "SELECT number, resolved FROM bases ORDER BY number");
  while (statement.step()) {
    Row row(statement, file.string());
    const auto next = static_cast<std::int64_t>(bases.size());
    (void)row.integer(next, next);
    bases.push_back(row.text());
  }
  return bases;
}

std::string stored_base(const fs::path& file, std::int64_t number) {
  const auto study = stored_study(file);
  const auto bases = stored_bases(file);
  const auto count = static_cast<std::int64_t>(bases.size());
  if (number < 1 || number > study.size || count == 0 || study.size % count != 0)
    throw InvalidValue(fmt::format("{}: trial {}: damaged", file.string(), number),
                       fmt::format("{} scenarios of {} trials", count, study.size),
                       "as many trials of each scenario");
  // Bases vary slowest: each has as many trials as the others, one after the other.
  return bases.at(static_cast<std::size_t>((number - 1) / (study.size / count)));
}

std::optional<TrialRecord> stored_trial(const fs::path& file, std::int64_t number) {
  const Database database(file, Database::Mode::read);
  const auto study = read_study(database, file);
  if (study.identity.empty()) return std::nullopt;
  Statement row(database, select_trials(database, "WHERE trial = ?").c_str());
  row.bind(1, number);
  if (!row.step()) return std::nullopt;
  return read_trial(row, study, file);
}

std::vector<std::int64_t> stored_trials(const fs::path& file) {
  const Database database(file, Database::Mode::read);
  const auto study = read_study(database, file);
  std::vector<std::int64_t> numbers;
  if (study.identity.empty()) return numbers;
  Statement statement(database, "SELECT trial FROM trials ORDER BY trial");
  while (statement.step())
    numbers.push_back(
        Row(statement, fmt::format("{}: trial {}", file.string(), statement.integer(0)))
            .integer(1, study.size));
  return numbers;
}

}  // namespace slalom::sweep
