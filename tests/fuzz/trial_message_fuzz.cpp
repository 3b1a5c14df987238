// The lines between a sweep and its workers.
#include "../../src/sweep/trial_message.hpp"

#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return slalom::test::fuzz(data, size, [](const std::string& input) {
    try {
      (void)slalom::sweep::to_line(slalom::sweep::parse_answer(input));
    } catch (const slalom::Error&) {
    }
    (void)slalom::sweep::to_line(slalom::sweep::parse_order(input));
  });
}
