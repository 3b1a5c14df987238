#include "sqlite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "slalom/base/error.hpp"

namespace slalom::sweep {
namespace {
constexpr int kBusyWait = 10000;  ///< [ms] for another process's transaction to end
}

Database::Database(const std::filesystem::path& file, Mode mode) : name_(file.string()) {
  const int flags =
      mode == Mode::read ? SQLITE_OPEN_READWRITE : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  int code = sqlite3_open_v2(name_.c_str(), &handle_, flags, nullptr);
  if (code != SQLITE_OK && mode == Mode::read) {
    // A folder that may not be written to: without a log beside it the file can still be read.
    sqlite3_close(handle_);
    code = sqlite3_open_v2(name_.c_str(), &handle_, SQLITE_OPEN_READONLY, nullptr);
  }
  try {
    if (code != SQLITE_OK) fail(code);
    sqlite3_busy_timeout(handle_, kBusyWait);
    // With WAL, NORMAL keeps every transaction over the death of the process; a power cut may cost
    // the last ones, which are then run again.
    if (mode == Mode::write) execute("PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL");
  } catch (...) {
    sqlite3_close(handle_);
    throw;
  }
}

Database::~Database() {
  sqlite3_close(handle_);
}

void Database::execute(const char* sql) {
  const int code = sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(code);
}

void Database::checkpoint() {
  execute("PRAGMA wal_checkpoint(TRUNCATE)");
  // Without a log the file can be read where nothing may be written. Whoever reads it right now
  // is in the way of that, and no reason to fail.
  sqlite3_busy_timeout(handle_, 0);
  sqlite3_exec(handle_, "PRAGMA journal_mode=DELETE", nullptr, nullptr, nullptr);
  sqlite3_busy_timeout(handle_, kBusyWait);
}

void Database::fail(int code) const {
  std::string reason = handle_ != nullptr ? sqlite3_errmsg(handle_) : sqlite3_errstr(code);
  // It quotes a damaged file's bytes.
  std::replace_if(
      reason.begin(), reason.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  // Damage is a fault of what was given; all else is one of the disk.
  if (code == SQLITE_NOTADB || code == SQLITE_CORRUPT)
    throw InvalidValue(name_, "a damaged file: " + reason, "the results of a sweep");
  throw Error(fmt::format("{}: {}", name_, reason));
}

Statement::Statement(const Database& database, const char* sql) : database_(database) {
  check(sqlite3_prepare_v2(database.handle(), sql, -1, &statement_, nullptr));
}

Statement::~Statement() {
  sqlite3_finalize(statement_);
}

void Statement::check(int code) const {
  if (code != SQLITE_OK) database_.fail(code);
}

Statement& Statement::bind(int index, std::int64_t value) {
  check(sqlite3_bind_int64(statement_, index, value));
  return *this;
}

Statement& Statement::bind(int index, double value) {
  check(std::isnan(value) ? sqlite3_bind_null(statement_, index)
                          : sqlite3_bind_double(statement_, index, value));
  return *this;
}

Statement& Statement::bind(int index, const std::string& value) {
  check(sqlite3_bind_text(statement_, index, value.data(), static_cast<int>(value.size()),
                          SQLITE_TRANSIENT));  // NOLINT: the library's own macro
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(statement_);
  if (code != SQLITE_ROW && code != SQLITE_DONE) database_.fail(code);
  return code == SQLITE_ROW;
}

void Statement::run() {
  while (step()) {
  }
  check(sqlite3_reset(statement_));
}

int Statement::type(int column) const {
  return sqlite3_column_type(statement_, column);
}

std::string Statement::name(int column) const {
  return sqlite3_column_name(statement_, column);
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_, column);
}

double Statement::real(int column) const {
  return sqlite3_column_type(statement_, column) == SQLITE_NULL
             ? std::numeric_limits<double>::quiet_NaN()
             : sqlite3_column_double(statement_, column);
}

std::string Statement::text(int column) const {
  const auto* text = sqlite3_column_text(statement_, column);
  return text == nullptr
             ? ""
             : std::string(reinterpret_cast<const char*>(text),
                           static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)));
}

}  // namespace slalom::sweep
