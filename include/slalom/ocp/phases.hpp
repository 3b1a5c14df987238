#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "slalom/nlp/problem.hpp"
#include "slalom/nlp/solver.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/scheme.hpp"
#include "slalom/ocp/transcription.hpp"

namespace slalom::ocp {

/// Several phases and the links between their ends. Each phase is an optimal-control problem with
/// its own states, controls, times and parameters. The objective is the sum of the phases'
/// objectives and of further cost terms (mayer()). All set-up errors are exceptions that name the
/// phase and the wrong item.
class PhasedProblem {
 public:
  explicit PhasedProblem(std::string name);

  /// Appends a phase; their names must differ. Returns its number, from 0.
  std::size_t add(Problem phase);
  /// Replaces a phase by the same one with other numbers: bounds, scales, guesses, parameters.
  void replace(std::size_t number, Problem phase);
  /// A constraint between phases: an expression of initial(), final(), initial_time(),
  /// final_time(), static parameters and integrals of any of them. Without bounds it equals 0,
  /// unlike a row of path() or boundary(), which is refused without.
  void link(const std::string& name, const Expr& value, Bounds bounds = Bounds::equal(0));
  /// Makes the static parameter of that name the same in all phases that have it. Throws
  /// InvalidValue unless at least two phases have it.
  void share(const std::string& static_parameter);
  /// A cost term that may use what link() may use, from any phase; the objective is the sum of the
  /// phases' objectives and of these terms.
  void mayer(const std::string& name, const Expr& term);
  /// What connect() does not make continuous.
  struct Gaps {
    std::vector<std::string> without;  ///< states left alone; may contain "time"
    /// The increase of a state at the start of the later phase, such as -mass dropped.
    std::vector<std::pair<std::string, Expr>> jumps;
  };
  /// Makes time, and the states whose names both phases have, continuous from the end of `from` to
  /// the start of `to`, except for `gaps`. Throws InvalidValue if the phases share no state, and
  /// for a name in `gaps` that is not one of these states.
  void connect(std::size_t from, std::size_t to, const Gaps& gaps = {});

  struct Link {
    std::string name;
    Expr value;
    Bounds bounds;
  };
  const std::string& name() const { return name_; }
  const std::vector<Problem>& phases() const { return phases_; }
  const std::vector<Link>& links() const { return links_; }
  const std::vector<Problem::CostTerm>& costs() const { return costs_; }

 private:
  const Problem& phase(std::size_t number, const char* what) const;
  void add_links(const std::vector<Link>& links);

  std::string name_;
  std::vector<Problem> phases_;
  std::vector<Link> links_;
  std::vector<Problem::CostTerm> costs_;
};

/// A phased problem made into one stage-structured NLP. The phases' stages follow one after the
/// other; each phase's own times, parameters and integrals count as part of its last stage, where
/// they are eliminated.
class PhasedTranscription final : public nlp::Problem {
 public:
  /// How a phase is discretised.
  struct Grid {
    Mesh mesh = Mesh::uniform(40);
    Schemes schemes = hermite_simpson();
  };
  /// One grid for each phase. Throws InvalidValue for another number of grids, for a phase that no
  /// link touches (if there are several), and for a link with a foreign symbol.
  PhasedTranscription(const PhasedProblem& problem, const std::vector<Grid>& grids);
  ~PhasedTranscription() override;

  std::size_t phases() const;
  Transcription& phase(std::size_t number);
  /// The part of a point that belongs to a phase.
  nlp::Start part_of(std::size_t phase, const nlp::Start& point) const;
  /// First row of the links, in their order.
  std::size_t first_link() const;
  /// The problem's own cost terms at a point, in their order.
  std::vector<double> cost_terms(std::span<const double> x);

  const nlp::Structure& structure() const override;
  const nlp::Limits& limits() const override;
  nlp::Fault evaluate(std::span<const double> x, double sigma, std::span<const double> y,
                      nlp::Parts parts, nlp::Evaluation& out) override;
  std::string variable_name(std::size_t index) const override;
  std::string row_name(std::size_t index) const override;
  std::optional<nlp::Formulas> formulas() const override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slalom::ocp
