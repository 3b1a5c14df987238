#include "slalom/ocp/scheme.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"
#include "slalom/ocp/quadrature.hpp"

namespace slalom::ocp {

Mesh Mesh::uniform(int intervals) {
  if (intervals < 1)
    throw InvalidValue("mesh", fmt::format("{} intervals", intervals), "at least 1");
  std::vector<double> breakpoints(static_cast<std::size_t>(intervals) + 1);
  for (std::size_t k = 0; k < breakpoints.size(); ++k)
    breakpoints[k] = static_cast<double>(k) / intervals;
  return Mesh(std::move(breakpoints));
}

Mesh::Mesh(std::vector<double> breakpoints) : breakpoints_(std::move(breakpoints)) {
  if (breakpoints_.size() < 2)
    throw InvalidValue("mesh", fmt::format("{} breakpoints", breakpoints_.size()), "at least 2");
  if (breakpoints_.front() != 0 || breakpoints_.back() != 1)
    throw InvalidValue(
        "mesh", fmt::format("breakpoints from {} to {}", breakpoints_.front(), breakpoints_.back()),
        "from 0 to 1");
  for (std::size_t k = 1; k < breakpoints_.size(); ++k)
    if (!(breakpoints_[k] > breakpoints_[k - 1]))
      throw InvalidValue(
          "mesh",
          fmt::format("breakpoint {} = {} after {}", k, breakpoints_[k], breakpoints_[k - 1]),
          "strictly increasing breakpoints");
}

const Scheme& trapezoidal() {
  static const Scheme scheme{"trapezoidal", 2, {0, 1}, {{-1, 1}}, {{0.5, 0.5}}, {0.5, 0.5}};
  return scheme;
}

const Scheme& hermite_simpson() {
  // Defect 0 ties the midpoint: x_m - (x_0 + x_1)/2 - h/8 (f_0 - f_1); defect 1 is Simpson's rule.
  static const Scheme scheme{"hermite_simpson",
                             4,
                             {0, 0.5, 1},
                             {{-0.5, 1, -0.5}, {-1, 0, 1}},
                             {{0.125, 0, -0.125}, {1.0 / 6, 4.0 / 6, 1.0 / 6}},
                             {1.0 / 6, 4.0 / 6, 1.0 / 6}};
  return scheme;
}

Scheme hermite_simpson_compressed() {
  Scheme scheme = hermite_simpson();
  scheme.name = "hermite_simpson_compressed";
  scheme.state.erase(scheme.state.begin());
  scheme.rate.erase(scheme.rate.begin());
  scheme.compressed = true;
  return scheme;
}

bool Scheme::collocates(std::size_t j) const {
  return weight[j] != 0 ||
         std::any_of(rate.begin(), rate.end(), [&](const auto& row) { return row[j] != 0; });
}

Scheme backward_euler() {
  return {"backward_euler", 1, {0, 1}, {{-1, 1}}, {{0, 1}}, {0, 1}};
}

namespace {

/// x_i - x_0 - h times the integral, up to point i, of the rates' interpolant through the points
/// from `first` to `last`; for every point but the first.
Scheme integrated(std::string name, int order, std::vector<double> points, std::size_t first,
                  std::size_t last) {
  const std::size_t size = points.size();
  const auto at = [&](std::size_t i) { return points.begin() + static_cast<std::ptrdiff_t>(i); };
  const Interpolation rates(std::vector<double>(at(first), at(last + 1)));
  Scheme scheme{std::move(name), order, std::move(points), {}, {}, {}};
  for (std::size_t i = 1; i < size; ++i) {
    auto& state = scheme.state.emplace_back(size, 0.0);
    state[0] = -1;
    state[i] = 1;
    const auto integrals = rates.integrals(0, scheme.points[i]);
    auto& rate = scheme.rate.emplace_back(size, 0.0);
    std::copy(integrals.begin(), integrals.end(),
              rate.begin() + static_cast<std::ptrdiff_t>(first));
  }
  scheme.weight = scheme.rate.back();
  return scheme;
}

std::vector<double> to_unit(const std::vector<double>& points) {
  std::vector<double> list;
  for (const double x : points) list.push_back(x == 1 ? 1 : (1 + x) / 2);
  return list;
}

std::vector<double> radau_points(int n) {
  auto points = to_unit(legendre_gauss_radau(n).points);
  points.push_back(1);
  return points;
}

}  // namespace

Scheme lgr(int n) {
  auto points = radau_points(n);
  return integrated("lgr", 2 * n - 1, std::move(points), 0, static_cast<std::size_t>(n) - 1);
}

Scheme lgr_flipped(int n) {
  const auto radau = radau_points(n);
  std::vector<double> points{0};
  for (std::size_t i = radau.size() - 1; i-- > 0;) points.push_back(1 - radau[i]);
  return integrated("lgr_flipped", 2 * n - 1, std::move(points), 1, static_cast<std::size_t>(n));
}

Scheme lgr_differential(int n) {
  Scheme scheme = lgr(n);
  scheme.name = "lgr_differential";
  scheme.state = Interpolation(scheme.points).differentiation();
  scheme.state.pop_back();  // the end is not collocated
  for (std::size_t i = 0; i < scheme.rate.size(); ++i) {
    scheme.rate[i].assign(scheme.points.size(), 0.0);
    scheme.rate[i][i] = 1;
  }
  return scheme;
}

Scheme lgl(int n) {
  auto points = to_unit(legendre_gauss_lobatto(n).points);
  const std::size_t last = points.size() - 1;
  return integrated("lgl", 2 * n - 2, std::move(points), 0, last);
}

const std::vector<std::string>& scheme_names() {
  static const std::vector<std::string> names = {"backward_euler",
                                                 "trapezoidal",
                                                 "hermite_simpson",
                                                 "hermite_simpson_compressed",
                                                 "lgr",
                                                 "lgr_differential",
                                                 "lgr_flipped",
                                                 "lgl"};
  return names;
}

bool has_choice_of_points(const std::string& name) {
  return name == "lgr" || name == "lgr_differential" || name == "lgr_flipped" || name == "lgl";
}

Scheme scheme(const std::string& name, int points) {
  if (name == "backward_euler") return backward_euler();
  if (name == "trapezoidal") return trapezoidal();
  if (name == "hermite_simpson") return hermite_simpson();
  if (name == "hermite_simpson_compressed") return hermite_simpson_compressed();
  if (name == "lgr") return lgr(points);
  if (name == "lgr_differential") return lgr_differential(points);
  if (name == "lgr_flipped") return lgr_flipped(points);
  if (name == "lgl") return lgl(points);
  const std::string nearest = nearest_name(name, scheme_names());
  throw InvalidValue("scheme", "'" + name + "'",
                     nearest.empty() ? fmt::format("one of {}", fmt::join(scheme_names(), ", "))
                                     : "perhaps '" + nearest + "'");
}

Schemes::Schemes(std::vector<Scheme> list) : list_(std::move(list)) {
  if (list_.empty()) throw InvalidValue("schemes", "none", "one, or one for each interval");
}

void Schemes::check(const Mesh& mesh) const {
  if (list_.size() != 1 && list_.size() != mesh.intervals())
    throw InvalidValue("schemes", fmt::format("{}", list_.size()),
                       fmt::format("one, or one for each of {} intervals", mesh.intervals()));
}

std::size_t Schemes::most_points() const {
  std::size_t most = 0;
  for (const auto& scheme : list_) most = std::max(most, scheme.points.size());
  return most;
}

}  // namespace slalom::ocp
