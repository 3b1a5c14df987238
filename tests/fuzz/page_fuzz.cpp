// Pages of drives, as they are compared: an input as a page, and as the data that a page carries.
#include "slalom/report/report.hpp"

#include "fuzz.hpp"

namespace {

/// The page that is good: of a drive of two samples.
const char* const kGood =
    R"(<script type="application/json" id="drive-data">{"format":"slalom drive 3","scenario":"E_A",)"
    R"("planner":{"name":"P_A"},"plant":{"t":[0,1]}}</script>)";

void compare(const std::string& page) {
  try {
    (void)slalom::report::comparison_page({"good", kGood}, {"input", page});
  } catch (const slalom::Error&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return slalom::test::fuzz(data, size, [](const std::string& input) {
    compare(input);
    compare(R"(<script type="application/json" id="drive-data">)" + input + "</script>");
  });
}
