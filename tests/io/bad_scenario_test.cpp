#include <gtest/gtest.h>

#include <cmath>

#include "io/files.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/timer.hpp"
#include "slalom/io/scenario_file.hpp"

namespace slalom::io {
namespace {

using test::TemporaryFolder;

const std::string kGood =
    "start: {x: 0, y: 0}\n"
    "goal: {x: 0, y: 100}\n";

/// The message with which loading fails; an empty text when it does not.
std::string message_of(const ScenarioRequest& request) {
  try {
    load_scenario(request);
  } catch (const InvalidValue& error) {
    return error.what();
  }
  return "";
}

/// The same for a file with this text, its folder taken away: "my.yaml:1:2: found ...".
std::string message_of_text(const std::string& text) {
  TemporaryFolder folder;
  test::write(folder / "my.yaml", text);
  auto message = message_of({folder / "my.yaml", {}, {}, {}});
  const auto prefix = folder.path().string() + "/";
  for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
    message.erase(at, prefix.size());
  return message;
}

std::string message_of_set(const std::string& assignment, const std::string& name = "E_C") {
  return message_of({name, {}, {}, {assignment}});
}

void expect_contains(const std::string& message, const std::vector<std::string>& parts) {
  for (const auto& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "no '" << part << "' in: " << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(BadScenario, FilesThatAreNoText) {
  expect_contains(message_of_text(""), {"my.yaml:1:1: found an empty file, expected a scenario"});
  expect_contains(message_of_text("# only a comment\n"), {"an empty file"});
  expect_contains(message_of_text(std::string("name: a\n\0\1", 10)),
                  {"my.yaml:2:1", "binary data (byte 0x00)"});
  expect_contains(message_of_text("\x7f"
                                  "ELF\x02\x01"),
                  {"my.yaml:1:5", "binary data"});
  expect_contains(message_of_text("title: \xff\xfe\n"), {"my.yaml:1:8", "byte 0xff"});
  expect_contains(message_of_text(kGood + std::string(13 << 20, '#')),
                  {"more than 12582912 bytes"});
}

TEST(BadScenario, PathsThatAreNoFile) {
  TemporaryFolder folder;
  expect_contains(message_of({folder / "none.yaml", {}, {}, {}}),
                  {"none.yaml: found no such file, expected a scenario"});
  expect_contains(message_of({folder.path().string(), {}, {}, {}}), {"found a folder"});
  expect_contains(message_of({"/dev/zero", {}, {}, {}}), {"not a regular file"});
  expect_contains(message_of({"E_D", {}, {}, {}}), {"scenario 'E_D'", "E_A, E_A-figure, E_B, E_C"});
  expect_contains(message_of({"", {}, {}, {}}), {"scenario ''"});
  expect_contains(message_of({"E_B", "P_X", {}, {}}), {"--planner", "planner 'P_X'", "P_A"});
}

TEST(BadScenario, HostileYamlEndsQuickly) {
  std::string bomb = "a: &a [x, x, x, x, x, x, x, x, x]\n";
  for (char c = 'b'; c <= 'j'; ++c) {
    const std::string before = "*" + std::string(1, static_cast<char>(c - 1));
    bomb += std::string(1, c) + ": &" + c + " [" + before;
    for (int i = 0; i < 8; ++i) bomb += ", " + before;
    bomb += "]\n";
  }
  const Timer timer;
  expect_contains(message_of_text(bomb), {"my.yaml:2:8", "a YAML alias"});
  expect_contains(message_of_text("a: " + std::string(500000, '[')), {"my.yaml:1:"});
  expect_contains(message_of_text("a: " + std::string(500000, '{')), {"my.yaml:1:"});
  expect_contains(message_of_text("a: " + std::string(1000, '[') + std::string(1000, ']')),
                  {"my.yaml:1:35", "nesting deeper than 32"});
  std::string steps;
  for (int i = 0; i < 500; ++i) steps += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  expect_contains(message_of_text(steps), {"my.yaml:", "nesting"});
  std::string dashes = "a: ";
  for (int i = 0; i < 100000; ++i) dashes += "- ";
  EXPECT_NE(message_of_text(dashes), "");
  std::string wide = "obstacles: [";
  for (int i = 0; i < 500000; ++i) wide += "1,";
  expect_contains(message_of_text(wide + "]\n"), {"more than 400000 values"});
  std::string keys;
  for (int i = 0; i < 60000; ++i) keys += "k" + std::to_string(i) + ": 1\n";
  expect_contains(message_of_text(keys), {"my.yaml:1:1", "unknown key 'k0'"});
  EXPECT_LT(timer.cpu(), 8) << "s of this thread, which takes about one";
}

TEST(BadScenario, CutFiles) {
  const auto whole = test::read(SLALOM_SOURCE_DIR "/config/scenarios/E_C.yaml");
  // Wherever it is cut, loading ends, and before the goal is there it ends with a message.
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const auto message = message_of_text(whole.substr(0, length));
    if (length < whole.find("goal:")) {
      EXPECT_NE(message, "") << length;
    }
  }
  expect_contains(message_of_text(whole.substr(0, whole.find("kappa"))),
                  {"my.yaml:", "YAML error"});
  expect_contains(message_of_text(whole.substr(0, whole.find("goal:"))),
                  {"a scenario without 'goal'", "expected the key 'goal'"});
}

TEST(BadScenario, KeysUnknownOrDoubled) {
  expect_contains(message_of_text(kGood + "planer: P_D\n"),
                  {"my.yaml:3:1: found unknown key 'planer'", "did you mean 'planner'?"});
  expect_contains(message_of_text(kGood + "planner:\n  base: P_D\n  wt: 3\n"),
                  {"my.yaml:5:3", "unknown key 'wt' of planner", "did you mean 'w_t'?"});
  expect_contains(message_of_text(kGood + "loop: {texx: 3}\n"), {"my.yaml:3:8", "'tex'"});
  expect_contains(message_of_text(kGood + "vehicle: {base: hmmwv, mass: 3}\n"),
                  {"my.yaml:3:24", "unknown key 'mass' of vehicle"});
  expect_contains(message_of_text(kGood + "obstacles: [{x: 50, y: 5, radius: 3}]\n"),
                  {"my.yaml:3:27", "unknown key 'radius'"});
  expect_contains(message_of_text("start: {x: 0, y: 0, x: 3}\ngoal: {x: 1, y: 3}\n"),
                  {"my.yaml:1:21", "key 'x' a second time", "first at line 1"});
  expect_contains(message_of_text(kGood + kGood), {"my.yaml:3:1", "key 'start' a second time"});
  expect_contains(message_of_text(kGood + "goal:\n"), {"a second time"});
  expect_contains(message_of_text(kGood + "---\n" + kGood),
                  {"my.yaml:3:1", "second YAML document"});
  expect_contains(message_of_text("start: {x: 0, y: 0, psi: 1, psi_deg: 9}\ngoal: {x: 1, y: 3}\n"),
                  {"my.yaml:1:29", "both psi_deg and psi"});
}

TEST(BadScenario, WrongTypesAndUnits) {
  const auto start = [](const std::string& text) {
    return message_of_text("start: {x: 0, y: 0, ux: " + text + "}\ngoal: {x: 0, y: 100}\n");
  };
  expect_contains(start("fast"), {"my.yaml:1:25", "'fast'", "expected a finite number"});
  expect_contains(start("'17'"), {"my.yaml:1:25", "'17'"});
  expect_contains(start("true"), {"a boolean true"});
  expect_contains(start("[1, 2]"), {"a list for ux"});
  expect_contains(start("17 m/s"), {"'17 m/s'"});
  expect_contains(start("{value: 17, unit: km/h}"),
                  {"my.yaml:1:43", "unit 'km/h' of ux", "expected 'm/s'"});
  expect_contains(start("{value: 17, units: m/s}"), {"unknown key 'units'", "'unit'"});
  expect_contains(start(""), {"nothing for ux"});
  expect_contains(message_of_text(kGood + "planner: {base: P_D, N: 10.5}\n"),
                  {"my.yaml:3:25", "10.5", "an integer for N"});
  expect_contains(message_of_text(kGood + "loop: {warm_up: yes}\n"), {"'yes'", "true or false"});
  expect_contains(message_of_text(kGood + "loop: {on_failure: lastplan}\n"),
                  {"my.yaml:3:20", "did you mean 'last_plan'?"});
  expect_contains(message_of_text(kGood + "planner: {X0_tol: [1, 2]}\n"),
                  {"2 numbers", "8 numbers"});
  expect_contains(message_of_text(kGood + "planner: {X0_tol: [1,1,1,x,1,1,1,1]}\n"),
                  {"my.yaml:3:26", "'x'", "a number"});
  expect_contains(message_of_text(kGood + "obstacles: {x: 1}\n"), {"a map", "a list of obstacles"});
  expect_contains(message_of_text(kGood + "obstacles: [5]\n"),
                  {"my.yaml:3:13", "an obstacle (a map"});
  expect_contains(message_of_text("- 1\n- 2\n"), {"my.yaml:1:1", "a list", "a scenario"});
  expect_contains(message_of_text("just words\n"), {"my.yaml:1:1", "'just words'"});
  expect_contains(message_of_text("start: 5\ngoal: {x: 1, y: 2}\n"),
                  {"my.yaml:1:8", "the map of start"});
  expect_contains(message_of_text(kGood + "planner: [P_D]\n"), {"a list", "the name of a planner"});
}

TEST(BadScenario, NumbersOutOfRange) {
  const auto obstacle = [](const std::string& text) {
    return message_of_text(kGood + "obstacles: [{x: 50, y: 50, r: " + text + "}]\n");
  };
  expect_contains(obstacle("-2"), {"my.yaml:3:31", "r = -2", "a number > 0"});
  expect_contains(obstacle("0"), {"r = 0"});
  for (const char* text : {".nan", "nan", ".inf", "-.inf", "inf", "1e400", "-1e400"})
    expect_contains(obstacle(text), {"my.yaml:3:31", "r = "});
  expect_contains(message_of_text("start: {x: .nan, y: 0}\ngoal: {x: 0, y: 100}\n"),
                  {"my.yaml:1:12", "nan", "a finite number"});
  expect_contains(message_of_text(kGood + "planner: {N: 0}\n"), {"my.yaml:3:14", "N = 0", ">= 1"});
  expect_contains(message_of_text(kGood + "planner: {N: -3}\n"), {"N = -3"});
  expect_contains(message_of_text(kGood + "planner: {N: 99999999999999}\n"), {"N = "});
  expect_contains(message_of_text(kGood + "loop: {tex: 0}\n"), {"my.yaml:3:13", "tex = 0"});
  expect_contains(message_of_text(kGood + "loop: {tex: -.5}\n"), {"tex = -0.5"});
  expect_contains(message_of_text(kGood + "obstacles: [{x: 9, y: 9, r: 1, repeat: 0}]\n"),
                  {"repeat = 0"});
}

TEST(BadScenario, Contradictions) {
  expect_contains(message_of_text(kGood + "loop:\n  tex: 11\n"),
                  {"my.yaml:4:8", "tex = 11", "at most tf_max = 10"});
  expect_contains(message_of_text(kGood + "planner:\n  base: P_D\n  L_range: 5\n  kappa: 5\n"),
                  {"my.yaml:5:12", "L_range = 5", "kappa = 5"});
  expect_contains(message_of_text("start: {x: 30, y: 0}\ngoal: {x: 0, y: 100}\n"
                                  "region: {x_min: 0, x_max: 24}\n"),
                  {"my.yaml:1:12", "start x = 30", "0 to 24"});
  expect_contains(message_of_text("start: {x: 0, y: 0, ux: 40}\ngoal: {x: 0, y: 100}\n"),
                  {"my.yaml:1:25", "start ux = 40"});
  expect_contains(message_of_text("start: {x: 0, y: 0, sa_deg: 40}\ngoal: {x: 0, y: 100}\n"),
                  {"my.yaml:1:29", "start sa"});
  expect_contains(message_of_text(kGood + "obstacles: [{x: 1, y: 1, r: 3}]\n"),
                  {"my.yaml:1:8", "inside obstacle O1"});
  expect_contains(message_of_text(kGood + "region: {x_min: 5, x_max: -5}\n"),
                  {"my.yaml:3:", "x_min"});
  expect_contains(
      message_of_text(kGood + "obstacles: [{name: a, x: 9, y: 50, r: 1}, {name: a, x: 9, "
                              "y: 60, r: 1}]\n"),
      {"my.yaml:3:43", "second obstacle named 'a'"});
  expect_contains(message_of_text(kGood + "obstacles: [{x: 9, y: 50}]\n"), {"without size"});
  expect_contains(message_of_text(kGood + "obstacles: [{x: 9, r: 5}]\n"),
                  {"1 of x, y", "all of them"});
  expect_contains(message_of_text(kGood + "obstacles: [{x: 9, y: 9, r: 5, a: 3}]\n"),
                  {"both r and a"});
  expect_contains(message_of_text("start: {x: 0}\ngoal: {x: 0, y: 100}\n"),
                  {"my.yaml:1:8", "without 'y'"});
}

TEST(BadScenario, ContradictionsBlameTheValueNearestToTheUser) {
  const auto set = [](const std::string& text, const std::vector<std::string>& assignments) {
    TemporaryFolder folder;
    test::write(folder / "my.yaml", text);
    return message_of({folder / "my.yaml", {}, {}, assignments});
  };
  // The command line before the file, the file before a file that it names.
  expect_contains(set(kGood + "loop: {tex: 9}\n", {"planner.tf_max=8"}),
                  {"--set planner.tf_max: found tex = 9, expected at most tf_max = 8"});
  expect_contains(set(kGood + "planner: {base: P_D, tf_max: 0.4}\n", {}),
                  {"my.yaml:3:30: found tex = 0.5"});
  expect_contains(set("start: {x: 30, y: 0}\ngoal: {x: 0, y: 100}\n", {"region.x_max=24"}),
                  {"--set region.x_max: found start x = 30"});
  expect_contains(set(kGood + "obstacles: [{x: 50, y: 0, r: 3}]\n", {"obstacles.O1.x=1"}),
                  {"--set obstacles.O1.x: found start (0, 0)", "inside obstacle O1"});
  expect_contains(set(kGood + "obstacles: [{x: 9, y: 0, r: 3}]\n", {"loop.sm_crash=8"}),
                  {"--set loop.sm_crash: found start (0, 0)"});
  expect_contains(set(kGood, {"vehicle.psi_max=1", "start.y=3"}),
                  {"--set vehicle.psi_max: found start psi = 1.5707"});
  expect_contains(set(kGood, {"loop.latency=recorded"}),
                  {"--set loop.latency: found no solve times"});
  expect_contains(set(kGood, {"loop.Fz_failure=6500"}),
                  {"--set loop.Fz_failure: found start Fz_r"});
  expect_contains(set(kGood + "vehicle: {base: hmmwv, m: 1.0e+308}\n", {"plant.mass_factor=10"}),
                  {"--set plant.mass_factor: found the plant's vehicle m = inf"});
  expect_contains(set("start: {x: 0, y: 0, ux: 29, ax: 1}\ngoal: {x: 0, y: 100}\n", {}),
                  {"my.yaml:1:33: found start ax = 1"});
  // A row that leaves the numbers there are, though its values are in range: the row's place.
  expect_contains(
      set(kGood + "obstacles:\n  - {x: 9, y: 9, r: 1, repeat: 3, step: [1.0e+308, 0]}\n", {}),
      {"my.yaml:4:5: found obstacle O13 x = inf, expected a finite number"});
}

TEST(BadScenario, AFileThatAScenarioNames) {
  TemporaryFolder folder;
  test::write(folder / "car.yaml", "m: {value: 1500, unit: lb}\n");
  test::write(folder / "my.yaml", kGood + "vehicle: car.yaml\n");
  expect_contains(message_of({folder / "my.yaml", {}, {}, {}}),
                  {"car.yaml:1:24", "unit 'lb' of m", "'kg'"});
  test::write(folder / "my.yaml", kGood + "vehicle: lorry.yaml\n");
  expect_contains(message_of({folder / "my.yaml", {}, {}, {}}),
                  {"my.yaml:3:10: found vehicle 'lorry.yaml', expected an existing file"});
  expect_contains(message_of_text(kGood + "vehicle: humvee\n"),
                  {"my.yaml:3:10", "vehicle 'humvee'", "hmmwv"});
  expect_contains(message_of_text(kGood + "planner: {base: P_Z}\n"),
                  {"my.yaml:3:17", "planner 'P_Z'"});
}

TEST(BadScenario, OverridesNameThemselves) {
  expect_contains(message_of_set("planner.wt=3"), {"--set planner.wt: ", "did you mean 'w_t'?"});
  expect_contains(message_of_set("planer.w_t=3"), {"--set planer.w_t", "did you mean 'planner'?"});
  expect_contains(message_of_set("loop.tex=0"), {"--set loop.tex: found tex = 0"});
  expect_contains(message_of_set("loop.tex=11"), {"--set loop.tex: found tex = 11", "tf_max"});
  expect_contains(message_of_set("planner.L_range=5"), {"--set planner.L_range", "kappa"});
  expect_contains(message_of_set("planner.kappa=95"), {"--set planner.kappa", "L_range = 90"});
  expect_contains(message_of_set("plant.mass_facter=1"), {"did you mean 'mass_factor'?"});
  expect_contains(message_of_set("plant.friction_factor=0"),
                  {"--set plant.friction_factor: found friction_factor = 0"});
  expect_contains(message_of_set("plant.cg_shift=2"), {"--set plant.cg_shift", "la = 1.5775"});
  expect_contains(message_of_set("sensing.delay=-1"), {"--set sensing.delay: found delay = -1"});
  expect_contains(message_of_set("sensings.delay=1"), {"did you mean 'sensing'?"});
  expect_contains(message_of_set("obstacles.O3.vy=1"),
                  {"--set obstacles.O3.vy", "'O3' of obstacles"});
  expect_contains(message_of_set("obstacles.O2.speed=1"),
                  {"--set obstacles.O2.speed", "unknown key 'speed'"});
  expect_contains(message_of_set("obstacles.O2=1"),
                  {"--set obstacles.O2", "obstacles.NAME.KEY=value"});
  expect_contains(message_of_set("obstacles.O2.r=-1"), {"--set obstacles.O2.r", "a number > 0"});
  expect_contains(message_of_set("start.x=30"), {"--set start.x", "start x = 30"});
  expect_contains(message_of_set("start.y=281"), {"--set start.y", "inside obstacle O1"});
  expect_contains(message_of_set("start.x="), {"--set start.x: found nothing for x"});
  expect_contains(message_of_set("start.x=a: b"), {"--set start.x"});
  expect_contains(message_of_set("start.x=[1"), {"--set start.x", "bracket"});
  expect_contains(message_of_set("planner=P_C"), {"--set planner", "planner.KEY=value"});
  expect_contains(message_of_set("tex=1"),
                  {"--set tex", "'tex' without its section, expected loop.tex"});
  expect_contains(message_of_set("x=1"), {"expected start.x or goal.x"});
  expect_contains(message_of_set("txe=1"), {"--set txe", "unknown key 'txe'"});
  expect_contains(message_of_set("w_t"), {"--set: found 'w_t', expected key.path=value"});
  expect_contains(message_of_set("=3"), {"--set: found '=3'"});
  expect_contains(message_of_set("title=\xff"), {"--set title", "binary"});
  expect_contains(message_of({"E_C", {}, std::nan(""), {}}), {"--tex: found tex = nan"});
}

}  // namespace
}  // namespace slalom::io
