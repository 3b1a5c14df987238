#include "study_draws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>

#include "../io/section.hpp"
#include "axis_values.hpp"

namespace slalom::sweep {
namespace {

using Normal = boost::math::normal_distribution<double>;
using boost::math::cdf;
using boost::math::complement;
using boost::math::quantile;

/// 64 binary digits as a number within (0, 1). The draws are spelt out, for the distributions of
/// the standard library differ from one to another.
double unit(std::uint64_t digits) {
  return (static_cast<double>(digits >> 11U) + 0.5) * 0x1p-53;
}

std::mt19937_64 generator_of(int seed, std::size_t stream, std::uint32_t part) {
  std::seed_seq mix{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(stream), part};
  return std::mt19937_64(mix);
}

using Points = std::vector<std::vector<double>>;

void fill_random(Points& points, int seed, std::size_t stream) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    auto generator = generator_of(seed, stream, static_cast<std::uint32_t>(k));
    for (auto& u : points[k]) u = unit(generator());
  }
}

void fill_latin_hypercube(Points& points, std::size_t dimension, int seed, std::size_t stream) {
  const auto n = points.size();
  std::vector<std::size_t> interval(n);
  for (std::size_t i = 0; i < dimension; ++i) {
    auto generator = generator_of(seed, stream, static_cast<std::uint32_t>(i));
    std::iota(interval.begin(), interval.end(), std::size_t{0});
    // Fisher and Yates; the bias of the remainder is below 1e-13.
    for (std::size_t k = n - 1; k > 0; --k) std::swap(interval[k], interval[generator() % (k + 1)]);
    for (std::size_t k = 0; k < n; ++k)
      points[k][i] =
          (static_cast<double>(interval[k]) + unit(generator())) / static_cast<double>(n);
  }
}

void fill_sobol(Points& points, std::size_t dimension, int seed, std::size_t stream) {
  auto generator = generator_of(seed, stream, 0);
  std::vector<std::uint64_t> shift(dimension);
  for (auto& digits : shift) digits = generator();
  boost::random::sobol sequence(dimension);
  for (std::size_t k = 0; k < points.size(); ++k)
    for (std::size_t i = 0; i < dimension; ++i)
      // The library leaves out the sequence's first point, zero, without which the first 2^m points
      // are no net.
      points[k][i] = unit((k == 0 ? 0 : sequence()) ^ shift[i]);
}

/// The parameters of a distribution: `count` numbers.
std::vector<double> parameters(const io::Value& list, std::size_t count,
                               const std::string& meaning) {
  const auto& items = some_items(list, meaning);
  if (items.size() != count)
    throw InvalidValue(list.place.to_string(), fmt::format("{} numbers", items.size()), meaning);
  std::vector<double> numbers;
  for (const auto& item : items) numbers.push_back(finite(item));
  return numbers;
}

void require(bool holds, const io::Value& item, const std::string& rule) {
  if (!holds) throw InvalidValue(item.place.to_string(), item.describe(), rule);
}

Distribution uniform(const io::Value& list) {
  const auto p = parameters(list, 2, "[low, high]");
  require(p[0] < p[1], list.items[1], "low < high");
  return {[=](double u) { return p[0] + (p[1] - p[0]) * u; }, {}, list.place};
}

Distribution normal(const io::Value& list) {
  const auto p = parameters(list, 2, "[mean, standard deviation]");
  require(p[1] > 0, list.items[1], "a standard deviation > 0");
  return {[=](double u) { return quantile(Normal(p[0], p[1]), u); }, {}, list.place};
}

Distribution lognormal(const io::Value& list) {
  const auto p = parameters(list, 2, "[median, standard deviation of the logarithm]");
  require(p[0] > 0, list.items[0], "a median > 0");
  require(p[1] > 0, list.items[1], "a standard deviation > 0");
  return {[=](double u) { return p[0] * std::exp(p[1] * quantile(Normal(), u)); }, {}, list.place};
}

/// Inversion between the ends' probabilities, counted from the nearer tail, where they keep their
/// digits (Devroye 1986, section II.2.1).
Distribution truncated_normal(const io::Value& list) {
  const auto p = parameters(list, 4, "[mean, standard deviation, low, high]");
  require(p[1] > 0, list.items[1], "a standard deviation > 0");
  require(p[2] < p[3], list.items[3], "low < high");
  const Normal whole(p[0], p[1]);
  const bool upper = p[2] > p[0];
  const double low = upper ? cdf(complement(whole, p[3])) : cdf(whole, p[2]);
  const double high = upper ? cdf(complement(whole, p[2])) : cdf(whole, p[3]);
  require(low < high && high > 1e-280, list,
          "an interval of positive probability, within 35 standard deviations of the mean");
  const auto value = [=](double u) {
    const double at = low + (high - low) * (upper ? 1 - u : u);
    const double x = upper ? quantile(complement(whole, at)) : quantile(whole, at);
    return std::clamp(x, p[2], p[3]);
  };
  return {value, {}, list.place};
}

Distribution choice(const io::Value& list) {
  Distribution drawn{{}, {}, list.place};
  for (const auto& item : some_items(list, "a list of values, each as likely as the others"))
    drawn.choices.push_back(&item);
  return drawn;
}

struct Named {
  const char* name;
  Distribution (*read)(const io::Value&);
};
constexpr Named kDistributions[] = {{"uniform", uniform},
                                    {"normal", normal},
                                    {"lognormal", lognormal},
                                    {"truncated_normal", truncated_normal},
                                    {"choice", choice}};

}  // namespace

std::size_t max_sobol_dimension() {
  return boost::random::default_sobol_table::max_dimension;
}

std::vector<std::vector<double>> unit_points(Sampling sampling, int count, std::size_t dimension,
                                             int seed, std::size_t stream) {
  Points points(static_cast<std::size_t>(count), std::vector<double>(dimension));
  switch (sampling) {
    case Sampling::random:
      fill_random(points, seed, stream);
      break;
    case Sampling::latin_hypercube:
      fill_latin_hypercube(points, dimension, seed, stream);
      break;
    case Sampling::sobol:
      fill_sobol(points, dimension, seed, stream);
      break;
  }
  return points;
}

Distribution read_distribution(const io::Value& map) {
  std::vector<std::string> known = {"key"};
  const io::Value* parameters = nullptr;
  Distribution (*read)(const io::Value&) = nullptr;
  for (const auto& one : kDistributions) {
    known.emplace_back(one.name);
    const io::Value* found = map.kind == io::Value::Kind::map ? map.find(one.name) : nullptr;
    if (found != nullptr && parameters != nullptr)
      throw InvalidValue(map.place.to_string(), "two distributions", "one for each key");
    if (found == nullptr) continue;
    parameters = found;
    read = one.read;
  }
  only(map, "a draw", known);
  if (parameters == nullptr)
    throw InvalidValue(map.place.to_string(), "a key without distribution",
                       "uniform, normal, lognormal, truncated_normal or choice");
  return read(*parameters);
}

}  // namespace slalom::sweep
