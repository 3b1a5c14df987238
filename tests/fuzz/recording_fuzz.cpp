// Recorded solves.
#include "slalom/io/recording_file.hpp"

#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return slalom::test::fuzz(data, size, [](const std::string& input) {
    (void)slalom::io::read_recording(slalom::test::fuzz_file(input));
  });
}
