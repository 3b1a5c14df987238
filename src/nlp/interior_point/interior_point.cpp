// A primal-dual interior-point method with filter line search for stage-structured programs
// (Waechter & Biegler, Math. Program. 106, 2006), ending at a barrier floor where one is asked for.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "../backends.hpp"
#include "best_iterate.hpp"
#include "descent.hpp"
#include "iteration_log.hpp"
#include "restoration.hpp"
#include "slalom/base/timer.hpp"
#include "start.hpp"
#include "watchdog.hpp"

namespace slalom::nlp {
namespace {

using namespace ipm;

constexpr double kMostVariable = 1e20;  ///< beyond, iterates diverge
constexpr int kMostTinySteps = 2;
constexpr double kRoom = 1e-9;
/// Violation at most that restoration hands back: a part of the search's (section 3.3), and of what
/// it handed back before, for where the search has got stuck with that, it takes a better point.
constexpr double kSufficient = 0.9, kStricter = 0.01;
constexpr std::size_t kLongestReason = 64;

/// The workspace of one problem structure, and a solve on it.
class Run final : public Restoration::Watch, public Deadline {
 public:
  explicit Run(Problem& problem)
      : structure_id_(problem.structure().id),
        descent_(problem),
        watchdog_(descent_.model),
        restoration_(descent_) {
    descent_.newton.give_up_at(this);
    restoration_.give_up_at(this);
  }
  Run(const Run&) = delete;

  /// Whether this workspace fits: the same structure, with the same equations and fixed variables.
  bool fits(const Problem& problem) const {
    if (structure_id_ == 0 || problem.structure().id != structure_id_) return false;
    const Limits& limits = problem.limits();
    const Model& model = descent_.model;
    for (std::size_t i = 0; i < model.variables(); ++i)
      if (model.fixed(i) != (limits.xl[i] == limits.xu[i])) return false;
    for (std::size_t r = 0; r < model.rows(); ++r)
      if (model.equation(r) != (limits.gl[r] == limits.gu[r])) return false;
    return true;
  }

  void solve(Problem& problem, const Start& start, const Options& options, Answer& answer) {
    begin(problem, options);
    Status status = enough_freedom() ? iterate(start) : Status::too_few_freedoms;
    if (status == Status::numerical_failure && options.floor == 0 && best_.feasible()) {
      // Rows that leave no interior have no central path: once more, with a little room.
      descent_.model.set_room(kRoom);
      descent_.model.refresh(problem);
      status = iterate(start);
      descent_.model.set_room(0);
    }
    fill(status, start, answer);
  }

 private:
  // --- the method --------------------------------------------------------------------------
  Status iterate(const Start& start) {
    if (!prepare(descent_, start, *options_)) return Status::invalid_number;
    descent_.search.reset(descent_.point.local.violation);
    for (;; ++iterations_) {
      descent_.take_survey();
      offer_best();
      if (converged()) return Status::solved;
      if (const auto status = told_to_end()) return *status;
      descent_.update_barrier();
      if (!descent_.find_step()) {
        if (const auto status = restore()) return *status;
      } else if (const auto status = advance()) {
        return *status;
      }
      if (!descent_.complete()) return Status::invalid_number;
      note_iteration(descent_, false);
    }
  }

  bool converged() const {
    const Survey& s = descent_.survey;
    const double floor = options_->floor;
    if (floor > 0)
      return descent_.barrier.at_least() && s.dual <= options_->dual_tol &&
             s.primal <= options_->constraint_tol && s.off_centre(floor) <= options_->floor_tol;
    const double unit = descent_.model.objective_scale();  // the checker's terms
    return s.error(0) <= options_->tol && s.dual <= options_->dual_tol * unit &&
           s.complementarity(0) <= options_->dual_tol * unit &&
           descent_.model.violation(descent_.point.e) <= options_->constraint_tol;
  }

  /// Along the step, by line search or, after many short ones, by the watchdog's leap.
  std::optional<Status> advance() {
    if (descent_.tiny_step() && ++tiny_steps_ >= kMostTinySteps && descent_.barrier.at_least())
      return Status::numerical_failure;
    switch (watchdog_.advance(descent_)) {
      case Watchdog::Outcome::moved:
        return std::nullopt;
      case Watchdog::Outcome::stuck:
        return restore();
    }
    return std::nullopt;
  }

  /// When no step is acceptable: less violation first, then on. Empty: go on.
  std::optional<Status> restore() {
    if (descent_.newton.gave_up()) return Status::time_limit;
    Point& point = descent_.point;
    if (point.local.violation <= 1e-2 * options_->constraint_tol)
      return descent_.last.faulted ? Status::invalid_number : Status::numerical_failure;
    descent_.search.filter().add(descent_.search.merit(point, descent_.barrier.mu()));
    restoration_.refresh();
    const double most =
        std::max(std::min(kSufficient * point.local.violation, kStricter * handed_back_),
                 options_->constraint_tol);
    const auto outcome = restoration_.run(*this, most, std::isfinite(handed_back_));
    watchdog_.restart();
    switch (outcome) {
      case Restoration::Outcome::restored:
        if (!descent_.complete()) return Status::invalid_number;
        handed_back_ = point.local.violation;
        descent_.centre_multipliers(descent_.barrier.mu());
        descent_.estimate_multipliers();
        point.have.hessian = false;  // it has the old multipliers
        return std::nullopt;
      case Restoration::Outcome::infeasible:
        if (!descent_.complete()) return Status::invalid_number;
        offer_best();
        return Status::infeasible;
      case Restoration::Outcome::failed:
        return Status::numerical_failure;
      case Restoration::Outcome::stopped:
        break;
    }
    return end_ ? end_ : Status::time_limit;
  }

