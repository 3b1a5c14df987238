#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "../io/document.hpp"

namespace slalom::sweep {

/// How the points of a draw fill their space.
enum class Sampling { random, latin_hypercube, sobol };

/// Most keys of one Sobol draw: those for which direction numbers are tabulated.
std::size_t max_sobol_dimension();

/// `count` points of the unit cube of `dimension` edges, each coordinate within (0, 1); the same
/// for the same seed and stream, which tells the draws of one axis from those of the others.
///   random: independent. More points leave the first ones as they were.
///   latin_hypercube: each of `count` equal intervals of each edge holds one point (McKay, Beckman
///     and Conover 1979). Other counts are other points.
///   sobol: Sobol's sequence from its zero on, each edge shifted by random binary digits (L'Ecuyer
///     and Lemieux 2002, section 5). More points leave the first ones as they were. Throws
///     std::invalid_argument above max_sobol_dimension().
std::vector<std::vector<double>> unit_points(Sampling sampling, int count, std::size_t dimension,
                                             int seed, std::size_t stream);

/// What a key is drawn from.
struct Distribution {
  std::function<double(double u)> quantile;  ///< its number at a coordinate u within (0, 1); or
  std::vector<const io::Value*> choices;     ///< values, each as likely as the others
  io::Place place;

  /// The choice at a coordinate.
  const io::Value& chosen(double u) const {
    return *choices[static_cast<std::size_t>(u * static_cast<double>(choices.size()))];
  }
};

/// Reads the distribution of {key: ..., NAME: [...]}, which must outlive it. Throws InvalidValue
/// for none, two, or parameters that make none.
Distribution read_distribution(const io::Value& map);

}  // namespace slalom::sweep
