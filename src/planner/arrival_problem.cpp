#include "arrival_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "in_terms_of.hpp"
#include "obstacle_view.hpp"
#include "region_rows.hpp"
#include "slalom/ocp/scheme.hpp"
#include "solving.hpp"

namespace slalom::planner {

using namespace vehicle;
using ocp::Bounds;
using ocp::Points;

namespace {

/// Each interval of the mesh is longer than the one before by this factor.
constexpr double kGrowth = 1.03;
/// Where rows of close obstacles hold about each point, in lengths of the interval: points are
/// half an interval apart.
const std::vector<double>& shares(bool between) {
  static const std::vector<double> all = {-0.2, -0.1, 0, 0.1, 0.2}, none = {0};
  return between ? all : none;
}
/// Points of the guess for each interval.
constexpr int kGuessPoints = 4;
/// An answer that is not solved starts a tracked motion still, up to this violation [its unit].
constexpr double kNearlySolved = 1e-2;
/// Wheel loads are greater than what verification asks for by this [N].
constexpr double kLoadSpare = 100;
/// Rows of wheel loads are in kilonewtons, of one size with the others.
constexpr double kKilo = 1e-3;
/// Weight of the steering rate beside that of the paper: whole ways are smoother for it.
constexpr double kSteeringRate = 20, kJerk = 5;
/// Share of the paper's weight of the area between the path and the line through the goal.
constexpr double kArea = 0.02;

}  // namespace

ArrivalProblem::Room ArrivalProblem::room_for(const Obstacles& obstacles) {
  const auto in_steps = [](std::size_t number, std::size_t first) {
    std::size_t room = 0;
    while (room < number) room = std::max(first, 2 * room);
    return room;
  };
  Room room{ObstacleRows::counts(obstacles.far), ObstacleRows::counts(obstacles.close)};
  for (const auto kind : ObstacleRows::kKinds) {
    const auto of = static_cast<std::size_t>(kind);
    room.far[of] = in_steps(room.far[of], 4);
    room.close[of] = in_steps(room.close[of], 2);
  }
  return room;
}

bool ArrivalProblem::Room::holds(const Room& other) const {
  const auto each = [](const auto& some, const auto& more) {
    return std::equal(some.begin(), some.end(), more.begin(), std::less_equal<>());
  };
  return each(other.far, far) && each(other.close, close);
}

ArrivalProblem::ArrivalProblem(const Task& task, const Room& room)
    : room_(room),
      intervals_(task.planner.arrival_N),
      shares_(shares(task.planner.rows_between)),
      rows_(world::Footprint(task.vehicle), 0, room.close[2] > 0),
      problem_("arrival"),
      road_(task.road) {
  add_dynamics(task);
  add_obstacles();
  if (road_) corridor_.emplace(problem_, X_[X], X_[Y], X_[PSI], world::Footprint(task.vehicle));
  add_cost(task);
  end_.emplace(problem_, task, X_, t_start_);
  set_obstacles({}, 0, 0);
  std::vector<double> lengths;
  for (double length = 1; std::ssize(lengths) < intervals_; length *= kGrowth)
    lengths.push_back(length);
  transcription_.emplace(problem_, mesh_of(lengths), ocp::hermite_simpson());
  tau_ = transcription_->trajectory(transcription_->point(transcription_->straight_guess())).tau;
}

void ArrivalProblem::add_dynamics(const Task& task) {
  const Parameters& p = task.vehicle;
  const Model model = make_model(p);
  std::array<Bounds, kStates> bounds;
  const world::Footprint footprint(p);
  const auto place = region_bounds(task.region, footprint);
  bounds[X] = place[0];
  bounds[Y] = place[1];
  bounds[SA] = {-p.sa_max(), p.sa_max()};
  bounds[UX] = {p.ux_min, p.ux_max};
  for (std::size_t i = 0; i < kStates; ++i) {
    X_[i] = problem_.state(kStateNames[i], bounds[i]);
    X0p_[i] = problem_.parameter(std::string("X0p_") + kStateNames[i], 0);
  }
  U_[SR] = problem_.control("sr", {-p.sr_max(), p.sr_max()});
  U_[JX] = problem_.control("jx", {-p.jx_max, p.jx_max});
  t_start_ = problem_.parameter("t_start", 0);
  problem_.initial_time(Bounds::equal(0), 0);
  problem_.final_time({task.planner.tf_min, task.planner.arrival_tf_max}, 10);
  rate_ = in_terms_of(model.derivative, model, X_, U_);
  for (std::size_t i = 0; i < kStates; ++i) {
    problem_.dynamics(X_[i], rate_[i]);
    problem_.boundary(std::string("initial ") + kStateNames[i], problem_.initial(X_[i]) - X0p_[i],
                      Bounds::equal(0));
  }
  // A tracked answer is off it by a little.
  const double wheel_load = task.planner.verified_wheel_load + kLoadSpare;
  add_limits(model, std::max(p.Fz_min, wheel_load));
  add_region_rows(problem_, task.region, footprint, X_, Points::after_first);
}

void ArrivalProblem::add_limits(const Model& model, double wheel_load) {
  const auto limits = in_terms_of(std::array{model.ax_min, model.ax_max}, model, X_, U_);
  const auto add = [&](const std::string& name, const Expr& spare) {
    problem_.path(name, spare, Bounds::at_least(0), Points::after_first);
  };
  add("ax above ax_min", X_[AX] - limits[0]);
  add("ax below ax_max", limits[1] - X_[AX]);
  const auto Fz = in_terms_of(model.wheel_loads, model, X_, U_);
  for (std::size_t w = 0; w < kWheels; ++w)
    add(std::string("wheel load ") + kWheelNames[w], kKilo * (Fz[w] - wheel_load));
}

void ArrivalProblem::add_obstacles() {
  const Expr share = Expr::symbol("share");
  // The length of the interval about a point, as the mesh grows along tau.
  const double whole = std::pow(kGrowth, intervals_) - 1;
  const Expr interval =
      (1 + whole * problem_.tau()) * ((kGrowth - 1) / whole) * problem_.final_time();
  const Expr after = share * interval;
  const Expr t = t_start_ + problem_.time() + after;
  for (const auto kind : ObstacleRows::kKinds) {
    const auto of = static_cast<std::size_t>(kind);
    if (room_.far[of] > 0)
      far_rows_[of] = problem_.path_family(
          std::string("far ") + ObstacleRows::name(kind), rows_.symbols(kind, false),
          rows_.outside(kind, X_[X] - rows_.x(), X_[Y] - rows_.y(), X_[PSI], 0, {}),
          Bounds::at_least(0), Points::after_first);
    if (room_.close[of] == 0) continue;
    const Expr dx = X_[X] + after * rate_[X] - rows_.x() - rows_.vx() * t;
    const Expr dy = X_[Y] + after * rate_[Y] - rows_.y() - rows_.vy() * t;
    auto symbols = rows_.symbols(kind, true);
    symbols.push_back(share);
    close_rows_[of] =
        problem_.path_family(std::string("close ") + ObstacleRows::name(kind), symbols,
                             rows_.outside(kind, dx, dy, X_[PSI] + after * rate_[PSI], 0, t),
                             Bounds::at_least(0), Points::after_first);
  }
}

/// Of a row; of one of the close ones, the share of an interval after each point at which it holds.
/// Those that vary are taken as they are when a motion over tf from t_start is at the point.
std::vector<double> ArrivalProblem::row_numbers(const world::Obstacle& o,
                                                std::optional<double> share, double t_start,
                                                double tf) const {
  std::vector<double> row;
  const auto add = [&](const ObstacleRows::Moment& moment) {
    const auto at = rows_.numbers(o, moment, share.has_value());
    row.insert(row.end(), at.begin(), at.end());
    if (share) row.push_back(*share);
  };
  if (!varies(o)) {
    add({});
    return row;
  }
  for (std::size_t k = 0; k < tau_.size(); ++k)
    add({.t = t_start + tau_[k] * tf, .around = tf * (k > 0 ? tau_[k] - tau_[k - 1] : tau_[1])});
  return row;
}

/// Places that no obstacle takes are taken by one far away from everything.
void ArrivalProblem::set_obstacles(const Obstacles& obstacles, double t_start, double tf) {
  const auto set = [&](ocp::ConstraintId rows, std::vector<std::vector<double>> numbers) {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < numbers.size(); ++k) names.push_back(fmt::format("{}", k));
    problem_.set_members(rows, std::move(names), std::move(numbers));
  };
  for (const auto kind : ObstacleRows::kKinds) {
    const auto of = static_cast<std::size_t>(kind);
    std::vector<std::vector<double>> far, close;
    for (const auto& o : obstacles.far)
      if (ObstacleRows::kind_of(o) == kind) far.push_back(row_numbers(o, {}, t_start, tf));
    for (const auto& o : obstacles.close)
      if (ObstacleRows::kind_of(o) == kind)
        for (const double share : shares_) close.push_back(row_numbers(o, share, t_start, tf));
    far.resize(room_.far[of], rows_.nowhere(kind, false));
    auto nowhere = rows_.nowhere(kind, true);
    nowhere.push_back(0);
    close.resize(room_.close[of] * shares_.size(), nowhere);
    if (room_.far[of] > 0) set(far_rows_[of], std::move(far));
    if (room_.close[of] > 0) set(close_rows_[of], std::move(close));
  }
}

