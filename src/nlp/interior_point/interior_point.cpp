// A primal-dual interior-point method with filter line search for stage-structured programs
// (Waechter & Biegler, Math. Program. 106, 2006), ending at a barrier floor where one is asked for.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "../backends.hpp"
#include "best_iterate.hpp"
#include "budget.hpp"
#include "descent.hpp"
#include "iteration_log.hpp"
#include "restoration.hpp"
#include "start.hpp"
#include "watchdog.hpp"

namespace slalom::nlp {
namespace {

using namespace ipm;

constexpr double kMostVariable = 1e20;  ///< beyond, iterates diverge
constexpr int kMostTinySteps = 2;
constexpr double kRoom = 1e-9;
/// Iterations that mu may be at its least with the rows met, and where the objective has become so
/// many times the first.
constexpr int kMostLow = 75, kFewLow = 10;
constexpr double kMet = 1e-4, kFar = 1e3;
constexpr double kMostBoundMultiplier = 1e8;  ///< of a bound with an interior, within reason
constexpr double kNoViolation = 1e-2;         ///< of the tolerance: nothing is left to restore
/// Violation at most that restoration hands back: a part of the search's (section 3.3), and of what
/// it handed back before, for where the search has got stuck with that, it takes a better point.
constexpr double kSufficient = 0.9, kStricter = 0.01;
constexpr std::size_t kLongestReason = 64;
constexpr const char* kBadStart = "a function is not finite at the start: try another guess";

/// The workspace of one problem structure, and a solve on it.
class Run final : public Restoration::Watch {
 public:
  explicit Run(Problem& problem)
      : structure_id_(problem.structure().id),
        form_(problem),
        descent_(form_),
        starter_(form_, descent_),
        watchdog_(form_),
        restoration_(form_, descent_) {
    descent_.give_up_at(&budget_);
    restoration_.give_up_at(&budget_);
  }
  Run(const Run&) = delete;

  bool fits(const Problem& problem) const {
    return structure_id_ != 0 && problem.structure().id == structure_id_ &&
           form_.fits(problem.limits());
  }

  /// `timer` has run since the solve's begin.
  void solve(Problem& problem, const Start& start, const Options& options, const Timer& timer,
             Answer& answer) {
    begin(problem, options, timer);
    Status status = iterate(start);
    const Options monotone = with_monotone_barrier(options);
    if (barrier_too_low_) {
      options_ = &monotone;
      status = iterate(start);
    }
    if (no_interior_ ||
        (status == Status::numerical_failure && options.floor == 0 && best_.feasible())) {
      // Bounds and rows that leave no interior have no central path: once more, with a little room.
      form_.set_room({std::min(kRoom, options.constraint_tol / 2), options.constraint_tol / 2});
      form_.refresh(problem);
      status = iterate(start);
      form_.set_room({});
    }
    // Equations that depend on each other may all hold; those that do not leave nothing to choose.
    const bool least = status == Status::infeasible;
    const bool in_vain =
        least || status == Status::numerical_failure || status == Status::iteration_limit;
    if (in_vain && !enough_freedom()) status = Status::too_few_freedoms;
    fill(status, start, answer, least);
  }

 private:
  // --- the method --------------------------------------------------------------------------
  Status iterate(const Start& start) {
    tiny_steps_ = low_iterations_ = 0;
    handed_back_ = std::numeric_limits<double>::infinity();
    watchdog_.restart(options_->warm_start);
    if (!starter_.prepare(start, *options_)) return Status::invalid_number;
    for (;; ++iterations_) {
      descent_.take_survey();
      offer_best();
      if (converged()) return Status::solved;
      if (const auto status = told_to_end()) return *status;
      if (leaves_no_interior() || fell_too_early()) return Status::numerical_failure;
      descent_.update_barrier();
      const auto failure = descent_.find_step() ? advance() : restore();
      if (failure) return *failure;
      if (!descent_.complete()) return Status::invalid_number;
      note_iteration(descent_, false);
    }
  }

  bool converged() {
    const Survey& s = descent_.survey();
    const double floor = options_->floor;
    if (floor > 0)
      return descent_.barrier().at_least() && s.dual <= options_->dual_tol &&
             s.primal <= options_->constraint_tol && s.off_centre(floor) <= options_->floor_tol &&
             meets_rows() && descent_.dual_in_users_units() <= options_->dual_tol;
    const double unit = form_.objective_scale();  // the checker's terms
    return s.error(0) <= options_->tol && s.dual <= options_->dual_tol * unit &&
           s.complementarity(0) <= options_->dual_tol * unit &&
           s.mean_product * s.bounds <=
               std::max(
                   kMostGap * std::max(unit, std::fabs(descent_.point().functions().objective)),
                   2 * kLeastGap * s.bounds) &&
           meets_rows();
  }