  // --- when to end -------------------------------------------------------------------------
  std::optional<Status> told_to_end() {
    end_.reset();
    const double now = timer_.cpu() - callback_s_;
    if (iterations_ > 0) longest_step_ = std::max(longest_step_, now - last_iteration_);
    last_iteration_ = now;
    if (iterations_ >= options_->max_iterations) {
      end_ = Status::iteration_limit;
    } else if (now + longest_step_ > options_->time_limit) {
      end_ = Status::time_limit;
    } else if (asked_to_stop()) {
      end_ = Status::interrupted;
    } else if (vector_kernels().largest_magnitude(descent_.model.variables(),
                                                  descent_.point.at.w.data()) > kMostVariable) {
      end_ = Status::unbounded;
    }
    return end_;
  }
  bool passed() override {
    return std::isfinite(options_->time_limit) && timer_.cpu() - callback_s_ > options_->time_limit;
  }
  bool asked_to_stop() {
    if (options_->stop == nullptr) return false;
    const double before = timer_.cpu();
    const bool stop = options_->stop(options_->stop_data);
    callback_s_ += timer_.cpu() - before;
    return stop;
  }
  bool stop() override { return told_to_end().has_value(); }
  void iterated(const Descent& restoration) override {
    note_iteration(restoration, true);
    ++iterations_;
  }
  bool enough_freedom() const {
    std::size_t free = 0;
    for (const char fixed : descent_.model.fixed()) free += fixed ? 0 : 1;
    return descent_.model.equations().size() <= free;
  }

  // --- begin and end -----------------------------------------------------------------------
  void begin(Problem& problem, const Options& options) {
    options_ = &options;
    timer_ = Timer();
    iterations_ = tiny_steps_ = 0;
    handed_back_ = std::numeric_limits<double>::infinity();
    callback_s_ = longest_step_ = last_iteration_ = 0;
    end_.reset();
    descent_.model.refresh(problem);
    watchdog_.restart(options.warm_start);
    best_.begin(descent_.model, options.constraint_tol);
  }

  void offer_best() {
    const Point& point = descent_.point;
    best_.offer(point.at, descent_.model.violation(point.e),
                barrier_function(point, descent_.barrier.mu()));
  }

  void note_iteration(const Descent& descent, bool restoration) {
    if (options_->on_iteration == nullptr && options_->print_level == 0) return;
    const double before = timer_.cpu();
    const IterationInfo info = iteration_info(descent, iterations_ + 1, restoration);
    if (options_->print_level > 0) print(info);
    if (options_->on_iteration != nullptr)
      options_->on_iteration(info, options_->on_iteration_data);
    callback_s_ += timer_.cpu() - before;
  }

  void fill(Status status, const Start& start, Answer& answer) {
    Model& model = descent_.model;
    answer.status = status;
    answer.backend = "interior_point/";
    answer.backend += descent_.newton.backend().name();
    answer.message.reserve(kLongestReason);
    answer.message = reason(status);
    answer.fault = status == Status::invalid_number ? model.fault() : Fault{};
    if (best_.empty()) {
      hand_out(model, descent_.point.at, answer.point);
      answer.point.x = start.x;
      answer.objective = answer.violation = 0;
    } else {
      // An infeasible problem's answer is where the sum of its violations is least.
      if (status != Status::solved && status != Status::infeasible) go_back_to_best();
      hand_out(model, descent_.point.at, answer.point);
      answer.objective = descent_.point.e.objective / model.objective_scale();
      answer.violation = model.violation(descent_.point.e);
      answer.worst_row = answer.violation > 0 ? model.worst_row(descent_.point.e) : 0;
    }
    answer.iterations = iterations_;
    answer.cpu_s = timer_.cpu();
    answer.wall_s = timer_.wall();
    answer.callback_s = callback_s_;
    answer.longest_step_s = longest_step_;
  }

  void go_back_to_best() {
    Point& point = descent_.point;
    best_.restore(descent_.model, descent_.barrier.mu(), point.at);
    (void)descent_.model.evaluate(point.at, {.values = true}, point.e);  // it was finite there
  }

  const std::uint64_t structure_id_;
  const Options* options_ = nullptr;
  Timer timer_;
  Descent descent_;
  Watchdog watchdog_;
  Restoration restoration_;
  BestIterate best_;
  std::optional<Status> end_;
  int iterations_ = 0, tiny_steps_ = 0;
  double handed_back_ = 0;  ///< violation that the last restoration ended with
  double callback_s_ = 0, longest_step_ = 0, last_iteration_ = 0;
};

class InteriorPoint final : public Solver {
 public:
  using Solver::solve;
  void solve(Problem& problem, const Start& start, const Options& options,
             Answer& answer) override {
    check_sizes(start, problem.structure(), options.warm_start);
    check(options, "solver options");
    for (auto& run : runs_)
      if (run && run->fits(problem)) return run->solve(problem, start, options, answer);
    auto& run = runs_[next_++ % std::size(runs_)];
    run = std::make_unique<Run>(problem);
    run->solve(problem, start, options, answer);
  }

 private:
  std::unique_ptr<Run> runs_[2];  ///< a planner alternates between two forms of its problem
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<Solver> make_interior_point() {
  return std::make_unique<InteriorPoint>();
}

}  // namespace slalom::nlp
