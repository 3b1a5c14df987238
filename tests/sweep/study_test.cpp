#include "slalom/sweep/study.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "io/files.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/scenario_file.hpp"

namespace slalom::sweep {
namespace {

using test::TemporaryFolder;

Study study_of(const std::string& text) {
  const TemporaryFolder folder;
  test::write(folder / "study.yaml", text);
  return load_study((folder / "study.yaml").string());
}

std::vector<std::vector<std::string>> all(const AxisPoints& points) {
  std::vector<std::vector<std::string>> texts;
  for (std::size_t k = 0; k < points.size(); ++k) texts.push_back(points[k]);
  return texts;
}

TEST(AxisPoints, KeepNumbersAndWordsOfSeveralKeysAsTexts) {
  AxisPoints points;
  for (const double number : {0.1, 2.0, -1e300}) points.add(0, number);
  points.add(1, 1.5);
  points.add(1, "word");
  points.add(1, 1.5);
  EXPECT_EQ(all(points), (std::vector<std::vector<std::string>>{
                             {"0.1", "1.5"}, {"2", "word"}, {"-1e+300", "1.5"}}));
  EXPECT_EQ(points.numbers(0).size(), 3U);
  EXPECT_TRUE(points.numbers(1).empty());
}

TEST(Study, ThePapersGridHasTheValuesItsFiguresShow) {
  const auto study = load_study("paper");
  EXPECT_EQ(study.size(), 800);
  EXPECT_EQ(study.columns(), (std::vector<std::string>{"loop.tex", "obstacles.O2.vy"}));
  const auto tex = all(study.axes[0].points);
  const auto vy = all(study.axes[1].points);
  ASSERT_EQ(tex.size(), 20U);
  ASSERT_EQ(vy.size(), 20U);
  EXPECT_EQ(tex.front()[0], "0.01");
  EXPECT_EQ(tex.back()[0], "1");
  EXPECT_NEAR(std::stod(tex[13][0]), 0.687, 5e-4);
  EXPECT_NEAR(std::stod(tex[15][0]), 0.792, 5e-4);
  EXPECT_EQ(vy.front()[0], "0");  // not -0
  EXPECT_EQ(vy.back()[0], "-40");
  EXPECT_NEAR(std::stod(vy[8][0]), -16.8, 0.05);
  EXPECT_EQ(all(load_study("paper-printed").axes[1].points).back()[0], "-20");
}

TEST(Study, AMarginThatIsNotStatedFollowsTheFootprint) {
  const std::string scenario = "scenario: E_C\n";
  const std::string axis = "axes:\n  - {key: vehicle.footprint, values: [point, rectangle]}\n";
  const auto margins = [](const Study& study) {
    std::vector<double> found;
    for (std::int64_t n = 1; n <= study.size(); ++n) {
      const auto trial = study.trial(n);
      found.push_back(study.resolve(trial).loop.sm_crash);
      // As a store has the study.
      const auto base = io::parse_scenario(study.resolved_bases().at(trial.base), "a store");
      EXPECT_EQ(resolve_trial(base, {study.columns(), study.stated}, trial).loop.sm_crash,
                found.back());
    }
    return found;
  };
  using Margins = std::vector<double>;
  EXPECT_EQ(margins(study_of(scenario)), (Margins{2}));
  EXPECT_EQ(margins(study_of(scenario + "set: {vehicle.footprint: rectangle}\n")), (Margins{0}));
  EXPECT_EQ(margins(study_of(scenario + axis)), (Margins{2, 0}));
  EXPECT_EQ(margins(study_of(scenario + "set: {loop.sm_crash: 1}\n" + axis)), (Margins{1, 1}));
  EXPECT_EQ(margins(study_of(scenario + "set: {vehicle.footprint: rectangle, loop.sm_crash: 2}\n")),
            (Margins{2}));
}

TEST(Study, PlannersVarySlowestAndRepeatsFastest) {
  const auto study = study_of(
      "scenario: E_B\nplanners: [P_D, P_C]\nrepeats: 2\naxes:\n"
      "  - {key: loop.tex, values: [0.5, .25, 1]}\n"
      "  - {keys: [start.x, start.ux], values: [[199, 16], [200, 17]]}\n");
  EXPECT_EQ(study.size(), 2 * 3 * 2 * 2);
  std::set<std::vector<std::string>> seen;
  for (std::int64_t n = 1; n <= study.size(); ++n) {
    const auto trial = study.trial(n);
    EXPECT_EQ(trial.number, n);
    EXPECT_EQ(trial.base, n <= 12 ? 0U : 1U);
    EXPECT_EQ(trial.repeat, (n - 1) % 2 + 1);
    seen.insert(trial.values);
  }
  EXPECT_EQ(seen.size(), 6U);
  EXPECT_EQ(study.trial(1).values, (std::vector<std::string>{"0.5", "199", "16"}));
  EXPECT_EQ(study.trial(3).values, (std::vector<std::string>{"0.5", "200", "17"}));
  EXPECT_EQ(study.trial(5).values, (std::vector<std::string>{"0.25", "199", "16"}));
  const auto scenario = study.resolve(study.trial(24));
  EXPECT_EQ(scenario.planner.name, "P_C");
  EXPECT_EQ(scenario.loop.tex, 1);
  EXPECT_EQ(scenario.start[vehicle::X], 200);
  EXPECT_EQ(scenario.start[vehicle::UX], 17);
}

std::string scenario_text(const std::string& name) {
  return "name: " + name +
         "\nvehicle: hmmwv\nplanner: P_A\nstart: {x: 0, y: 0}\ngoal: {x: 0, y: 100}\n";
}

TEST(Study, ScenariosVarySlowestOfAll) {
  const TemporaryFolder folder;
  test::write(folder / "s.yaml",
              "scenarios: [E_B, 'scenes/*.yaml', E_A]\nplanners: [P_D, P_C]\naxes:\n"
              "  - {key: loop.tex, values: [0.5, 0.25]}\n");
  std::filesystem::create_directory(folder / "scenes");
  for (const char* name : {"b10", "b9", "a", "B"})
    test::write(folder / (std::string("scenes/") + name + ".yaml"), scenario_text(name));
  test::write(folder / "scenes/note.txt", "no scenario");
  const auto study = load_study((folder / "s.yaml").string());
  // By the bytes of their names, whatever the locale has.
  EXPECT_EQ(study.scenarios, (std::vector<std::string>{"E_B", "B", "a", "b10", "b9", "E_A"}));
  EXPECT_EQ(study.planners(), (std::vector<std::string>{"P_D", "P_C"}));
  ASSERT_EQ(study.size(), 6 * 2 * 2);
  for (std::int64_t n = 1; n <= study.size(); ++n) {
    const auto trial = study.trial(n);
    const auto k = static_cast<std::size_t>(n - 1);
    EXPECT_EQ(study.bases[trial.base].name, study.scenarios[k / 4]);
    EXPECT_EQ(study.bases[trial.base].planner.name, k / 2 % 2 == 0 ? "P_D" : "P_C");
    EXPECT_EQ(study.resolve(trial).loop.tex, k % 2 == 0 ? 0.5 : 0.25);
  }
}

TEST(Study, ScenariosMayBringTheirOwnPlanners) {
  const auto study = study_of("scenarios: [E_B, E_A]\nset: {loop.tex: 0.25}\n");
  EXPECT_EQ(study.size(), 2);
  EXPECT_EQ(study.planners(), (std::vector<std::string>{"P_D", "P_C"}));
  EXPECT_EQ(study.bases[1].loop.tex, 0.25);
}

TEST(Study, APatternIsOneOfFilesNotOfTheFolderItStandsIn) {
  const TemporaryFolder folder;
  const auto odd = folder / "[ab]*";
  std::filesystem::create_directory(odd);
  test::write(odd / "s.yaml", "scenarios: ['x?.yaml', 'y[1].yaml']\n");
  test::write(odd / "x1.yaml", scenario_text("x1"));
  test::write(odd / "y[1].yaml", scenario_text("literal"));
  test::write(odd / "y1.yaml", scenario_text("y1"));
  EXPECT_EQ(load_study((odd / "s.yaml").string()).scenarios,
            (std::vector<std::string>{"x1", "literal"}));
}

TEST(Study, OneScenarioIsTheSameStudyHoweverItIsNamed) {
  const std::string rest = "planners: [P_C]\naxes:\n  - {key: loop.tex, values: [0.5]}\n";
  EXPECT_EQ(study_of("scenario: E_B\n" + rest).identity(),
            study_of("scenarios: [E_B]\n" + rest).identity());
  EXPECT_NE(study_of("scenarios: [E_B, E_A]\n" + rest).identity(),
            study_of("scenarios: [E_A, E_B]\n" + rest).identity());
}

TEST(Study, AnAxisMayHoldChoicesListsAndDegrees) {
  const auto study = study_of(
      "scenario: E_B\naxes:\n  - {key: planner.scheme, values: [trapezoidal, hermite_simpson]}\n"
      "  - {key: planner.X0_tol, values: [[.5, .5, .5, .005, .5, .25, .5, .5]]}\n"
      "  - {key: start.psi_deg, values: [90]}\n");
  const auto scenario = study.resolve(study.trial(2));
  EXPECT_EQ(scenario.planner.scheme, planner::SchemeChoice::hermite_simpson);
  EXPECT_EQ(scenario.planner.X0_tol[5], 0.25);
}

TEST(Study, WhatThePlantIsAndWhatIsSensedAreAxes) {
  const auto study = study_of(
      "scenario: E_B\naxes:\n  - {key: plant.mass_factor, values: [1.1, 1.2]}\n"
      "  - draw: {count: 2, of: [{key: sensing.delay, uniform: [0.1, 0.2]}]}\n");
  const auto scenario = study.resolve(study.trial(3));
  EXPECT_EQ(scenario.plant.mass_factor, 1.2);
  EXPECT_GT(scenario.sensing.delay, 0.1);
}

TEST(Study, NumbersOfAnAxisAreReadAsThoseOfASetting) {
  const auto study =
      study_of("scenario: E_B\naxes:\n  - {key: start.v, values: [+.5, 1e-400, 5e-1]}\n");
  EXPECT_EQ(all(study.axes[0].points),
            (std::vector<std::vector<std::string>>{{"0.5"}, {"0"}, {"0.5"}}));
}

TEST(Study, DrawsFollowTheSeedAndTheirDistributions) {
  const auto text = [](int seed, int count) {
    return "scenario: E_B\nseed: " + std::to_string(seed) +
           "\naxes:\n  - draw: {count: " + std::to_string(count) +
           ", of: [{key: start.ux, uniform: [10, 20]}, {key: start.x, normal: [200, 0.5]}]}\n";
  };
  const auto study = study_of(text(1, 2000));
  const auto points = all(study.axes[0].points);
  ASSERT_EQ(points.size(), 2000U);
  double mean_ux = 0, mean_x = 0, square_x = 0;
  for (const auto& point : points) {
    const double ux = std::stod(point[0]), x = std::stod(point[1]) - 200;
    EXPECT_GT(ux, 10);
    EXPECT_LT(ux, 20);
    mean_ux += ux / 2000;
    mean_x += x / 2000;
    square_x += x * x / 2000;
  }
  // Five standard errors.
  EXPECT_NEAR(mean_ux, 15, 5 * 10 / std::sqrt(12.0 * 2000));
  EXPECT_NEAR(mean_x, 0, 5 * 0.5 / std::sqrt(2000.0));
  EXPECT_NEAR(square_x, 0.25, 5 * 0.25 * std::sqrt(2.0 / 2000));
  EXPECT_EQ(all(study_of(text(1, 2000)).axes[0].points), points);
  EXPECT_NE(all(study_of(text(2, 2000)).axes[0].points), points);
  // More points leave the first ones as they were.
  const auto fewer = all(study_of(text(1, 3)).axes[0].points);
  EXPECT_TRUE(std::equal(fewer.begin(), fewer.end(), points.begin()));
}

TEST(Study, TheIdentityChangesWithTheTrialsAndOnlyWithThem) {
  const std::string base =
      "scenario: E_B\nplanners: [P_C]\naxes:\n  - {key: loop.tex, values: [0.5, 0.25]}\n";
  const auto identity = study_of(base).identity();
  EXPECT_EQ(study_of(base + "title: another title\ntime_limit: 5\n").identity(), identity);
  EXPECT_EQ(study_of("scenario: E_B\nplanners: [P_C]\naxes:\n"
                     "  - {key: loop.tex, values: [.50, 0.25]}\n")
                .identity(),
            identity);
  for (const std::string& more :
       {std::string("repeats: 2\n"), std::string("keep: drives\n"),
        std::string("kernels: baseline\n"), std::string("set: {planner.floor: 0.8}\n")})
    EXPECT_NE(study_of(base + more).identity(), identity) << more;
  EXPECT_NE(study_of("scenario: E_B\nplanners: [P_C]\naxes:\n"
                     "  - {key: loop.tex, values: [0.25, 0.5]}\n")
                .identity(),
            identity);
}

TEST(Study, AFileOfNumbersOnAnAxisIsReadWhereTheStudyStands) {
  const TemporaryFolder folder;
  test::write(folder / "a.csv", "solve_time_s\n0.1\n0.25\n");
  test::write(folder / "b.txt", "0.5\n");
  test::write(folder / "study.yaml",
              "scenario: E_B\naxes:\n  - {key: loop.solve_times, values: [a.csv, [0.3], b.txt]}\n"
              "  - {keys: [loop.latency, loop.tex], values: [[recorded, 0.5]]}\n");
  const auto load = [&] { return load_study((folder / "study.yaml").string()); };
  const auto study = load();
  EXPECT_EQ(study.trial(1).values, (std::vector<std::string>{"[0.1, 0.25]", "recorded", "0.5"}));
  EXPECT_EQ(study.resolve(study.trial(1)).loop.solve_times, (std::vector<double>{0.1, 0.25}));
  EXPECT_EQ(study.resolve(study.trial(2)).loop.solve_times, std::vector<double>{0.3});
  EXPECT_EQ(study.resolve(study.trial(3)).loop.solve_times, std::vector<double>{0.5});
  EXPECT_EQ(load().identity(), study.identity());
  test::write(folder / "b.txt", "0.6\n");
  EXPECT_NE(load().identity(), study.identity());
  test::write(folder / "b.txt", "soon\n");
  EXPECT_THROW((void)load(), InvalidValue);
}

TEST(Study, AFileOfNumbersMayBeDrawnOrStandAmongSeveralKeys) {
  const TemporaryFolder folder;
  test::write(folder / "a.csv", "0.1\n");
  test::write(folder / "study.yaml",
              "scenario: E_B\nset: {loop.latency: recorded}\naxes:\n"
              "  - draw: {count: 3, of: [{key: loop.solve_times, choice: [a.csv]}]}\n"
              "  - {keys: [loop.tex, plant.mass_factor], values: [[0.5, 1.1]]}\n");
  const auto study = load_study((folder / "study.yaml").string());
  EXPECT_EQ(study.trial(3).values, (std::vector<std::string>{"[0.1]", "0.5", "1.1"}));
}

TEST(Study, WhatIsStatedOfTheVehicleHoldsInEveryTrial) {
  const std::string head = "scenario: E_B\nset: {vehicle.FzF0: 9000, vehicle.h: 0.6}\n";
  const auto study = study_of(head + "axes:\n  - {key: vehicle.m, values: [2000, 2500]}\n");
  for (const std::int64_t n : {1, 2}) {
    const auto vehicle = study.resolve(study.trial(n)).vehicle;
    EXPECT_EQ(vehicle.FzF0, 9000);
    EXPECT_NEAR(vehicle.FzR0, vehicle.m * 9.80665 * vehicle.la / (vehicle.la + vehicle.lb), 1e-9);
  }
  const TemporaryFolder folder;
  test::write(folder / "study.yaml", head);
  const auto file = (folder / "study.yaml").string();
  const auto set = load_study(file, {"vehicle.m=2000", "vehicle.FzR0=9500"});
  EXPECT_EQ(set.bases[0].vehicle.FzF0, 9000);
  EXPECT_EQ(set.bases[0].vehicle.FzR0, 9500);
  // What is stated tells studies apart, even where it says what stands there anyway.
  const auto plain = load_study("paper");
  const auto same =
      load_study("paper", {"vehicle.ux_max=" + std::to_string(plain.bases[0].vehicle.ux_max)});
  EXPECT_EQ(same.resolved_bases(), plain.resolved_bases());
  EXPECT_NE(same.identity(), plain.identity());
}

TEST(Study, ATrialWhoseValuesContradictEachOtherIsNamed) {
  const auto study = study_of(
      "scenario: E_B\naxes:\n  - {key: loop.tex, values: [0.5, 9]}\n"
      "  - {key: planner.tf_max, values: [10, 8]}\n");
  EXPECT_NO_THROW((void)study.resolve(study.trial(3)));
  try {
    (void)study.resolve(study.trial(4));
    FAIL() << "no error";
  } catch (const InvalidValue& error) {
    EXPECT_STREQ(error.what(), "trial 4: loop.tex: found tex = 9, expected at most tf_max = 8");
  }
}

TEST(Study, GoalsOfTheRoadLieWhereTheirTrialsHaveThem) {
  const auto at = [](const std::string& s) {
    return io::load_scenario({"door", {}, {}, {"goal.s=" + s}, {}}).goal.x;
  };
  const auto axis = study_of("scenario: door\naxes:\n  - {key: goal.s, values: [60, 110]}\n");
  EXPECT_EQ(axis.resolve(axis.trial(1)).goal.x, at("60"));
  EXPECT_EQ(axis.resolve(axis.trial(2)).goal.x, at("110"));
  EXPECT_NE(at("60"), at("110"));
  EXPECT_EQ(study_of("scenario: door\nset: {goal.s: 60}\n").bases[0].goal.x, at("60"));
}

TEST(Study, WhatIsSetTwiceOrToNoEffectIsRefused) {
  const auto refusal = [](const std::string& text, const std::vector<std::string>& set = {}) {
    const TemporaryFolder folder;
    test::write(folder / "s.yaml", text);
    try {
      (void)load_study((folder / "s.yaml").string(), set);
    } catch (const InvalidValue& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  const auto expect = [](const std::string& found, const std::string& part) {
    EXPECT_NE(found.find(part), std::string::npos) << found;
  };
  const std::string head = "scenario: E_B\n";
  const std::string psi = "axes:\n  - {key: start.psi, values: [1.5, 1.6]}\n";
  expect(refusal(head + psi + "  - {key: start.psi_deg, values: [90]}\n"),
         "both start.psi and start.psi_deg");
  expect(refusal(head + "axes:\n  - {keys: [obstacles.O1.r, obstacles.O1.a], values: [[2, 3]]}\n"),
         "both obstacles.O1.r and obstacles.O1.a");
  expect(refusal(head + "axes:\n  - draw: {count: 2, of: [{key: obstacles.O1.r, uniform: [1, 2]}, "
                        "{key: obstacles.O1.b, uniform: [1, 2]}]}\n"),
         "both obstacles.O1.r and obstacles.O1.b");
  expect(refusal(head + "set: {start.psi_deg: 90}\n" + psi), "s.yaml:2:7");
  expect(refusal(head + psi, {"start.psi_deg=90"}), "--set start.psi_deg");
  expect(refusal(head + "set: {start.psi: 1.5, start.psi_deg: 90}\n"),
         "both start.psi and start.psi_deg");
  EXPECT_EQ(refusal(head + "set: {obstacles.O2.r: 3}\naxes:\n"
                           "  - {keys: [obstacles.O1.a, obstacles.O1.b], values: [[2, 3]]}\n"),
            "taken");
  const std::string door = "scenario: door\n";
  expect(refusal(door + "set: {goal.sigma: 3}\n"), "sigma of the goal beside s");
  expect(refusal(door, {"goal.x=3"}), "--set goal.x");
  expect(refusal(door + "axes:\n  - {key: goal.psi, values: [0, 1]}\n"),
         "psi of the goal beside s");
  expect(refusal("scenarios: [E_B, door]\naxes:\n  - {key: goal.sigma, values: [9, 15]}\n"),
         "for scenario 'door'");
}

TEST(TrialIdentity, TellsConfigurationKernelsAndRepeatsApart) {
  const auto identity = trial_identity("a: 1\n", "avx2", 1);
  EXPECT_EQ(identity.size(), 32U);
  EXPECT_EQ(trial_identity("a: 1\n", "avx2", 1), identity);
  EXPECT_NE(trial_identity("a: 2\n", "avx2", 1), identity);
  EXPECT_NE(trial_identity("a: 1\n", "baseline", 1), identity);
  EXPECT_NE(trial_identity("a: 1\n", "avx2", 2), identity);
}

}  // namespace
}  // namespace slalom::sweep
