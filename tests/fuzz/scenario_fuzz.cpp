// Scenario files.
#include "slalom/io/scenario_file.hpp"

#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return slalom::test::fuzz(data, size, [](const std::string& input) {
    (void)slalom::io::to_yaml(slalom::io::parse_scenario(input, "input"));
  });
}
