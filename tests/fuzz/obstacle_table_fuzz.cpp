// CSV files of obstacles: a table of a motion, a path, and the corners of a polygon.
#include <cmath>
#include <cstdlib>

#include "slalom/io/scenario_file.hpp"

#include "fuzz.hpp"

namespace {

using slalom::world::Obstacle;

/// Looks where it is, and reads back what is written of it.
void use(const Obstacle& obstacle) {
  for (const double t : {-1e9, -1., 0., 0.5, 1., 3.7, 1e3, 1e9}) {
    if (obstacle.trajectory && !obstacle.trajectory->present(t, t)) continue;
    const auto pose = obstacle.pose_at(t);
    if (std::isnan(pose.x) || std::isnan(pose.y) || std::isnan(pose.psi)) abort();
    (void)obstacle.corners_at(t);
  }
  static const auto base = slalom::io::load_scenario({"E_A", {}, {}, {}});
  auto scenario = base;
  scenario.obstacles = {obstacle};
  const auto text = slalom::io::to_yaml(scenario);
  if (slalom::io::to_yaml(slalom::io::parse_scenario(text, "again")) != text) abort();
}

void read(const std::string& keys) {
  try {
    use(slalom::io::parse_obstacle("{" + keys + "}", "input"));
  } catch (const slalom::Error&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return slalom::test::fuzz(data, size, [](const std::string& input) {
    const auto file = slalom::test::fuzz_file(input);
    read("r: 1, before: absent, after: goes_on, table: " + file);
    read("length: 4, width: 2, speed: 3, acceleration: -0.5, path: " + file);
    read("x: 5, y: 20, vx: 1, polygon: " + file);
  });
}
