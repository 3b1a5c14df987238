#pragma once

#include <functional>
#include <vector>

#include "slalom/nlp/solver.hpp"
#include "slalom/ocp/scheme.hpp"
#include "slalom/ocp/transcription.hpp"
#include "slalom/planner/planner.hpp"
#include "slalom/planner/recording.hpp"

namespace slalom::planner {

/// Times are within this [s]: there they still have microseconds, as those of the day have.
inline constexpr double kLatest = 1e10;

/// The solve ends as interrupted once `interrupted`, which outlives it and may be empty, says so.
void stop_when(const std::function<bool()>& interrupted, nlp::Options& options);

/// The solver's options as a planner's settings have them.
nlp::Options solver_options(const Settings& settings, const Request& request);

/// Ended from outside, on its way to an answer, after a number of iterations that only the clock
/// knew.
bool cut_short(nlp::Status status);

/// What an answer to a transcribed problem comes to, judged by its residuals. `options` are those
/// it was solved with.
SolveReport report_of(const nlp::Answer& answer, ocp::Transcription& transcription,
                      const Request& request, const nlp::Options& options);

/// What the solves of a cycle take together.
struct SolveTotals {
  double cpu_s = 0, wall_s = 0;
  int iterations = 0;

  void add(const nlp::Answer& answer);
  void put(SolveReport& report) const;
};

/// The last solve of a cycle, but for what judging it brings.
Recording recorded(const Request& request, bool in_range, const nlp::Options& options,
                   const nlp::Start& start, const nlp::Answer& answer);

/// The mesh whose intervals are to each other as these lengths.
ocp::Mesh mesh_of(const std::vector<double>& lengths);

}  // namespace slalom::planner
