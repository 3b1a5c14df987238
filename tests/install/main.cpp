// What a user's program needs of an installed slalom: headers alone, one target to link.
#include <array>
#include <cstdio>
#include <string>

#include "slalom/base/options.hpp"
#include "slalom/expr/function.hpp"
#include "slalom/io/scenario_file.hpp"

namespace {

bool expect(bool holds, const char* what) {
  std::printf("%s: %s\n", holds ? "ok" : "FAILED", what);
  return holds;
}

}  // namespace

int main() {
  using slalom::expr::Expr;
  bool good = expect(slalom::nearest_name("plannr", {"planner", "vehicle"}) == "planner",
                     "nearest_name finds the near name");

  const Expr x = Expr::symbol("x");
  const slalom::expr::Function function({x}, {}, {x * x});
  std::array<double, 1> at{3}, value{};
  function(at, {}, value);
  good &= expect(value[0] == 9, "a function is evaluated");

  // All of the library behind one target: reading a scenario needs every module but the solver.
  const auto scenario = slalom::io::load_scenario({.name_or_file = "E_B"});
  good &= expect(slalom::io::to_yaml(scenario).find("planner") != std::string::npos,
                 "a built-in scenario is read");
  return good ? 0 : 1;
}
