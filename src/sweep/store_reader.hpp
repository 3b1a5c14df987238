#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "slalom/report/sweep_table.hpp"
#include "sqlite.hpp"

namespace slalom::sweep {

// What stands in stores, checked: who reads on may rely on it. All throw InvalidValue for a file
// that is no store or was damaged, naming the file and, where it is a trial's, its number; Error
// where it cannot be read.

/// The trials of several stores, one by one in trial order. Of equals the first comes that has not
/// failed, where there is one.
class TrialStream {
 public:
  explicit TrialStream(const std::vector<std::filesystem::path>& stores);
  ~TrialStream();
  TrialStream(const TrialStream&) = delete;
  TrialStream& operator=(const TrialStream&) = delete;

  std::optional<report::TrialRecord> next();

 private:
  class Cursor;
  std::vector<std::unique_ptr<Cursor>> cursors_;
};

/// Whether trials of a store have the column `marks`: those of earlier versions have none, are read
/// without and get it when they are gone on with.
bool has_marks(const Database& database);

/// The study whose trials a store holds, without these; its identity is empty when the store states
/// none yet.
report::SweepTable stored_study(const std::filesystem::path& file);

/// What the axes of its study are crossed with, each as a resolved file; empty when the store
/// states no study yet.
std::vector<std::string> stored_bases(const std::filesystem::path& file);
/// The one of them of which trial `number` is made. Throws InvalidValue where the store has none.
std::string stored_base(const std::filesystem::path& file, std::int64_t number);

/// The trial of this number, if the store holds it.
std::optional<report::TrialRecord> stored_trial(const std::filesystem::path& file,
                                                std::int64_t number);

/// Numbers of the trials in a store, in order.
std::vector<std::int64_t> stored_trials(const std::filesystem::path& file);

}  // namespace slalom::sweep
