// Study files.
#include "slalom/sweep/study.hpp"

#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return slalom::test::fuzz(data, size, [](const std::string& input) {
    const auto study = slalom::sweep::load_study(slalom::test::fuzz_file(input, "study.yaml"));
    (void)study.identity();
    for (const std::int64_t number : {std::int64_t{1}, study.size()})
      (void)study.resolve(study.trial(number));
  });
}
