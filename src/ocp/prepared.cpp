#include "slalom/ocp/prepared.hpp"

#include <utility>

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
    to.set_scale(ConstraintId{i}, from.constraints()[i].scale);
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
    try {
      Problem scaled = problem;
      copy_scales(problem_, scaled);
      transcription_->update(scaled);
      problem_ = std::move(scaled);
    } catch (const InvalidValue&) {
      transcribe(problem);  // which says what is wrong if more is than the structure
    }
  }

  Solution solve(const nlp::Start& start) {
    Solution solution;
    const auto point = run(*transcription_, *solver_, options_, start,
                           transcription_->regular_variables(), solution);
    describe(problem_, grid_, tables_, *transcription_, point, solution);
    return solution;
  }

  const Problem& problem() const { return problem_; }
  const PhasedTranscription::Grid& grid() const { return grid_; }
  Transcription& transcription() { return *transcription_; }
  nlp::Options& options() { return options_; }

 private:
  void transcribe(const Problem& problem) {
    grid_ = with_moments(problem, given_);
    Problem scaled = with_scales(problem, begin(problem, grid_, guess_, nullptr).guess);
    transcription_ = std::make_unique<Transcription>(scaled, grid_.mesh, grid_.schemes);
    tables_ = Tables(scaled);
    problem_ = std::move(scaled);
  }

  Problem problem_{""};
  Tables tables_;
  PhasedTranscription::Grid given_, grid_;  ///< grid_ with the problem's moments
  nlp::Options options_;
  Trajectory guess_;
  std::unique_ptr<nlp::Solver> solver_;
  std::unique_ptr<Transcription> transcription_;
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
  const Beginning beginning = begin(impl_->problem(), impl_->grid(), guess, nullptr);
  return impl_->solve(start_of(impl_->transcription(), beginning));
}

Solution Prepared::solve(const Trajectory& guess, const Duals& duals) {
  check_guess(guess, impl_->problem());
  return impl_->solve(start_of(impl_->transcription(), {guess, duals}));
}

const nlp::Options& Prepared::options() const {
  return impl_->options();
}
void Prepared::set_options(const nlp::Options& options) {
  impl_->options() = options;
}

}  // namespace slalom::ocp
