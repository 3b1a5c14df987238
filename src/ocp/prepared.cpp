#include "slalom/ocp/prepared.hpp"

#include <limits>
#include <utility>

#include "set_up_watch.hpp"
#include "slalom/base/error.hpp"
#include "slalom/ocp/guess.hpp"
#include "slalom/ocp/moments.hpp"
#include "slalom/ocp/scaling.hpp"
#include "solved.hpp"

namespace slalom::ocp {
namespace {

/// Gives `to` the scales of `from`, which is the same problem with other numbers.
void copy_scales(const Problem& from, Problem& to) {
  const auto copy = [&to](const auto& list) {
    for (const auto& variable : list) to.set_scale(variable.symbol, variable.scale);
  };
  copy(from.states());
  copy(from.controls());
  copy(from.static_parameters());
  copy(from.slacks());
  copy(from.integrals());
  to.set_scale(to.initial_time(), from.t0().scale);
  to.set_scale(to.final_time(), from.tf().scale);
  for (std::size_t i = 0; i < from.constraints().size(); ++i)
    if (const double scale = from.constraints()[i].scale; scale != kAutomaticScale)
      to.set_scale(ConstraintId{i}, scale);
}

}  // namespace

class Prepared::Impl {
 public:
  Impl(const Problem& problem, const SolveSettings& settings)
      : given_{settings.mesh, settings.scheme},
        options_(settings.options),
        guess_(settings.guess),
        solver_(nlp::make_solver(settings.backend)) {
    transcribe(problem);
  }

  void update(const Problem& problem) {
    if (!transcription_) return transcribe(problem);
    try {
      Problem scaled = problem;
      copy_scales(problem_, scaled);
      transcription_->update(scaled);
      problem_ = std::move(scaled);
    } catch (const InvalidValue&) {
      transcribe(problem);  // which says what is wrong if more is than the structure
    }
  }

  Solution solve(const Beginning& beginning) {
    const nlp::Start start = start_of(*transcription_, beginning);
    Solution solution;
    const auto point = run(*transcription_, *solver_, options_, start,
                           transcription_->regular_variables(), solution);
    describe(problem_, grid_, tables_, *transcription_, point, solution);
    return solution;
  }

  const Problem& problem() const { return problem_; }
  const PhasedTranscription::Grid& grid() const { return grid_; }
  nlp::Options& options() { return options_; }
  bool stopped() const { return !transcription_; }

  /// The answer of a solve for which nothing is set up.
  Solution not_begun(const Trajectory& guess) const {
    Solution solution = ocp::not_begun(problem_, given_, guess, nullptr);
    solution.status = nlp::Status::interrupted;
    solution.objective = std::numeric_limits<double>::quiet_NaN();
    solution.options = options_;
    return solution;
  }

 private:
  /// The callback ends it. The time limit is of each solve, and this is done once for many.
  void transcribe(const Problem& problem) {
    nlp::Options options = options_;
    options.time_limit = std::numeric_limits<double>::infinity();
    const SetUpWatch watch(options);
    try {
      auto grid = with_moments(problem, given_);
      Problem scaled = with_scales(problem, begin(problem, grid, guess_, nullptr).guess);
      transcription_ = std::make_unique<Transcription>(scaled, grid.mesh, grid.schemes);
      grid_ = std::move(grid);
      tables_ = Tables(scaled);
      problem_ = std::move(scaled);
    } catch (const SetUpWatch::Stopped&) {
      transcription_.reset();
      problem_ = problem;
    }
  }

  Problem problem_{""};
  Tables tables_;
  PhasedTranscription::Grid given_, grid_;  ///< grid_ with the problem's moments
  nlp::Options options_;
  Trajectory guess_;
  std::unique_ptr<nlp::Solver> solver_;
  std::unique_ptr<Transcription> transcription_;  ///< null once its set-up was stopped
};

Prepared::Prepared(const Problem& problem, const SolveSettings& settings)
    : impl_(std::make_unique<Impl>(problem, settings)) {}
Prepared::~Prepared() = default;
Prepared::Prepared(Prepared&&) noexcept = default;
Prepared& Prepared::operator=(Prepared&&) noexcept = default;

void Prepared::update(const Problem& problem) {
  impl_->update(problem);
}

Solution Prepared::solve(const Trajectory& guess) {
  if (impl_->stopped()) return impl_->not_begun(guess);
  return impl_->solve(begin(impl_->problem(), impl_->grid(), guess, nullptr));
}

Solution Prepared::solve(const Trajectory& guess, const Duals& duals) {
  check_guess(guess, impl_->problem());
  if (impl_->stopped()) return impl_->not_begun(guess);
  return impl_->solve({guess, duals});
}

const nlp::Options& Prepared::options() const {
  return impl_->options();
}
void Prepared::set_options(const nlp::Options& options) {
  impl_->options() = options;
}

}  // namespace slalom::ocp
