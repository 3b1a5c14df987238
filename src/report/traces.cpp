#include "traces.hpp"

#include <algorithm>
#include <functional>

#include "words.hpp"

namespace slalom::report {
namespace {

Series plant_series(const std::string& label, const sim::Drive& drive, const Stroke& stroke,
                    const std::function<double(const sim::PlantSample&)>& value) {
  Series series;
  series.label = label;
  series.stroke = stroke;
  for (const auto& sample : drive.plant) {
    series.x.push_back(sample.t);
    series.y.push_back(value(sample));
  }
  return series;
}

}  // namespace

Series state_series(const std::string& label, const sim::Drive& drive, std::size_t state,
                    double factor, const Stroke& stroke) {
  return plant_series(label, drive, stroke,
                      [=](const sim::PlantSample& s) { return factor * s.state[state]; });
}

Series control_series(const std::string& label, const sim::Drive& drive, std::size_t control,
                      double factor, const Stroke& stroke) {
  return plant_series(label, drive, stroke,
                      [=](const sim::PlantSample& s) { return factor * s.control[control]; });
}

Series wheel_series(const std::string& label, const sim::Drive& drive, std::size_t wheel,
                    double factor, const Stroke& stroke) {
  return plant_series(label, drive, stroke,
                      [=](const sim::PlantSample& s) { return factor * s.wheel_loads[wheel]; });
}

Series least_wheel_series(const std::string& label, const sim::Drive& drive, double factor,
                          const Stroke& stroke) {
  return plant_series(label, drive, stroke, [=](const sim::PlantSample& s) {
    return factor * *std::min_element(s.wheel_loads.begin(), s.wheel_loads.end());
  });
}

Series limit_series(const std::string& label, const sim::Drive& drive,
                    const vehicle::Parameters& vehicle, bool upper, const Stroke& stroke) {
  return plant_series(label, drive, stroke, [&](const sim::PlantSample& s) {
    const double ux = s.state[vehicle::UX];
    return upper ? vehicle.ax_max_at(ux) : vehicle.ax_min_at(ux);
  });
}

Series solve_time_series(const std::string& label, const sim::Drive& drive, bool cpu,
                         const Stroke& stroke) {
  Series series;
  series.label = label;
  series.stroke = stroke;
  series.y = solve_times(drive, cpu);
  for (std::size_t i = 0; i < series.y.size(); ++i) {
    series.x.push_back(static_cast<double>(i + 1));
    series.y[i] *= 1e3;
  }
  return series;
}

}  // namespace slalom::report