void ArrivalProblem::add_cost(const Task& task) {
  const Settings& s = task.planner;
  const auto& goal = task.goal;
  problem_.mayer("final_time", s.w_t * problem_.final_time());
  problem_.lagrange("control_effort",
                    s.w_ce * (s.w_sa * square(X_[SA]) + kSteeringRate * s.w_sr * square(U_[SR]) +
                              kJerk * s.w_jx * square(U_[JX])));
  // A road says where it leads.
  if (task.road) return;
  problem_.lagrange("heading_area", kArea * s.w_haf *
                                        square(std::sin(goal.psi) * (X_[X] - goal.x) -
                                               std::cos(goal.psi) * (X_[Y] - goal.y)));
}

void ArrivalProblem::set_corridor(const Motion& guess, const State& X0p, double tf, double margin) {
  if (!corridor_) return;
  std::vector<State> at;
  std::vector<double> after;
  for (const double tau : tau_) {
    after.push_back(tau * tf);
    at.push_back(guess.state_at(guess.begin() + tau * tf));
  }
  at[0] = X0p;
  corridor_->set(problem_, *road_, at, after, margin);
}

std::optional<Motion> ArrivalProblem::solve(const Motion& guess, const State& X0p,
                                            const Obstacles& obstacles, double edge_margin,
                                            nlp::Solver& solver, const nlp::Options& options) {
  const double t_start = guess.begin(), tf = end_->duration(guess);
  if (!(tf > 0)) {  // the goal's time is up when the motion begins
    answer_.iterations = 0;
    answer_.cpu_s = 0;
    return std::nullopt;
  }
  set_obstacles(obstacles, t_start, tf);
  set_corridor(guess, X0p, tf, edge_margin);
  end_->set(problem_, guess);
  for (std::size_t i = 0; i < kStates; ++i) problem_.set_parameter(X0p_[i], X0p[i]);
  problem_.set_parameter(t_start_, t_start);
  transcription_->update(problem_);
  ocp::Trajectory start;
  start.tf = tf;
  const int points = kGuessPoints * intervals_;
  for (int k = 0; k <= points; ++k) {
    const double tau = static_cast<double>(k) / points;
    const State x = k == 0 ? X0p : guess.state_at(t_start + tau * tf);
    const Control u = guess.control_at(t_start + tau * tf);
    start.tau.push_back(tau);
    start.states.emplace_back(x.begin(), x.end());
    start.controls.emplace_back(u.begin(), u.end());
  }
  solver.solve(*transcription_, {transcription_->point(start), {}, {}, {}}, options, answer_);
  if (answer_.status != nlp::Status::solved && !(answer_.violation < kNearlySolved))
    return std::nullopt;
  const auto found = transcription_->trajectory(answer_.point.x);
  Motion motion;
  for (std::size_t k = 0; k < found.tau.size(); ++k) {
    State x;
    Control u;
    std::copy_n(found.states[k].begin(), x.size(), x.begin());
    std::copy_n(found.controls[k].begin(), u.size(), u.begin());
    motion.add(t_start + found.tau[k] * found.tf, x, u);
  }
  return motion;
}

}  // namespace slalom::planner
