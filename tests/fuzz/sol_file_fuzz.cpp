// What solvers of .nl files answer.
#include "../../src/nlp/nl/sol_file.hpp"

#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return slalom::test::fuzz(data, size, [](const std::string& input) {
    (void)slalom::nlp::read_sol(input, 3, 2, "input");
  });
}
