// The heads of HTTP requests.
#include "../../apps/slalom/http_request.hpp"

#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return slalom::test::fuzz(data, size, [](const std::string& input) {
    if (const auto request = slalom::app::parse_http_request(input)) (void)request->has_content();
  });
}
