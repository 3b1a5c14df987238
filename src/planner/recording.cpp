#include "slalom/planner/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

#include "line_planner.hpp"
#include "local_frame.hpp"
#include "obstacle_choice.hpp"
#include "obstacle_view.hpp"
#include "slalom/base/error.hpp"
#include "slalom/nlp/check.hpp"
#include "slalom/ocp/transcription.hpp"
#include "solving.hpp"
#include "trajectory_problem.hpp"
#include "verifier.hpp"

namespace slalom::planner {
namespace {

template <class List>
bool finite(const List& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  return true;
}

bool same_bits(const nlp::Start& a, const nlp::Start& b) {
  return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.zl, b.zl) &&
         same_bits(a.zu, b.zu);
}

/// Times of a motion are no farther apart [s].
constexpr double kLongestStep = 1;
/// Looks for arrival along a motion, at the most.
constexpr double kMostLooks = 1e6;

/// A solve of a problem posed as it was then, compared with what was recorded of it.
Replayed solved_again(const Recording& recording, ocp::Transcription& transcription,
                      const Settings& settings) {
  nlp::Options options = recording.options;
  options.time_limit = std::numeric_limits<double>::infinity();
  const bool cut = cut_short(recording.status);
  if (cut) options.max_iterations = recording.iterations;
  const auto solver = nlp::make_solver(to_string(settings.solver));
  const nlp::Answer answer = solver->solve(transcription, recording.start, options);

  Replayed result;
  result.status = answer.status;
  result.iterations = answer.iterations;
  result.phi = nlp::check(transcription, answer.point, options).phi;
  const bool same_end =
      cut ? answer.status == nlp::Status::iteration_limit : answer.status == recording.status;
  result.same = same_end && answer.iterations == recording.iterations &&
                same_bits(answer.point, recording.end);
  return result;
}

}  // namespace

Replayed replay(const Recording& recording, const Task& task) {
  Request request;
  request.X0p = recording.X0p;
  request.t0 = recording.t0;
  request.t_start = recording.t_start;
  check(request, "recorded solve");
  if (recording.s && !std::isfinite(*recording.s))
    throw InvalidValue("recorded solve: s", fmt::format("{}", *recording.s), "a finite number");
  select_kernels(recording.kernels);
  const Settings& settings = task.planner;
  Task known = LocalFrame(task.goal).to_local(task);
  if (settings.method == Method::along_road) {
    LinePlanner planner(known);
    return solved_again(recording, planner.posed(recording.X0p, recording.s), settings);
  }
  if (recording.obstacles) known.obstacles = *recording.obstacles;
  const world::Footprint footprint(known.vehicle);
  const auto chosen = choose_obstacles(
      settings, request, believed(settings, group_obstacles(settings, known.obstacles), request.t0),
      footprint);
  TrajectoryProblem problem(known, chosen, recording.goal_in_range);
  problem.update(request);
  ocp::Transcription transcription(problem.problem(), ocp::Mesh::uniform(settings.N),
                                   scheme_of(settings));
  // Before anything is read from the start; the solver checks the rest of it.
  nlp::check_sizes(recording.start, transcription.structure(), recording.options.warm_start);
  if (!finite(recording.start.x))
    throw InvalidValue("start: x", "NaN or infinity", "finite numbers");
  if (known.road) {
    // Where the cycle was on the road is a state of the start.
    const double s = transcription.trajectory(recording.start.x).states.front().back();
    problem.update(request, way_ahead(known, request, s));
  }
  problem.set_obstacles(chosen,
                        obstacle_times(settings, request, transcription, recording.start.x));
  transcription.update(problem.problem());
  return solved_again(recording, transcription, settings);
}

void check(const RecordedPlan& recording, const std::string& where) {
  const auto refuse = [&](const char* what, const std::string& found, const std::string& expected) {
    throw InvalidValue(where + ": " + what, found, expected);
  };
  const auto expect_time = [&](const char* what, double t) {
    if (!(std::fabs(t) <= kLatest)) refuse(what, fmt::format("{}", t), "a time within 1e10 s of 0");
  };
  const auto& t = recording.t;
  expect_time("t0", recording.t0);
  if (!(recording.tex > 0)) refuse("tex", fmt::format("{}", recording.tex), "a number > 0");
  if (t.size() < 2) refuse("t", fmt::format("{} times", t.size()), "at least 2");
  for (std::size_t k = 0; k < t.size(); ++k) {
    expect_time("t", t[k]);
    if (k > 0 && !(t[k] >= t[k - 1] && t[k] <= t[k - 1] + kLongestStep))
      refuse("t", fmt::format("{} after {}", t[k], t[k - 1]),
             fmt::format("rising times, each within {} s of the last", kLongestStep));
  }
  // Looks are counted from t0 on.
  const double looks =
      (std::max(t.back(), recording.t0) - std::min(t.front(), recording.t0)) / recording.tex;
  if (!(looks <= kMostLooks))
    refuse("tex", fmt::format("{}, {} times from t0 to the motion's end", recording.tex, looks),
           fmt::format("at most {}", kMostLooks));
  const auto all_finite = [](const auto& rows) {
    return std::all_of(rows.begin(), rows.end(), [](const auto& row) { return finite(row); });
  };
  for (const std::size_t rows : {recording.states.size(), recording.controls.size()})
    if (rows != t.size())
      refuse("states and controls", fmt::format("{} rows", rows),
             fmt::format("{}, one for each time", t.size()));
  if (!all_finite(recording.states)) refuse("states", "NaN or infinity", "finite numbers");
  if (!all_finite(recording.controls)) refuse("controls", "NaN or infinity", "finite numbers");
}

Certificate verify_again(const RecordedPlan& recording, const Task& task) {
  check(recording, "recorded plan");
  const Task local = LocalFrame(task.goal).to_local(task);
  const vehicle::Plant plant = Verifier::believed_plant(local.vehicle);
  Verifier verifier(local, plant);
  const Motion motion{recording.t, recording.states, recording.controls};
  const Need need{recording.clearance,
                  recording.wheel_load,
                  {recording.seen_x, recording.seen_y, recording.seen_radius},
                  recording.edge};
  return verifier.judge(motion, recording.obstacles, need, {recording.t0, recording.tex})
      .certificate;
}

bool same(const Certificate& one, const Certificate& other) {
  const auto numbers = [](const Certificate& c) {
    return std::vector<double>{c.least_clearance, c.proved_clearance, c.least_wheel_load, c.until,
                               c.refused_at};
  };
  return one.verified == other.verified && one.nearest == other.nearest &&
         one.refused == other.refused && same_bits(numbers(one), numbers(other));
}

}  // namespace slalom::planner
