// Saved answers, of one phase and of several.
#include "slalom/io/solution_file.hpp"

#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return slalom::test::fuzz(data, size, [](const std::string& input) {
    const auto file = slalom::test::fuzz_file(input);
    slalom::ocp::Solution answer;
    try {
      answer = slalom::io::read_solution(file);
    } catch (const slalom::Error&) {
      (void)slalom::io::read_phased_solution(file);
      return;
    }
    (void)slalom::io::to_json(answer);
    (void)slalom::io::to_csv(answer);
  });
}
