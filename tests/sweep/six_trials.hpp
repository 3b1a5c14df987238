#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/files.hpp"
#include "slalom/sweep/sweep.hpp"

namespace slalom::test {

inline sweep::Study study_from(const std::string& text) {
  const TemporaryFolder folder;
  write(folder / "study.yaml", text);
  return sweep::load_study((folder / "study.yaml").string());
}

/// Two of the six trials contradict themselves: tex above tf_max.
inline sweep::Study six_trials() {
  return study_from(
      "name: six\nscenario: E_B\naxes:\n  - {key: loop.tex, values: [0.25, 9]}\n"
      "  - {key: planner.tf_max, values: [8, 10, 8.5]}\n");
}

inline sweep::SweepRequest request_for(const TemporaryFolder& folder, int shard = 1,
                                       int shards = 1) {
  sweep::SweepRequest request;
  request.out = folder.path();
  request.shard = shard;
  request.shards = shards;
  return request;
}

inline std::vector<std::int64_t> numbers(const report::SweepTable& table) {
  std::vector<std::int64_t> found;
  for (const auto& record : table.trials) found.push_back(record.trial);
  return found;
}

}  // namespace slalom::test
