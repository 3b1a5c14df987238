#pragma once

#include <functional>
#include <vector>

namespace slalom::ocp {

/// Integrates states over a stretch of time by Bulirsch and Stoer's extrapolation of the modified
/// midpoint rule, with adaptive order and steps (Hairer, Norsett & Wanner 1993, section II.9), in
/// units of their scales, to a tolerance that is absolute there and relative.
class Integrator {
 public:
  /// Sets the rates of states x [per time unit] at local time c, 0 ... 1.
  using Rates =
      std::function<void(double c, const std::vector<double>& x, std::vector<double>& rates)>;

  Integrator(std::vector<double> scale, double tolerance)
      : scale_(std::move(scale)), tolerance_(tolerance) {}

  /// Takes x to the end of a stretch of this duration. Where there is no getting there, the share
  /// of it at which x got stuck, where x then is; else 1.
  double across(double duration, const Rates& rates, std::vector<double>& x) const;

 private:
  std::vector<double> scale_;
  double tolerance_;
};

}  // namespace slalom::ocp
