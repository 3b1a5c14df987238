#include "receding_horizon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <utility>

#include "between_nodes.hpp"
#include "free_way.hpp"
#include "obstacle_choice.hpp"
#include "obstacle_view.hpp"
#include "solving.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

/// A plan that passes through between its nodes is solved again on meshes of so many times the
/// intervals.
constexpr int kRefined[] = {2, 4, 8};

/// The task with its obstacles grouped as its settings say, once these are found to be sound.
Task with_groups(Task task) {
  check(task.planner, "planner " + task.planner.name);
  task.obstacles = group_obstacles(task.planner, task.obstacles);
  return task;
}

/// The point of a guess that is nearest to an obstacle, and its distance from the edge [m].
std::pair<std::size_t, double> nearest_point(const ocp::Trajectory& guess,
                                             const world::Obstacle& obstacle, double t_start) {
  std::pair<std::size_t, double> nearest{0, INFINITY};
  for (std::size_t k = 0; k < guess.tau.size(); ++k) {
    const auto& x = guess.states[k];
    const double d = world::distance(obstacle, x[X], x[Y], t_start + guess.time(k));
    if (d < nearest.second) nearest = {k, d};
  }
  return nearest;
}

/// The guess with a bulge to one side (1: left) past the obstacle that it goes deepest into, as far
/// as that takes. Its start stays.
ocp::Trajectory bent(ocp::Trajectory guess, const world::Obstacle& obstacle, double t_start,
                     double margin, double side) {
  constexpr double kWidth = 0.25;  // of the bulge, as a share of the horizon
  const std::size_t last = guess.tau.size() - 1;
  if (last == 1) {  // straight on, by its ends: room for a bulge
    constexpr std::size_t kPoints = 21;
    const auto ends = guess.states, controls = guess.controls;
    guess.tau.clear();
    guess.states.clear();
    guess.controls.assign(kPoints, controls[0]);
    for (std::size_t k = 0; k < kPoints; ++k) {
      const double share = static_cast<double>(k) / (kPoints - 1);
      guess.tau.push_back(share);
      guess.states.push_back(ends[0]);
      for (std::size_t i = 0; i < ends[0].size(); ++i)
        guess.states.back()[i] += share * (ends[1][i] - ends[0][i]);
    }
  }
  const std::size_t nearest = nearest_point(guess, obstacle, t_start).first;
  const auto& at = guess.states[nearest];
  const double t = t_start + guess.time(nearest);
  const double nx = -std::sin(at[PSI]), ny = std::cos(at[PSI]);  // to the left
  const double lies = nx * (obstacle.x_at(t) - at[X]) + ny * (obstacle.y_at(t) - at[Y]);
  const double wanted = side * (std::max(obstacle.a, obstacle.b) + margin) + lies;
  if (side * wanted <= 0) return guess;
  const double centre = std::max(guess.tau[nearest], kWidth);
  for (std::size_t k = 0; k < guess.tau.size(); ++k) {
    const double away = (guess.tau[k] - centre) / kWidth;
    const double share = std::min(1.0, guess.tau[k] / centre) * std::exp(-away * away);
    guess.states[k][X] += share * wanted * nx;
    guess.states[k][Y] += share * wanted * ny;
  }
  return guess;
}

}  // namespace

RecedingHorizon::Form::Form(TrajectoryProblem p, const Settings& settings, int intervals)
    : problem(std::move(p)),
      transcription(problem.problem(), ocp::Mesh::uniform(intervals), scheme_of(settings)) {}

void RecedingHorizon::Form::update(const Request& request, const WayAhead& way) {
  problem.update(request, way);
  transcription.update(problem.problem());
}

RecedingHorizon::RecedingHorizon(const Task& task)
    : task_(with_groups(task)),
      settings_(task_.planner),
      footprint_(task_.vehicle),
      known_(believed(settings_, task_.obstacles, 0)),
      chosen_(choose_obstacles(settings_, {}, known_, footprint_)),
      guess_(task_),
      solver_(nlp::make_solver(to_string(settings_.solver))) {
  prepare();
}

