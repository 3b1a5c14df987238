// CSV files of roads, open and closed.
#include <cmath>

#include "slalom/io/scenario_file.hpp"
#include "slalom/world/road.hpp"

#include "fuzz.hpp"

namespace {

void read(const std::string& file, const std::string& closed) {
  const std::string text =
      "planner: P_E\nstart: {x: 0, y: 0, psi: 0, ux: 5}\ngoal: {time: 9}\nroad: {file: " + file +
      ", closed: " + closed + "}\n";
  try {
    const auto scenario = slalom::io::parse_scenario(text, "input");
    const auto& road = *scenario.road;
    for (const double share : {-1., 0., 0.3, 0.99, 1., 7.}) {
      const auto place = road.at(share * road.length());
      if (!std::isfinite(place.x) || !std::isfinite(place.y)) abort();
      if (!std::isfinite(road.project({place.x + 1, place.y - 1}).s)) abort();
    }
    (void)slalom::io::to_yaml(scenario);
  } catch (const slalom::Error&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return slalom::test::fuzz(data, size, [](const std::string& input) {
    const auto file = slalom::test::fuzz_file(input);
    read(file, "false");
    read(file, "true");
  });
}