  /// To the tolerance, or as well as the rounding of the rows' own terms lets them be met.
  bool meets_rows() {
    const Evaluation& at = descent_.point().functions();
    return form_.violation(at) <= options_->constraint_tol ||
           form_.met_to_rounding(at, descent_.point().at().w, options_->constraint_tol);
  }

  /// Where an equation holds a variable at its bound, no slack stays: it falls by the fraction to
  /// the boundary with each step, whatever mu is, and its multiplier rises without end.
  bool leaves_no_interior() {
    if (options_->floor > 0 || form_.room().least > 0) return false;
    const auto& kernels = vector_kernels();
    const Iterate& at = descent_.point().at();
    no_interior_ = kernels.largest_magnitude(at.zl.size(), at.zl.data()) > kMostBoundMultiplier ||
                   kernels.largest_magnitude(at.zu.size(), at.zu.data()) > kMostBoundMultiplier;
    return no_interior_;
  }

  static Options with_monotone_barrier(Options options) {
    options.barrier_rule = BarrierRule::monotone;
    return options;
  }
  /// A step of the adaptive rule may land beside a bound with mu next to zero, far from where the
  /// objective is least: the rows are met, and there is no way off but many short steps.
  bool fell_too_early() {
    const Options& options = *options_;
    if (options.floor > 0 || options.barrier_rule != BarrierRule::adaptive) return false;
    const bool low = descent_.barrier().nearly_at_least() && descent_.survey().primal < kMet;
    low_iterations_ = low ? low_iterations_ + 1 : 0;
    const double objective = std::fabs(descent_.point().functions().objective);
    if (iterations_ == 0) first_objective_ = objective;
    const bool far = objective > kFar * std::max(1.0, first_objective_);
    barrier_too_low_ = low_iterations_ >= (far ? kFewLow : kMostLow);
    return barrier_too_low_;
  }

  /// Along the step, as the watchdog has it. Empty: go on.
  std::optional<Status> advance() {
    if (descent_.tiny_step() && ++tiny_steps_ >= kMostTinySteps && descent_.barrier().at_least())
      return Status::numerical_failure;
    return watchdog_.advance(descent_) == Watchdog::Outcome::moved ? std::nullopt : restore();
  }

  /// When no step is acceptable: less violation first, then on. Empty: go on.
  std::optional<Status> restore() {
    if (descent_.gave_up()) return Status::time_limit;
    const double violation = descent_.point().violation();
    if (violation <= kNoViolation * options_->constraint_tol)
      return descent_.last().fault ? Status::invalid_number : Status::numerical_failure;
    descent_.bar();
    const double most = std::max(std::min(kSufficient * violation, kStricter * handed_back_),
                                 options_->constraint_tol);
    const auto outcome = restoration_.run(*this, most, std::isfinite(handed_back_));
    watchdog_.restart();
    switch (outcome) {
      case Restoration::Outcome::restored:
        return resume() ? std::nullopt : std::optional(Status::invalid_number);
      case Restoration::Outcome::infeasible:
        if (!descent_.complete()) return Status::invalid_number;
        if (options_->floor == 0) restoration_.hand_back_multipliers();
        offer_best();
        // Least, and none that counts: where nothing is left to lessen, the search was stuck.
        return best_.feasible() ? Status::numerical_failure : Status::infeasible;
      case Restoration::Outcome::failed:
        return Status::numerical_failure;
      case Restoration::Outcome::stopped:
        break;
    }
    return end_ ? end_ : Status::time_limit;
  }

  /// From the point that restoration has handed back. False when a function is not finite there.
  [[nodiscard]] bool resume() {
    if (!descent_.complete()) return false;
    handed_back_ = descent_.point().violation();
    descent_.centre_multipliers();
    descent_.estimate_multipliers();
    return true;
  }

