#include "integrator.hpp"

#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>

#include "../base/integrate.hpp"

namespace slalom::ocp {
namespace {

namespace odeint = boost::numeric::odeint;

/// Of a stretch: one that needs shorter steps blows up.
constexpr double kLeastStep = 1e-14;

}  // namespace

double Integrator::across(double duration, const Rates& rates, std::vector<double>& x) const {
  using Vector = std::vector<double>;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] /= scale_[i];
  Vector states(x.size());
  const auto scaled = [&](const Vector& at, Vector& out, double c) {
    for (std::size_t i = 0; i < at.size(); ++i) states[i] = at[i] * scale_[i];
    rates(c, states, out);
    for (std::size_t i = 0; i < at.size(); ++i) out[i] *= duration / scale_[i];
  };
  double c = 0;
  // Not Fehlberg's pair of order 8: its error estimate is 0 where rates depend on time alone.
  const odeint::bulirsch_stoer<Vector> stepper(tolerance_, tolerance_);
  const bool there = integrate(stepper, scaled, 1, kLeastStep, x, c);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] *= scale_[i];
  return there ? 1 : c;
}

}  // namespace slalom::ocp
