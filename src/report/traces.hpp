#pragma once

#include <string>

#include "slalom/report/plot.hpp"
#include "slalom/sim/drive.hpp"
#include "slalom/vehicle/parameters.hpp"

namespace slalom::report {

/// A column of a drive's plant samples over time, times `factor`.
Series state_series(const std::string& label, const sim::Drive& drive, std::size_t state,
                    double factor, const Stroke& stroke);
Series control_series(const std::string& label, const sim::Drive& drive, std::size_t control,
                      double factor, const Stroke& stroke);
Series wheel_series(const std::string& label, const sim::Drive& drive, std::size_t wheel,
                    double factor, const Stroke& stroke);
/// The least of the four wheel loads, times `factor`.
Series least_wheel_series(const std::string& label, const sim::Drive& drive, double factor,
                          const Stroke& stroke);
/// Upper or lower limit of acceleration at the speeds driven.
Series limit_series(const std::string& label, const sim::Drive& drive,
                    const vehicle::Parameters& vehicle, bool upper, const Stroke& stroke);
/// Solve time [ms] over the number of the cycle, warm-up left out.
Series solve_time_series(const std::string& label, const sim::Drive& drive, bool cpu,
                         const Stroke& stroke);

}  // namespace slalom::report
