#include <gtest/gtest.h>

#include "io/files.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/scenario_file.hpp"

namespace slalom::io {
namespace {

using test::TemporaryFolder;

/// The solve times a scenario has whose file names times.csv with this text.
std::vector<double> times_of(const std::string& text) {
  const TemporaryFolder folder;
  test::write(folder / "times.csv", text);
  test::write(folder / "s.yaml",
              "start: {x: 0, y: 0}\ngoal: {x: 0, y: 100}\n"
              "loop: {latency: recorded, solve_times: times.csv}\n");
  const auto scenario = load_scenario({(folder / "s.yaml").string(), {}, {}, {}});
  // What is resolved holds the numbers and needs the file no more.
  EXPECT_EQ(parse_scenario(to_yaml(scenario), "again").loop.solve_times, scenario.loop.solve_times);
  return scenario.loop.solve_times;
}

TEST(NumberFile, IsAColumnOrOneNumberALine) {
  const std::vector<double> expected = {0.1, 0.25, 3};
  EXPECT_EQ(times_of("0.1\n0.25\n3\n"), expected);
  EXPECT_EQ(times_of("\xEF\xBB\xBF"
                     "0.1\n\n0.25\n +3 \n\n"),
            expected);
  EXPECT_EQ(times_of("# solve_time_s\n0.1\n0.25\n3\n  \n"), expected);
  EXPECT_EQ(times_of("cycle,status,solve_time_s\n1,\"a, b\",0.1\n2,c,.25\n3,d,3\r\n"), expected);
}

TEST(NumberFile, SaysWhatIsWrongWhere) {
  for (const auto& [text, part] :
       {std::pair{"a,b\n1,2\n", "times.csv:1"}, std::pair{"1\nsoon\n", "times.csv:2"},
        std::pair{"1\n-2\n", "solve_times"}, std::pair{"", "no numbers"},
        std::pair{"x,solve_time_s\n1\n", "too few cells"}}) {
    try {
      (void)times_of(text);
      FAIL() << text;
    } catch (const InvalidValue& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace slalom::io