Plan RecedingHorizon::plan(const Request& request) {
  const Timer timer;
  const Cycle cycle{request, look_ahead(request), timer};
  totals_ = {};
  choose(request);
  // A goal that was passed on the road leaves a plan that has nothing left.
  if (task_.road && last_ && last_->in_range && !cycle.way.in_range) last_.reset();
  // Multipliers carry over where the plan that they belong to had the same rows.
  const bool warm =
      last_ && carries_ && last_->in_range == cycle.way.in_range && same_names(chosen_, of_last_);
  ocp::Trajectory& guess = guess_(request, cycle.way, last_ ? &*last_ : nullptr);
  std::optional<ocp::Trajectory> bendable;
  if (settings_.retry_sides) bendable = guess;
  Attempt best = attempt(cycle, settings_.N, guess, warm);
  if (bendable && !best.plan.report.solved) try_sides(cycle, *bendable, best);
  if (task_.road && !best.plan.report.solved && !best.cut_short) try_free_way(cycle, best);
  if (refines(task_)) refine(cycle, best);
  keep(cycle, best);
  totals_.put(best.plan.report);
  best.plan.report.planning_cpu_s = timer.cpu();
  return std::move(best.plan);
}

void RecedingHorizon::record(const Recorder& recorder) {
  recorder_.reset();
  if (recorder.wanted && recorder.take) recorder_ = recorder;
}

/// The form for the goal in or out of range and for as many obstacles as are chosen, transcribed
/// when it is first wanted.
RecedingHorizon::Form& RecedingHorizon::form(bool in_range, int intervals) {
  const FormKey key{in_range, ObstacleRows::counts(chosen_), intervals};
  const auto found = forms_.find(key);
  if (found != forms_.end()) return found->second;
  return forms_.try_emplace(key, TrajectoryProblem(task_, chosen_, in_range), settings_, intervals)
      .first->second;
}

/// The road is followed from where the last cycle began, so that the branch of one that bends back
/// on itself is the vehicle's.
WayAhead RecedingHorizon::look_ahead(const Request& request) {
  if (!task_.road) return {.in_range = goal_in_range(task_, request.X0p)};
  std::optional<double> hint;
  if (on_road_) {
    const double since = request.t_start - on_road_->first;
    hint = on_road_->second + std::max(0., since) * std::max(0., request.X0p[UX]);
  }
  const WayAhead way = way_ahead(task_, request, hint);
  on_road_ = {request.t_start, way.s};
  return way;
}

/// Chooses this cycle's obstacles.
void RecedingHorizon::choose(const Request& request) {
  const bool as_made = !request.obstacles && !any_far(settings_, request, task_.obstacles) &&
                       !belief_varies(settings_, task_.obstacles);
  if (settings_.obstacle_choice == ObstacleChoice::all && as_made && as_made_) return;
  as_made_ = as_made;
  known_ =
      believed(settings_,
               request.obstacles ? group_obstacles(settings_, *request.obstacles) : task_.obstacles,
               request.t0);
  chosen_ = choose_obstacles(settings_, request, known_, footprint_);
  const auto counts = ObstacleRows::counts(chosen_);
  for (auto& [key, form] : forms_)
    if (std::get<1>(key) == counts) form.problem.set_obstacles(chosen_, {request.t0});
}

/// Gives rows of obstacles whose numbers vary those of the times at which the start of the solve is
/// at the points of the mesh.
void RecedingHorizon::place_obstacles(const Request& request, Form& form) const {
  form.problem.set_obstacles(chosen_,
                             obstacle_times(settings_, request, form.transcription, start_.x));
  form.transcription.update(form.problem.problem());
}

/// One solve without an iteration of either form, so that all memory is there before the first
/// cycle and when the goal comes into range.
void RecedingHorizon::prepare() {
  for (const bool in_range : {true, false}) {
    Form& form = this->form(in_range, settings_.N);
    WayAhead way;
    Request start;
    if (task_.road) {
      const world::RoadPlace at = task_.road->at(0);
      start.X0p[X] = at.x;
      start.X0p[Y] = at.y;
      start.X0p[PSI] = at.psi;
      way = way_ahead(task_, start, 0);
    }
    way.in_range = in_range;
    ocp::Trajectory& guess = guess_(start, way, nullptr);
    form.problem.to_problem(way.s, guess);
    start_.x = form.transcription.point(guess);
    nlp::Options options = solver_options(settings_, {});
    options.max_iterations = 0;
    solver_->solve(form.transcription, start_, options, answer_);
  }
}

/// Solves once from a guess, which is put into the planner's states.
RecedingHorizon::Attempt RecedingHorizon::attempt(const Cycle& cycle, int intervals,
                                                  ocp::Trajectory& guess, bool warm) {
  Form& form = this->form(cycle.way.in_range, intervals);
  form.update(cycle.request, cycle.way);
  form.problem.to_problem(cycle.way.s, guess);
  start_.x = form.transcription.point(guess);
  if (std::any_of(chosen_.begin(), chosen_.end(), varies)) place_obstacles(cycle.request, form);
  nlp::Options options = solver_options(settings_, cycle.request);
  options.warm_start = warm;
  options.time_limit =
      std::max(0.0, cycle.request.time_limit - cycle.timer.cpu() - longest_reading_s_);
  solver_->solve(form.transcription, start_, options, answer_);
  totals_.add(answer_);
  const double solved_at = cycle.timer.cpu();
  std::optional<Recording> recording;
  if (recorder_ && intervals == settings_.N)
    recording = recorded(cycle.request, cycle.way.in_range, options, start_, answer_);
  Attempt attempt = read(cycle, intervals, options);
  if (recording && recorder_->wanted(attempt.plan.report)) {
    recording->phi = attempt.plan.report.phi;
    recorder_->take(*recording);
  }
  longest_reading_s_ = std::max(longest_reading_s_, cycle.timer.cpu() - solved_at);
  return attempt;
}

