#pragma once

#include <span>
#include <vector>

#include "builder.hpp"
#include "numbers.hpp"
#include "slalom/nlp/sensitivity.hpp"
#include "slalom/ocp/trajectory.hpp"

namespace slalom::ocp {

/// How the functions of a transcription depend on the data that they were filled with, at a point:
/// exact derivatives, of the expressions that are evaluated with the data as further variables.
class DataSlopes {
 public:
  /// `t` outlives this; x and y are in the NLP's units.
  DataSlopes(const Transcribed& t, std::span<const double> x, std::span<const double> y);

  /// What moving along `direction` does to the NLP at the point.
  nlp::Dependence dependence(const Direction& direction) const;
  /// The rate of an output of a batch in a lane where the NLP's variables move by dx and the data
  /// along `direction`. Of batches with states' rates.
  double output_rate(std::size_t batch, std::size_t output, std::size_t lane,
                     std::span<const double> dx, const Direction& direction) const;

 private:
  /// A batch's derivatives by its variables and then by those data that move.
  struct Slopes {
    std::vector<std::size_t> columns;  ///< of the data, those that move
    expr::Function function;
    std::vector<double> jacobian, hessian;
  };
  Slopes slopes_of(std::size_t b, std::span<const double> x, std::span<const double> y) const;
  void add(std::size_t b, const Direction& direction, nlp::Dependence& out) const;

  const Transcribed& t_;
  std::vector<Slopes> slopes_;
};

/// The rates of everything in a trajectory, at equal tau, from those of the NLP's variables.
Trajectory trajectory_rate(const Problem& problem, const Transcribed& t, const DataSlopes& slopes,
                           std::span<const double> dx, const Direction& direction);

}  // namespace slalom::ocp
