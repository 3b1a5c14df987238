#include "slalom/ocp/interpolant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "point_functions.hpp"
#include "set_up_watch.hpp"
#include "slalom/base/error.hpp"
#include "slalom/ocp/quadrature.hpp"

namespace slalom::ocp {

struct Interpolant::Impl {
  /// What a scheme interpolates at: its collocated points.
  struct Basis {
    std::vector<std::size_t> collocated;
    Interpolation rates;
  };

  Trajectory trajectory;
  std::vector<double> breaks;
  std::vector<std::size_t> first;         ///< point of each node
  std::vector<Basis> bases;               ///< of consecutive equal schemes one
  std::vector<std::size_t> basis;         ///< of each interval
  std::vector<std::vector<double>> rate;  ///< [point][state]; of a node, the interval after it
  /// [interval][state]: at the interval's end, where a held control jumps there; else empty.
  std::vector<std::vector<double>> end_rate;
  std::vector<char> held;  ///< by control

  const std::vector<double>& rate_at(std::size_t k, std::size_t j) const {
    const std::size_t point = first[k] + j;
    return point == first[k + 1] && !end_rate[k].empty() ? end_rate[k] : rate[point];
  }

  std::pair<std::size_t, double> place(double t) const {
    const double span = trajectory.tf - trajectory.t0;
    const double tau = span > 0 ? std::clamp((t - trajectory.t0) / span, 0.0, 1.0) : 0.0;
    const auto above = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, tau);
    const auto k = static_cast<std::size_t>(above - breaks.begin()) - 1;
    return {k, std::clamp((tau - breaks[k]) / (breaks[k + 1] - breaks[k]), 0.0, 1.0)};
  }
  double duration(std::size_t k) const {
    return (breaks[k + 1] - breaks[k]) * (trajectory.tf - trajectory.t0);
  }
};

namespace {

Interpolation through(const Scheme& scheme, const std::vector<std::size_t>& points) {
  std::vector<double> at;
  for (const std::size_t j : points) at.push_back(scheme.points[j]);
  return Interpolation(std::move(at));
}

std::vector<std::size_t> collocated(const Scheme& scheme) {
  std::vector<std::size_t> list;
  for (std::size_t j = 0; j < scheme.points.size(); ++j)
    if (scheme.collocates(j)) list.push_back(j);
  return list;
}

}  // namespace

Interpolant::Interpolant(const Problem& problem, const Trajectory& trajectory, const Mesh& mesh,
                         const Schemes& schemes)
    : impl_(std::make_unique<Impl>()) {
  schemes.check(mesh);
  Impl& at = *impl_;
  at.trajectory = trajectory;
  at.breaks = mesh.breakpoints();
  std::size_t points = 0;
  const Scheme* last = nullptr;
  for (std::size_t k = 0; k < mesh.intervals(); ++k) {
    const Scheme& scheme = schemes.of(k);
    if (last == nullptr || (last != &scheme && last->points != scheme.points) ||
        last->name != scheme.name) {
      const auto list = collocated(scheme);
      at.bases.push_back({list, through(scheme, list)});
    }
    last = &scheme;
    at.basis.push_back(at.bases.size() - 1);
    at.first.push_back(points);
    points += scheme.points.size() - 1;
  }
  at.first.push_back(points);
  if (trajectory.tau.size() != points + 1)
    throw InvalidValue(problem.name() + ": interpolation",
                       fmt::format("{} points", trajectory.tau.size()),
                       fmt::format("{}, those of the mesh", points + 1));
  const PointFunctions functions(problem, trajectory);
  for (std::size_t p = 0; p <= points; ++p) {
    SetUpWatch::poll();
    auto& rate = at.rate.emplace_back(problem.states().size());
    functions.rates(trajectory.time(p), trajectory.states[p], trajectory.controls[p], rate);
  }
  for (const auto& control : problem.controls())
    at.held.push_back(control.form == ControlForm::constant ? 1 : 0);
  at.end_rate.resize(mesh.intervals());
  if (std::find(at.held.begin(), at.held.end(), 1) == at.held.end()) return;
  for (std::size_t k = 0; k < mesh.intervals(); ++k) {
    if (!schemes.of(k).collocates(0)) continue;  // held by its end
    const std::size_t end = at.first[k + 1];
    at.end_rate[k].resize(problem.states().size());
    functions.rates(trajectory.time(end), trajectory.states[end],
                    end_controls(problem, trajectory, at.first[k], end), at.end_rate[k]);
  }
}

Interpolant::~Interpolant() = default;
Interpolant::Interpolant(Interpolant&&) noexcept = default;
Interpolant& Interpolant::operator=(Interpolant&&) noexcept = default;

std::vector<double> Interpolant::states(double t) const {
  const auto [k, c] = impl_->place(t);
  return states(k, c);
}
std::vector<double> Interpolant::controls(double t) const {
  const auto [k, c] = impl_->place(t);
  return controls(k, c);
}

std::vector<double> Interpolant::states(std::size_t k, double c) const {
  const Impl& at = *impl_;
  const Impl::Basis& basis = at.bases[at.basis[k]];
  std::vector<double> x = at.trajectory.states[at.first[k]];
  const auto weight = basis.rates.integrals(0, c);
  for (std::size_t j = 0; j < weight.size(); ++j) {
    const auto& rate = at.rate_at(k, basis.collocated[j]);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += at.duration(k) * weight[j] * rate[i];
  }
  return x;
}

std::vector<double> Interpolant::controls(std::size_t k, double c) const {
  const Impl& at = *impl_;
  const Impl::Basis& basis = at.bases[at.basis[k]];
  std::vector<double> u(at.trajectory.controls.front().size(), 0.0);
  const auto weight = basis.rates.basis(c);
  for (std::size_t j = 0; j < weight.size(); ++j) {
    const auto& control = at.trajectory.controls[at.first[k] + basis.collocated[j]];
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += weight[j] * control[i];
  }
  const auto& reference = at.trajectory.controls[at.first[k] + basis.collocated.front()];
  for (std::size_t i = 0; i < u.size(); ++i)
    if (at.held[i]) u[i] = reference[i];
  return u;
}

Trajectory Interpolant::resampled(const Mesh& mesh, const Schemes& schemes) const {
  schemes.check(mesh);
  Trajectory result = impl_->trajectory;
  result.tau.clear();
  result.states.clear();
  result.controls.clear();
  const auto& breaks = mesh.breakpoints();
  const auto add = [&](double tau) {
    SetUpWatch::poll();
    result.tau.push_back(tau);
    const double t = result.t0 + tau * (result.tf - result.t0);
    result.states.push_back(states(t));
    result.controls.push_back(controls(t));
  };
  for (std::size_t k = 0; k < mesh.intervals(); ++k) {
    const auto& points = schemes.of(k).points;
    for (std::size_t j = 0; j + 1 < points.size(); ++j)
      add(breaks[k] + points[j] * (breaks[k + 1] - breaks[k]));
  }
  add(1);
  return result;
}

}  // namespace slalom::ocp