/// The answer as a plan, judged.
RecedingHorizon::Attempt RecedingHorizon::read(const Cycle& cycle, int intervals,
                                               const nlp::Options& options) {
  Form& form = this->form(cycle.way.in_range, intervals);
  Attempt attempt;
  attempt.carries = intervals == settings_.N;
  attempt.cut_short = cut_short(answer_.status);
  attempt.trajectory = form.transcription.trajectory(answer_.point.x);
  const ocp::Trajectory& trajectory = attempt.trajectory;
  form.problem.to_plant(cycle.request.X0p, attempt.trajectory);
  Plan& plan = attempt.plan;
  plan.goal_in_range = cycle.way.in_range;
  plan.t_start = cycle.request.t_start;
  plan.tf = trajectory.tf;
  if (!settings_.moving_avoidance) plan.obstacle_time_held = cycle.request.t0;
  const std::size_t points = trajectory.tau.size();
  plan.t.reserve(points);
  plan.states.resize(points);
  plan.controls.resize(points);
  for (std::size_t k = 0; k < points; ++k) {
    plan.t.push_back(trajectory.tau[k] * trajectory.tf);
    std::copy_n(trajectory.states[k].begin(), kStates, plan.states[k].begin());
    std::copy_n(trajectory.controls[k].begin(), kControls, plan.controls[k].begin());
  }
  plan.report = report_of(answer_, form.transcription, cycle.request, options);
  if (settings_.between_nodes != BetweenNodes::ignore) look_between(cycle, plan);
  if (!plan.report.solved) plan.report.blocks = what_blocks(plan);
  return attempt;
}

/// The row that a plan violates most, in a sentence. Of an obstacle's, how far from its edge the
/// node is at which it stands, and how far it is to be.
std::string RecedingHorizon::what_blocks(const Plan& plan) const {
  const std::string& row = plan.report.worst_constraint;
  if (row.empty()) return "";
  const auto plain = fmt::format("{} falls short by {:.3g}", row, plan.report.worst_violation);
  for (const auto& o : known_) {
    const auto part = fmt::format("obstacle[{}] at node ", o.name);
    const auto found = row.find(part);
    if (found == std::string::npos) continue;
    char* end = nullptr;
    const auto node = std::strtoul(row.c_str() + found + part.size(), &end, 10);
    const auto k = node * (plan.t.size() - 1) / static_cast<std::size_t>(settings_.N);  // points
    if (*end != '\0' || k >= plan.t.size() || !(plan.tf > 0)) return plain;
    const double t = plan.obstacle_time(k);
    const double margin = settings_.sm_start +
                          (settings_.sm_end - settings_.sm_start) * plan.t[k] / plan.tf +
                          o.margin(t);
    const double distance = footprint_.distance(o, plan.states[k], t);
    return fmt::format(
               "{} in the way: node {} of the plan comes {} its edge, where a margin of {:.2f} m "
               "is kept",
               o.name, node,
               distance >= 0 ? fmt::format("to {:.2f} m from", distance)
                             : fmt::format("{:.2f} m inside", -distance),
               margin) +
           (distance >= 0 ? fmt::format(" and {:.2f} m would do", distance) : "");
  }
  return plain;
}

