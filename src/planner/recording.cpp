#include "slalom/planner/recording.hpp"

#include <bit>
#include <cstdint>
#include <string>

#include "line_planner.hpp"
#include "local_frame.hpp"
#include "obstacle_choice.hpp"
#include "obstacle_view.hpp"
#include "slalom/base/error.hpp"
#include "slalom/nlp/check.hpp"
#include "slalom/ocp/transcription.hpp"
#include "trajectory_problem.hpp"
#include "verifier.hpp"

namespace slalom::planner {
namespace {

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

/// Cut off from outside, after a number of iterations that only the clock knew.
bool cut_off(nlp::Status status) {
  return status == nlp::Status::time_limit || status == nlp::Status::interrupted;
}

/// A solve of a problem posed as it was then, compared with what was recorded of it.
Replayed solved_again(const Recording& recording, ocp::Transcription& transcription,
                      const Settings& settings) {
  nlp::Options options = recording.options;
  options.time_limit = std::numeric_limits<double>::infinity();
  const bool cut = cut_off(recording.status);
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
  select_kernels(recording.kernels);
  const Settings& settings = task.planner;
  Task known = LocalFrame(task.goal).to_local(task);
  if (settings.method == Method::along_road) {
    LinePlanner planner(known);
    return solved_again(recording, planner.posed(recording.X0p), settings);
  }
  Request request;
  request.X0p = recording.X0p;
  request.t0 = recording.t0;
  request.t_start = recording.t_start;
  if (recording.obstacles) known.obstacles = *recording.obstacles;
  const world::Footprint footprint(known.vehicle);
  const auto chosen = choose_obstacles(
      settings, request, believed(settings, group_obstacles(settings, known.obstacles), request.t0),
      footprint);
  TrajectoryProblem problem(known, chosen, recording.goal_in_range);
  problem.update(request);
  ocp::Transcription transcription(problem.problem(), ocp::Mesh::uniform(settings.N),
                                   scheme_of(settings));
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

Certificate verify_again(const RecordedPlan& recording, const Task& task) {
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
    return std::vector<double>{c.least_clearance, c.least_wheel_load, c.until, c.refused_at};
  };
  return one.verified == other.verified && one.nearest == other.nearest &&
         one.refused == other.refused && same_bits(numbers(one), numbers(other));
}

}  // namespace slalom::planner
