#include "trial_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "store_reader.hpp"

namespace slalom::sweep {
namespace fs = std::filesystem;
namespace {

using report::SweepTable;
using report::TrialRecord;

constexpr const char* kSchema =
    "CREATE TABLE study (format INTEGER, name TEXT, title TEXT, scenarios TEXT,"
    " identity TEXT, kernels TEXT, planners TEXT, columns TEXT, stated TEXT, repeats INTEGER,"
    " size INTEGER);"
    "CREATE TABLE bases (number INTEGER PRIMARY KEY, resolved TEXT);"
    "CREATE TABLE trials (trial INTEGER PRIMARY KEY, identity TEXT, scenario TEXT,"
    " planner TEXT, axes TEXT, repeat INTEGER, outcome TEXT, hit TEXT, message TEXT, nearest TEXT,"
    " time_s REAL, goal_time_s REAL, least_clearance_m REAL, least_wheel_load_N REAL, cycles "
    "INTEGER,"
    " failed_cycles INTEGER, iterations INTEGER, max_solve_time_s REAL, median_solve_time_s REAL,"
    " max_cpu_time_s REAL, median_cpu_time_s REAL, p99_cpu_time_s REAL, new_plans INTEGER,"
    " rests INTEGER, least_bads INTEGER, marks TEXT DEFAULT '')";

std::string as_json(const std::vector<std::string>& list) {
  // A worker's last words may hold any bytes.
  return nlohmann::json(list).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// What an empty file becomes.
void state(Database& database, const SweepTable& study, const std::vector<std::string>& bases) {
  database.execute(kSchema);
  Statement(database, "INSERT INTO study VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
      .bind(1, std::int64_t{kStoreFormat})
      .bind(2, study.name)
      .bind(3, study.title)
      .bind(4, as_json(study.scenarios))
      .bind(5, study.identity)
      .bind(6, study.kernels)
      .bind(7, as_json(study.planners))
      .bind(8, as_json(study.columns))
      .bind(9, as_json(study.stated))
      .bind(10, std::int64_t{study.repeats})
      .bind(11, study.size)
      .run();
  Statement insert(database, "INSERT INTO bases VALUES (?, ?)");
  for (std::size_t i = 0; i < bases.size(); ++i)
    insert.bind(1, static_cast<std::int64_t>(i)).bind(2, bases[i]).run();
}

}  // namespace

fs::path store_file(const fs::path& folder, int shard, int shards) {
  return folder /
         (shards == 1 ? "trials.sqlite" : fmt::format("trials-{}-of-{}.sqlite", shard, shards));
}

std::optional<std::pair<int, int>> shard_of_store(const std::string& name) {
  int shard = 1, shards = 1;
  if (name != "trials.sqlite" &&
      std::sscanf(name.c_str(), "trials-%9d-of-%9d.sqlite", &shard, &shards) != 2)
    return std::nullopt;
  // Written again it must be the same: no zeros before, nothing after.
  if (shard < 1 || shard > shards || store_file("", shard, shards) != name) return std::nullopt;
  return std::pair(shard, shards);
}

std::vector<fs::path> store_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (shard_of_store(entry.path().filename().string())) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TrialStore::TrialStore(const fs::path& file, const SweepTable& study,
                       const std::vector<std::string>& bases)
    : database_(file, Database::Mode::write) {
  // One transaction, so that a store which states its study has all that its trials need.
  database_.execute("BEGIN IMMEDIATE");
  if (!Statement(database_, "SELECT 1 FROM sqlite_master").step()) state(database_, study, bases);
  if (!has_marks(database_))
    database_.execute("ALTER TABLE trials ADD COLUMN marks TEXT DEFAULT ''");
  database_.execute("COMMIT");
  insert_ = std::make_unique<Statement>(
      database_,
      fmt::format("INSERT OR REPLACE INTO trials ({}) SELECT ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?,"
                  " ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ? WHERE NOT EXISTS (SELECT 1 FROM trials"
                  " WHERE trial = ?1 AND (outcome <> 'failed' OR ?7 = 'failed'))",
                  kTrialColumns)
          .c_str());
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
      .bind(26, r.marks)
      .run();
}

void TrialStore::add_all(TrialStream& trials) {
  database_.execute("BEGIN IMMEDIATE");
  while (const auto record = trials.next()) add(*record);
  database_.execute("COMMIT");
}

void forget_trials(const fs::path& file, int shard, int shards, const std::string& outcome) {
  if (stored_study(file).identity.empty()) return;
  const Database database(file, Database::Mode::read);
  Statement(database,
            "DELETE FROM trials WHERE (trial - ?1) % ?2 = 0 AND (?3 = '' OR outcome = ?3)")
      .bind(1, std::int64_t{shard})
      .bind(2, std::int64_t{shards})
      .bind(3, outcome)
      .run();
}

}  // namespace slalom::sweep