/// Notes how deep a plan goes into an obstacle between its nodes, also into one that the OCP leaves
/// out, and how far beyond the edges of its road. Soft rows let a plan in at its nodes too.
void RecedingHorizon::look_between(const Cycle& cycle, Plan& plan) const {
  SolveReport& report = plan.report;
  std::string found;
  const auto known =
      believed(settings_, cycle.request.obstacles ? *cycle.request.obstacles : task_.obstacles,
               cycle.request.t0);
  const double margin = std::min(settings_.sm_start, settings_.sm_end);
  report.passage = deepest_passage(plan, known, margin, footprint_, task_.vehicle.la);
  Passage& deepest = report.passage;
  if (settings_.obstacle_constraint == ObstacleConstraint::soft)
    deepest.at_nodes = deepest_at_nodes(plan, known, margin, footprint_);
  if (deepest.depth > settings_.most_passage()) {
    found = fmt::format("{:.2f} m deep into the margin of {} at {:.2f} s", deepest.depth,
                        deepest.obstacle, deepest.t);
    if (deepest.at_nodes > kPassageResolution)
      found += fmt::format(", up to {:.2f} m at nodes, whose rows are soft", deepest.at_nodes);
  }
  if (task_.road) {
    report.road_exit = farthest_exit(plan, *task_.road, footprint_, task_.vehicle.la);
    const RoadExit& exit = report.road_exit;
    if (exit.depth > 0)
      found += fmt::format("{}{:.2f} m off the road at its {} edge at {:.2f} s",
                           found.empty() ? "" : " and ", exit.depth, exit.edge(), exit.t);
  }
  if (report.status != PlanStatus::solved || found.empty()) return;
  report.status = PlanStatus::passes_through;
  report.detail = found;
}

/// Whether a plan goes into obstacles as soft rows at its nodes let it: finer meshes are of no
/// help.
bool RecedingHorizon::let_in(const SolveReport& report) const {
  return report.passage.unseen() <= settings_.most_passage() && report.road_exit.depth == 0;
}

/// Where the cycle has no plan: from the guess bent to the left and to the right of the obstacle
/// that it goes deepest into. The sooner of those that are solved.
void RecedingHorizon::try_sides(const Cycle& cycle, const ocp::Trajectory& guess, Attempt& best) {
  const double margin = std::max(settings_.sm_start, settings_.sm_end);
  const world::Obstacle* blocks = nullptr;
  double least = INFINITY;
  for (const auto& o : chosen_) {
    const double d = nearest_point(guess, o, cycle.request.t_start).second;
    if (d >= least) continue;
    least = d;
    blocks = &o;
  }
  if (blocks == nullptr) return;
  best.carries = false;  // what is tried takes the multipliers' place
  for (const double side : {1.0, -1.0}) {
    auto start = bent(guess, *blocks, cycle.request.t_start, margin, side);
    Attempt other = attempt(cycle, settings_.N, start, false);
    if (!other.plan.report.solved) continue;
    other.carries = false;
    if (!best.plan.report.solved || other.plan.report.cost < best.plan.report.cost)
      best = std::move(other);
  }
}

/// Where a cycle on a road has no plan: from a guess on the side of obstacles that is free.
void RecedingHorizon::try_free_way(const Cycle& cycle, Attempt& best) {
  ocp::Trajectory& along = guess_(cycle.request, cycle.way, nullptr);
  const ToPass pass{known_, std::max(settings_.sm_start, settings_.sm_end),
                    settings_.edge_clearance};
  auto start = free_way(along, *task_.road, footprint_, cycle.request.t_start, pass);
  best.carries = false;  // what is tried takes the multipliers' place
  Attempt other = attempt(cycle, settings_.N, start, false);
  if (!other.plan.report.solved) return;
  other.carries = false;
  best = std::move(other);
}

/// On finer meshes, whose rows stand closer, until the plan stays out of obstacles and on its
/// road, or soft rows know of all that it enters; a plan that never does is not solved, if they
/// must.
void RecedingHorizon::refine(const Cycle& cycle, Attempt& best) {
  if (best.plan.report.status != PlanStatus::passes_through || let_in(best.plan.report)) return;
  best.carries = false;  // what is tried takes the multipliers' place
  for (const int times : kRefined) {
    auto start = best.trajectory;
    Attempt finer = attempt(cycle, times * settings_.N, start, false);
    const SolveReport& report = finer.plan.report;
    const bool passes = report.status == PlanStatus::passes_through;
    if (passes ? let_in(report) : report.status == PlanStatus::solved) {
      best = std::move(finer);
      return;
    }
  }
  if (settings_.between_nodes == BetweenNodes::refine) best.plan.report.solved = false;
}

/// The next solve starts from a plan to be driven, and goes on from one that was cut short.
void RecedingHorizon::keep(const Cycle& cycle, Attempt& attempt) {
  const SolveReport& report = attempt.plan.report;
  if (!report.solved && !report.best_iterate && !attempt.cut_short) return;
  last_ = LastPlan{attempt.plan.t_start, cycle.request.X0p, std::move(attempt.trajectory),
                   cycle.way.in_range};
  carries_ = attempt.carries;
  if (!carries_) return;
  if (!same_names(chosen_, of_last_)) of_last_ = chosen_;
  std::swap(start_.y, answer_.point.y);
  std::swap(start_.zl, answer_.point.zl);
  std::swap(start_.zu, answer_.point.zu);
}

}  // namespace slalom::planner
