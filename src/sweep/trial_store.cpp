#include "trial_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "slalom/base/error.hpp"

namespace slalom::sweep {
namespace fs = std::filesystem;
namespace {

using report::SweepTable;
using report::TrialRecord;

constexpr int kFormat = 4;

constexpr const char* kSchema =
    "CREATE TABLE IF NOT EXISTS study (format INTEGER, name TEXT, title TEXT, scenarios TEXT,"
    " identity TEXT, kernels TEXT, planners TEXT, columns TEXT, repeats INTEGER, size INTEGER);"
    "CREATE TABLE IF NOT EXISTS bases (number INTEGER PRIMARY KEY, resolved TEXT);"
    "CREATE TABLE IF NOT EXISTS trials (trial INTEGER PRIMARY KEY, identity TEXT, scenario TEXT,"
    " planner TEXT, axes TEXT, repeat INTEGER, outcome TEXT, hit TEXT, message TEXT, nearest TEXT,"
    " time_s REAL, goal_time_s REAL, least_clearance_m REAL, least_wheel_load_N REAL, cycles "
    "INTEGER,"
    " failed_cycles INTEGER, iterations INTEGER, max_solve_time_s REAL, median_solve_time_s REAL,"
    " max_cpu_time_s REAL, median_cpu_time_s REAL, p99_cpu_time_s REAL, new_plans INTEGER,"
    " rests INTEGER, least_bads INTEGER)";

std::string as_json(const std::vector<std::string>& list) {
  return nlohmann::json(list).dump();
}

std::vector<std::string> from_json(const std::string& text) {
  return nlohmann::json::parse(text).get<std::vector<std::string>>();
}

bool is_store(const fs::path& file) {
  const auto name = file.filename().string();
  return file.extension() == ".sqlite" && name.starts_with("trials");
}

void insert_study(Database& database, const SweepTable& study) {
  // One transaction, so that a second process does not state the study twice.
  database.execute("BEGIN IMMEDIATE");
  database.execute(kSchema);
  if (!Statement(database, "SELECT 1 FROM study").step())
    Statement(database, "INSERT INTO study VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
        .bind(1, std::int64_t{kFormat})
        .bind(2, study.name)
        .bind(3, study.title)
        .bind(4, as_json(study.scenarios))
        .bind(5, study.identity)
        .bind(6, study.kernels)
        .bind(7, as_json(study.planners))
        .bind(8, as_json(study.columns))
        .bind(9, std::int64_t{study.repeats})
        .bind(10, study.size)
        .run();
  database.execute("COMMIT");
}

TrialRecord read_trial(const Statement& row) {
  TrialRecord r;
  r.trial = row.integer(0);
  r.identity = row.text(1);
  r.scenario = row.text(2);
  r.planner = row.text(3);
  r.values = from_json(row.text(4));
  r.repeat = static_cast<int>(row.integer(5));
  r.outcome = row.text(6);
  r.hit = row.text(7);
  r.message = row.text(8);
  r.least_clearance_obstacle = row.text(9);
  r.time = row.real(10);
  r.goal_time = row.real(11);
  r.least_clearance = row.real(12);
  r.least_wheel_load = row.real(13);
  r.cycles = static_cast<int>(row.integer(14));
  r.failed_cycles = static_cast<int>(row.integer(15));
  r.iterations = static_cast<int>(row.integer(16));
  r.max_solve_time = row.real(17);
  r.median_solve_time = row.real(18);
  r.max_cpu_time = row.real(19);
  r.median_cpu_time = row.real(20);
  r.p99_cpu_time = row.real(21);
  r.new_plans = static_cast<int>(row.integer(22));
  r.rests = static_cast<int>(row.integer(23));
  r.least_bads = static_cast<int>(row.integer(24));
  return r;
}

SweepTable read_study(const Database& database, const fs::path& file) {
  // A process killed while it made the file leaves one that states nothing yet.
  if (!Statement(database, "SELECT 1 FROM sqlite_master WHERE name = 'study'").step()) return {};
  Statement format(database, "SELECT format FROM study");
  if (!format.step()) throw Error(fmt::format("{}: states no study", file.string()));
  if (format.integer(0) != kFormat)
    throw Error(fmt::format("{}: written by another version of Slalom (format {}, expected {})",
                            file.string(), format.integer(0), kFormat));
  Statement row(database,
                "SELECT name, title, scenarios, identity, kernels, planners, columns, repeats, size"
                " FROM study");
  (void)row.step();
  SweepTable study;
  study.name = row.text(0);
  study.title = row.text(1);
  study.scenarios = from_json(row.text(2));
  study.identity = row.text(3);
  study.kernels = row.text(4);
  study.planners = from_json(row.text(5));
  study.columns = from_json(row.text(6));
  study.repeats = static_cast<int>(row.integer(7));
  study.size = row.integer(8);
  return study;
}

}  // namespace

fs::path store_file(const fs::path& folder, int shard, int shards) {
  return folder /
         (shards == 1 ? "trials.sqlite" : fmt::format("trials-{}-of-{}.sqlite", shard, shards));
}

std::vector<fs::path> store_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (is_store(entry.path())) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TrialStore::TrialStore(const fs::path& file, const SweepTable& study)
    : database_(file, Database::Mode::write) {
  insert_study(database_, study);
  insert_ = std::make_unique<Statement>(
      database_,
      "INSERT OR IGNORE INTO trials VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, "
      "?, ?, ?, ?, ?, ?, ?)");
}

void TrialStore::add(const TrialRecord& r) {
  insert_->bind(1, r.trial)
      .bind(2, r.identity)
      .bind(3, r.scenario)
      .bind(4, r.planner)
      .bind(5, as_json(r.values))
      .bind(6, std::int64_t{r.repeat})
      .bind(7, r.outcome)
      .bind(8, r.hit)
      .bind(9, r.message)
      .bind(10, r.least_clearance_obstacle)
      .bind(11, r.time)
      .bind(12, r.goal_time)
      .bind(13, r.least_clearance)
      .bind(14, r.least_wheel_load)
      .bind(15, std::int64_t{r.cycles})
      .bind(16, std::int64_t{r.failed_cycles})
      .bind(17, std::int64_t{r.iterations})
      .bind(18, r.max_solve_time)
      .bind(19, r.median_solve_time)
      .bind(20, r.max_cpu_time)
      .bind(21, r.median_cpu_time)
      .bind(22, r.p99_cpu_time)
      .bind(23, std::int64_t{r.new_plans})
      .bind(24, std::int64_t{r.rests})
      .bind(25, std::int64_t{r.least_bads})
      .run();
}

void TrialStore::keep_bases(const std::vector<std::string>& resolved) {
  database_.execute("BEGIN IMMEDIATE");
  Statement insert(database_, "INSERT OR IGNORE INTO bases VALUES (?, ?)");
  for (std::size_t i = 0; i < resolved.size(); ++i)
    insert.bind(1, static_cast<std::int64_t>(i)).bind(2, resolved[i]).run();
  database_.execute("COMMIT");
}

std::int64_t TrialStore::add_all(TrialStream& trials) {
  std::int64_t count = 0;
  database_.execute("BEGIN IMMEDIATE");
  while (const auto record = trials.next()) {
    add(*record);
    ++count;
  }
  database_.execute("COMMIT");
  return count;
}

/// One store, read trial by trial.
class TrialStream::Cursor {
 public:
  explicit Cursor(const fs::path& file) : database_(file, Database::Mode::read) {
    if (read_study(database_, file).identity.empty()) return;
    rows_ = std::make_unique<Statement>(database_, "SELECT * FROM trials ORDER BY trial");
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
      next_ = read_trial(*rows_);
    else
      rows_.reset();  // another step would begin again
  }

