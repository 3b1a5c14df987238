// What --set takes.
#include "../../src/io/overrides.hpp"
#include "slalom/io/scenario_file.hpp"

#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return slalom::test::fuzz(data, size, [](const std::string& input) {
    static const auto base = slalom::io::load_scenario({"E_C", {}, {}, {}});
    auto scenario = base;
    slalom::io::Places places;
    slalom::io::apply_override(input, scenario, places);
    (void)slalom::io::to_yaml(scenario);
  });
}
