// Recorded solves, and recorded plans, which are verified again where that is quick.
#include "slalom/io/recording_file.hpp"

#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return slalom::test::fuzz(data, size, [](const std::string& input) {
    const auto recorded = slalom::io::read_recording(slalom::test::fuzz_file(input));
    const auto* motion = std::get_if<slalom::io::RecordedMotion>(&recorded);
    if (motion == nullptr || motion->plan.t.size() > 20 || motion->plan.obstacles.size() > 3)
      return;
    (void)slalom::planner::verify_again(motion->plan, motion->scenario);
  });
}
