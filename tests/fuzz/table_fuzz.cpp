// Tables of numbers: guesses, and lists that options name.
#include "../../src/io/number_file.hpp"
#include "slalom/io/solution_file.hpp"
#include "slalom/ocp/problem.hpp"

#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return slalom::test::fuzz(data, size, [](const std::string& input) {
    static const auto problem = [] {
      slalom::ocp::Problem made("table");
      (void)made.state("x");
      (void)made.control("u");
      return made;
    }();
    const auto file = slalom::test::fuzz_file(input);
    slalom::OptionInfo info;
    info.name = "solve_times";
    slalom::io::Value name;
    name.kind = slalom::io::Value::Kind::scalar;
    name.text = file;
    try {
      (void)slalom::io::read_numbers(info, name);
    } catch (const slalom::Error&) {
    }
    (void)slalom::io::read_trajectory(file, problem);
  });
}
