#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace slalom::sweep {

/// An open SQLite file. Every failure is an Error that names the file and SQLite's reason, an
/// InvalidValue where the file is damaged.
class Database {
 public:
  enum class Mode { read, write };  ///< write: makes the file if need be, in WAL mode

  Database(const std::filesystem::path& file, Mode mode);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void execute(const char* sql);
  /// Moves what the write-ahead log holds into the file itself, and does without one from now on.
  void checkpoint();
  [[noreturn]] void fail(int code) const;

  sqlite3* handle() const { return handle_; }

 private:
  sqlite3* handle_ = nullptr;
  std::string name_;
};

/// A prepared statement. Values are bound from 1, columns read from 0; NaN is stored as NULL and
/// read back as NaN.
class Statement {
 public:
  Statement(const Database& database, const char* sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(int index, std::int64_t value);
  Statement& bind(int index, double value);
  Statement& bind(int index, const std::string& value);
  /// True while there is a row.
  bool step();
  /// Runs to the end and makes the statement ready for other values.
  void run();

  int type(int column) const;  ///< SQLITE_INTEGER, SQLITE_TEXT, ...
  std::string name(int column) const;
  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string text(int column) const;

 private:
  void check(int code) const;

  const Database& database_;
  sqlite3_stmt* statement_ = nullptr;
};

}  // namespace slalom::sweep
