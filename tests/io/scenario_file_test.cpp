#include "slalom/io/scenario_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "io/files.hpp"
#include "slalom/base/error.hpp"

namespace slalom::io {
namespace {

using test::TemporaryFolder;

sim::Scenario load(const std::string& name, std::vector<std::string> overrides = {},
                   std::optional<std::string> planner = {}) {
  return load_scenario({name, std::move(planner), std::nullopt, std::move(overrides)});
}

/// All values bit for bit, through the tables.
template <class S>
void expect_same(const OptionTable<S>& table, const S& a, const S& b) {
  for (const auto& entry : table.entries())
    EXPECT_EQ(entry.get(a), entry.get(b)) << entry.info.name;
}

void expect_same(const sim::Scenario& a, const sim::Scenario& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.title, b.title);
  EXPECT_EQ(a.start, b.start);
  expect_same(world::goal_options(), a.goal, b.goal);
  expect_same(world::region_options(), a.region, b.region);
  ASSERT_EQ(a.obstacles.size(), b.obstacles.size());
  for (std::size_t i = 0; i < a.obstacles.size(); ++i)
    expect_same(world::obstacle_options(), a.obstacles[i], b.obstacles[i]);
  expect_same(planner::setting_options(), a.planner, b.planner);
  expect_same(vehicle::parameter_options(), a.vehicle, b.vehicle);
  expect_same(sim::loop_options(), a.loop, b.loop);
  expect_same(sim::plant_options(), a.plant, b.plant);
  expect_same(sim::sensing_options(), a.sensing, b.sensing);
}

TEST(ScenarioFile, BuiltInEnvironmentsAreThePapers) {
  const auto figure = load("E_A-figure");
  ASSERT_EQ(figure.obstacles.size(), 3U);
  EXPECT_EQ(figure.obstacles[1].a, 10);
  EXPECT_EQ(figure.obstacles[0].y, 50);
  EXPECT_EQ(load("E_A").obstacles[1].b, 4);

  const auto b = load("E_B");
  EXPECT_EQ(b.planner.name, "P_D");
  EXPECT_EQ(b.planner.N, 10);
  EXPECT_EQ(b.planner.L_range, 50);
  EXPECT_EQ(b.planner.kappa, 5);
  EXPECT_EQ(b.obstacles[2].vx, -0.5);
  EXPECT_EQ(b.obstacles[2].vy, 6);
  EXPECT_EQ(b.goal.sigma, 15);
  EXPECT_EQ(b.region.x_max, HUGE_VAL);

  const auto c = load("E_C");
  ASSERT_EQ(c.obstacles.size(), 38U);
  EXPECT_EQ(c.obstacles[1].vy, -10);
  EXPECT_EQ(c.obstacles[2].name, "cone1");
  EXPECT_EQ(c.obstacles[37].name, "cone36");
  EXPECT_EQ(c.obstacles[37].y, 175);
  EXPECT_EQ(c.obstacles[37].a, 0.38735);
  EXPECT_EQ(c.planner.N, 15);
  EXPECT_EQ(c.planner.L_range, 90);
  EXPECT_EQ(c.planner.kappa, 10);
  EXPECT_EQ(c.region.x_min, 0);
  EXPECT_EQ(c.region.x_max, 24);
  EXPECT_EQ(c.region.y_min, -HUGE_VAL);
  EXPECT_EQ(c.goal.sigma, 25);
}

TEST(ScenarioFile, NinetyDegreesAreHalfPiToTheBit) {
  for (const char* name : {"E_A", "E_A-figure", "E_B", "E_C"}) {
    const auto scenario = load(name);
    EXPECT_EQ(scenario.start[vehicle::PSI], std::numbers::pi / 2) << name;
    EXPECT_EQ(scenario.goal.psi, std::numbers::pi / 2) << name;
  }
  EXPECT_EQ(load("E_B", {"start.psi_deg=45"}).start[vehicle::PSI], std::numbers::pi / 4);
}

TEST(ScenarioFile, TheHmmwvFileHasEveryParameterAndTheDefaultValues) {
  expect_same(vehicle::parameter_options(), load("E_B").vehicle, vehicle::Parameters{});
  const auto file = "\n" + test::read(SLALOM_SOURCE_DIR "/config/vehicles/hmmwv.yaml");
  for (const auto& entry : vehicle::parameter_options().entries())
    EXPECT_NE(file.find("\n" + entry.info.name + ":"), std::string::npos) << entry.info.name;
}

TEST(ScenarioFile, PlannersDifferInThreeSettings) {
  const auto a = load("E_A", {}, "P_A").planner, b = load("E_A", {}, "P_B").planner;
  const auto c = load("E_A", {}, "P_C").planner, d = load("E_A", {}, "P_D").planner;
  EXPECT_EQ((std::array{a.w_t, b.w_t, c.w_t, d.w_t}), (std::array{0., 100., 100., 100.}));
  EXPECT_EQ((std::array{a.w_ce, b.w_ce, c.w_ce, d.w_ce}), (std::array{0., 0., 1., 1.}));
  EXPECT_EQ(
      (std::array{a.moving_avoidance, b.moving_avoidance, c.moving_avoidance, d.moving_avoidance}),
      (std::array{false, false, false, true}));
}

TEST(ScenarioFile, AChosenPlannerKeepsTheScenariosOwnSettings) {
  const auto scenario = load("E_C", {}, "P_C");
  EXPECT_EQ(scenario.planner.name, "P_C");
  EXPECT_FALSE(scenario.planner.moving_avoidance);
  EXPECT_EQ(scenario.planner.N, 15);
  EXPECT_EQ(scenario.planner.L_range, 90);
}

TEST(ScenarioFile, AChosenPlannerActsOnAResolvedFileToo) {
  TemporaryFolder folder;
  test::write(folder / "resolved.yaml", to_yaml(load("E_C")));
  const auto scenario = load(folder / "resolved.yaml", {}, "P_C");
  EXPECT_EQ(scenario.planner.name, "P_C");
  EXPECT_FALSE(scenario.planner.moving_avoidance);
  EXPECT_EQ(scenario.planner.N, 15);
}

TEST(ScenarioFile, APlannerChosenForAResolvedFileKeepsNothingOfTheOneBefore) {
  TemporaryFolder folder;
  const auto road = folder / "road.yaml", resolved = folder / "resolved.yaml";
  test::write(road,
              "start: {x: 0, y: 0, psi: 0, ux: 9}\ngoal: {s: 90}\nplanner: {base: P_D, kappa: 7}\n"
              "loop: {sm_crash: 0}\nroad: {points: [[-20, 0, 4, 4], [20, 0, 4, 4], [60, 5, 4, 4], "
              "[95, 22, 4, 4]]}\n");
  for (const auto& before : built_in_planners())
    for (const auto& chosen : built_in_planners()) {
      SCOPED_TRACE(before.name + " to " + chosen.name);
      test::write(resolved, to_yaml(load(road, {}, before.name)));
      expect_same(planner::setting_options(), load(resolved, {}, chosen.name).planner,
                  load(road, {}, chosen.name).planner);
    }
}

TEST(ScenarioFile, TheCommandLineComesLast) {
  const auto scenario = load_scenario(
      {"E_C",
       "P_C",
       0.25,
       {"planner.w_t=50", "vehicle.m=3000", "start.x=6.1", "goal.sigma=20", "region.x_min=-1",
        "obstacles.O2.vy=-20", "obstacles.cone3.r=.5", "loop.timeout=5",
        "planner.X0_tol=[1,1,1,1,1,1,1,1]", "title=a: b", "planner.w_t=60"}});
  EXPECT_EQ(scenario.planner.w_t, 60);
  EXPECT_EQ(scenario.vehicle.m, 3000);
  EXPECT_EQ(scenario.start[vehicle::X], 6.1);
  EXPECT_EQ(scenario.goal.sigma, 20);
  EXPECT_EQ(scenario.region.x_min, -1);
  EXPECT_EQ(scenario.obstacles[1].vy, -20);
  EXPECT_EQ(scenario.obstacles[4].a, 0.5);
  EXPECT_EQ(scenario.obstacles[4].b, 0.5);
  EXPECT_EQ(scenario.loop.timeout, 5);
  EXPECT_EQ(scenario.loop.tex, 0.25);
  EXPECT_EQ(scenario.planner.X0_tol[5], 1);
  EXPECT_EQ(scenario.title, "a: b");
}

TEST(ScenarioFile, YamlReadsBackToTheSameBits) {
  TemporaryFolder folder;
  std::vector<sim::Scenario> scenarios;
  for (const auto& entry : built_in_scenarios()) scenarios.push_back(load(entry.name));
  auto odd = load(
      "E_C", {"planner.w_t=1e-300", "vehicle.m=2688.7000000000003", "start.v=-0.0",
              "region.y_max=1e22", "obstacles.O1.vx=0.1", "planner.scheme=hermite_simpson",
              "loop.on_failure=last_plan", "loop.warm_up=false", "planner.wheel_load_cost=shifted",
              "plant.mass_factor=1.1", "plant.actuator_delay=0.1", "sensing.noise_seed=3",
              "sensing.obstacle_velocity_factor=-0.3"});
  odd.title = "quote \" colon: # hash \\ tab \t ünï";
  odd.obstacles[0].name = "- {a: b}";
  scenarios.push_back(odd);
  for (const auto& scenario : scenarios) {
    test::write(folder / "again.yaml", to_yaml(scenario));
    const auto again = load(folder / "again.yaml");
    expect_same(scenario, again);
    EXPECT_EQ(to_yaml(scenario), to_yaml(again));
  }
  EXPECT_TRUE(std::signbit(odd.start[vehicle::V]));
}

TEST(ScenarioFile, EverySettingIsKnownByTheKeyThatSetsIt) {
  const auto changed = load("E_C", {"planner.w_t=7", "vehicle.m=3000", "loop.tex=0.25",
                                    "plant.mass_factor=1.5", "sensing.delay=0.5"});
  std::vector<std::string> overrides;
  for (const auto& [key, value] : values_of(changed)) {
    if (key.ends_with(".name") && key.starts_with("obstacles.")) continue;  // which none sets
    if (const auto* number = std::get_if<double>(&value); number && !std::isfinite(*number))
      continue;  // a side that is not there
    overrides.push_back(key + "=" + slalom::to_string(value));
  }
  const auto has = [&](const std::string& assignment) {
    return std::count(overrides.begin(), overrides.end(), assignment) == 1;
  };
  EXPECT_TRUE(has("planner.w_t=7"));
  EXPECT_TRUE(has("start.ux=17"));
  EXPECT_TRUE(has("obstacles.O2.vy=-10"));
  EXPECT_TRUE(has("region.x_max=24"));
  expect_same(load("E_C", overrides), changed);
}

TEST(ScenarioFile, AVehicleFileMayStandOverAnother) {
  const test::TemporaryFolder folder;
  test::write(folder / "car.yaml", "base: hmmwv\nm: 1350\nla: 1.1\nlb: 1.5\nKZX: 300\n");
  test::write(folder / "heavy.yaml", "base: car.yaml\nm: 1500\n");
  test::write(folder / "loop.yaml", "base: loop.yaml\n");
  const auto with = [&](const std::string& vehicle) {
    test::write(
        folder / "drive.yaml",
        "vehicle: " + vehicle + "\nplanner: P_D\nstart: {x: 0, y: 0}\ngoal: {x: 0, y: 100}\n");
    return load(folder / "drive.yaml");
  };
  const auto car = with("car.yaml").vehicle;
  EXPECT_EQ(car.name, "car");
  EXPECT_EQ(car.KZX, 300) << "stated";
  EXPECT_NEAR(car.FzF0, 1350 * 9.80665 * 1.5 / 2.6, 1e-9) << "follows";
  EXPECT_EQ(car.Izz, 4110.1) << "the HMMWV's";
  const auto heavy = with("heavy.yaml").vehicle;
  EXPECT_EQ(heavy.la, 1.1);
  EXPECT_NEAR(heavy.FzF0 + heavy.FzR0, 1500 * 9.80665, 1e-9);
  EXPECT_THROW(with("loop.yaml"), InvalidValue);

  std::vector<std::string> advice;
  (void)with("car.yaml");
  (void)load_scenario({(folder / "drive.yaml").string(), {}, {}, {}}, advice);
  ASSERT_GE(advice.size(), 2u);
  EXPECT_NE(advice[0].find("FzF0, FzR0"), std::string::npos) << advice[0];
  EXPECT_NE(advice[1].find("those of hmmwv: Izz, "), std::string::npos) << advice[1];
}

TEST(ScenarioFile, TextIsReadAsItsFileIs) {
  const auto text = to_yaml(load("E_B"));
  expect_same(parse_scenario(text, "text"), load("E_B"));
  const auto changed = parse_scenario(text, ScenarioRequest{"text", "P_A", 0.25, {"goal.x=7"}});
  EXPECT_EQ(changed.planner.name, "P_A");
  EXPECT_EQ(changed.loop.tex, 0.25);
  EXPECT_EQ(changed.goal.x, 7);
}

TEST(ScenarioFile, FilesNamedByAScenarioCountFromItsFolder) {
  TemporaryFolder folder;
  std::filesystem::create_directory(folder / "parts");
  test::write(folder / "parts/car.yaml", "m: {value: 1500, unit: kg}\n");
  test::write(folder / "parts/bold.yaml", "name: bold\nw_t: 200\n");
  test::write(folder / "mine.yaml",
              "vehicle: {base: parts/car.yaml, Izz: 2000}\nplanner: parts/bold.yaml\n"
              "start: {x: 0, y: 0}\ngoal: {x: 0, y: 100}\n");
  const auto scenario = load(folder / "mine.yaml");
  EXPECT_EQ(scenario.name, "mine");
  EXPECT_EQ(scenario.vehicle.name, "car");
  EXPECT_EQ(scenario.vehicle.m, 1500);
  EXPECT_EQ(scenario.vehicle.Izz, 2000);
  EXPECT_EQ(scenario.planner.name, "bold");
  EXPECT_EQ(scenario.planner.w_t, 200);
  EXPECT_TRUE(scenario.obstacles.empty());
}

TEST(ScenarioFile, BuiltInsHaveTitles) {
  for (const auto& list : {built_in_scenarios(), built_in_planners(), built_in_vehicles()}) {
    EXPECT_FALSE(list.empty());
    for (const auto& entry : list) EXPECT_FALSE(entry.title.empty()) << entry.name;
  }
}

TEST(ScenarioFile, TheExampleHasTenLinesAndLoads) {
  const auto file = SLALOM_SOURCE_DIR "/examples/crossing.yaml";
  const auto text = test::read(file);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_EQ(load(file).obstacles.size(), 2U);
}

TEST(ScenarioFile, TheReferenceIsUpToDate) {
  EXPECT_EQ(test::read(SLALOM_SOURCE_DIR "/docs/solver-options.md"), solver_options_page())
      << "run: slalom docs solver-options > docs/solver-options.md";
}

}  // namespace
}  // namespace slalom::io