  Database database_;
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
    if (cursor->number() == record->trial) (void)cursor->take();
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
  Statement row(database, "SELECT resolved FROM bases ORDER BY number");
  while (row.step()) bases.push_back(row.text(0));
  return bases;
}

std::string stored_base(const fs::path& file, std::int64_t number) {
  const Database database(file, Database::Mode::read);
  // Bases vary slowest: each has as many trials as the others, one after the other.
  Statement row(database,
                "SELECT resolved FROM bases WHERE number ="
                " (? - 1) / ((SELECT size FROM study) / (SELECT COUNT(*) FROM bases))");
  row.bind(1, number);
  if (!row.step()) throw Error(fmt::format("{}: has no scenario of its trials", file.string()));
  return row.text(0);
}

std::optional<TrialRecord> stored_trial(const fs::path& file, std::int64_t number) {
  const Database database(file, Database::Mode::read);
  if (read_study(database, file).identity.empty()) return std::nullopt;
  Statement row(database, "SELECT * FROM trials WHERE trial = ?");
  row.bind(1, number);
  if (!row.step()) return std::nullopt;
  return read_trial(row);
}

std::vector<std::int64_t> stored_trials(const fs::path& file) {
  const Database database(file, Database::Mode::read);
  std::vector<std::int64_t> numbers;
  if (read_study(database, file).identity.empty()) return numbers;
  Statement row(database, "SELECT trial FROM trials ORDER BY trial");
  while (row.step()) numbers.push_back(row.integer(0));
  return numbers;
}

}  // namespace slalom::sweep