  // --- when to end -------------------------------------------------------------------------
  std::optional<Status> told_to_end() {
    end_ = budget_.spent(iterations_);
    if (!end_ && vector_kernels().largest_magnitude(form_.variables(),
                                                    descent_.point().at().w.data()) > kMostVariable)
      end_ = Status::unbounded;
    return end_;
  }
  bool stop() override { return told_to_end().has_value(); }
  void iterated(const Descent& restoration) override {
    note_iteration(restoration, true);
    ++iterations_;
  }
  bool enough_freedom() const {
    std::size_t free = 0;
    for (const char fixed : form_.fixed()) free += fixed ? 0 : 1;
    return form_.equations().size() <= free;
  }

  // --- begin and end -----------------------------------------------------------------------
  void begin(Problem& problem, const Options& options, const Timer& timer) {
    options_ = &options;
    budget_.begin(options, timer);
    iterations_ = 0;
    end_.reset();
    no_interior_ = barrier_too_low_ = false;
    form_.refresh(problem);
    best_.begin(form_, options.constraint_tol);
  }

  void offer_best() {
    const Point& point = descent_.point();
    best_.offer(point.at(), form_.violation(point.functions()), point.functions().objective,
                point.log_slacks(), descent_.barrier().mu());
  }

  void note_iteration(const Descent& descent, bool restoration) {
    if (options_->on_iteration == nullptr && options_->print_level == 0) return;
    budget_.call([&] {
      const IterationInfo info = iteration_info(descent, iterations_ + 1, restoration);
      if (options_->print_level > 0) print(info);
      if (options_->on_iteration != nullptr)
        options_->on_iteration(info, options_->on_iteration_data);
    });
  }

  /// `least`: the point is the one of least violation.
  void fill(Status status, const Start& start, Answer& answer, bool least) {
    answer.status = status;
    answer.backend = "interior_point/";
    answer.backend += descent_.newton().backend().name();
    answer.message.reserve(kLongestReason);
    answer.message = status == Status::invalid_number && best_.empty() ? kBadStart : reason(status);
    answer.fault = {};
    if (status == Status::invalid_number)
      answer.fault = form_.fault() ? form_.fault() : descent_.last().fault;
    answer.iterations = iterations_;
    const Point& point = descent_.point();
    if (best_.empty()) {
      hand_back(start, answer.point);
      answer.objective = answer.violation = 0;
    } else {
      // An infeasible problem's answer is where the sum of its violations is least.
      if (status != Status::solved && !least) go_back_to_best();
      hand_out(form_, point.at(), answer.point);
      answer.objective = point.functions().objective / form_.objective_scale();
      answer.violation = form_.violation(point.functions());
      if (status == Status::too_few_freedoms && !least)
        for (auto* multipliers : {&answer.point.y, &answer.point.zl, &answer.point.zu})
          std::fill(multipliers->begin(), multipliers->end(), 0.0);  // they say nothing
      answer.worst_row = answer.violation > 0 ? form_.worst_row(point.functions()) : 0;
    }
    budget_.report(answer);
  }

  /// The start, with 0 for the multipliers that it has not.
  void hand_back(const Start& start, Start& out) const {
    out = start;
    out.y.resize(form_.rows(), 0.0);
    out.zl.resize(form_.variables(), 0.0);
    out.zu.resize(form_.variables(), 0.0);
  }

  void go_back_to_best() {
    best_.restore(form_, descent_.barrier().mu(), descent_.point());
    (void)descent_.point().evaluate({.values = true});  // it was finite there
  }

  const std::uint64_t structure_id_;
  const Options* options_ = nullptr;
  Budget budget_;
  SlackForm form_;
  Descent descent_;
  Starter starter_;
  Watchdog watchdog_;
  Restoration restoration_;
  BestIterate best_;
  std::optional<Status> end_;
  bool no_interior_ = false, barrier_too_low_ = false;
  int low_iterations_ = 0;  ///< in a row, with mu (nearly) at its least and the rows met
  double first_objective_ = 0;
  int iterations_ = 0, tiny_steps_ = 0;
  double handed_back_ = 0;  ///< violation that the last restoration ended with
};

class InteriorPoint final : public Solver {
 public:
  using Solver::solve;
  void solve(Problem& problem, const Start& start, const Options& options,
             Answer& answer) override {
    const Timer timer;
    check_sizes(start, problem.structure(), options.warm_start);
    check(options, "solver options");
    for (auto& run : runs_)
      if (run && run->fits(problem)) return run->solve(problem, start, options, timer, answer);
    auto& run = runs_[next_++ % std::size(runs_)];
    run = std::make_unique<Run>(problem);
    run->solve(problem, start, options, timer, answer);
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
