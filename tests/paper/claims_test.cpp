// The rules of config/paper/claims.yaml on figures made up for them, for a claim and against it.
#include "../../src/paper/claims.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "../../src/paper/paper_data.hpp"
#include "../../src/paper/paper_index.hpp"
#include "../../src/paper/published_sweep.hpp"
#include "slalom/base/error.hpp"

namespace slalom::paper {
namespace {

using sim::Outcome;

/// A drive along x = 200 at 20 m/s, which gains `gain`; every solve takes `cpu`.
sim::Drive made(Outcome outcome = Outcome::goal, double time = 6, double cpu = 0.001) {
  sim::Drive drive;
  drive.outcome = outcome;
  drive.time = time;
  if (outcome == Outcome::goal) drive.goal_time = time;
  for (int k = 0; k <= 2 * time; ++k) {
    sim::PlantSample sample;
    sample.t = 0.5 * k;
    sample.state[vehicle::X] = 199;
    sample.state[vehicle::Y] = 10 * k;
    sample.state[vehicle::UX] = 20 + 0.1 * k;
    sample.control[vehicle::JX] = 0.1;
    drive.plant.push_back(sample);
  }
  for (int k = 0; k < 12; ++k) {
    sim::Cycle cycle;
    cycle.index = k + 1;
    cycle.t0 = 0.5 * k;
    cycle.plan.report.iterations = 5;
    cycle.plan.report.cpu_s = cpu;
    cycle.plan.report.wall_s = cpu;
    drive.cycles.push_back(cycle);
  }
  return drive;
}

sim::Drive crash(const std::string& into, double time = 3) {
  auto drive = made(Outcome::crash, time);
  drive.hit = into;
  return drive;
}

using Passes = std::function<bool(const std::string&, double, double)>;

std::vector<SweepTrial> sweep(const Passes& passes, double longest = 0.001) {
  std::vector<SweepTrial> trials;
  for (const std::string planner : {"P_C", "P_D"})
    for (const double tex : {0.1, 0.3, 0.687, 0.9})
      for (const double speed : {0., 2.1, 10., 20., 30.}) {
        const bool passed = passes(planner, tex, speed);
        const double time = passed ? longest : 3 * longest;
        trials.push_back({planner, passed ? "goal" : "crash", passed ? "" : "O2", tex, speed, time,
                          time, 0.001});
      }
  return trials;
}

bool like(const std::string& planner, double tex, double speed) {
  return planner == "P_D" ? speed < 21 && (tex < 0.5 || speed < 5) : speed < 3 && tex < 0.375;
}
bool unlike(const std::string& planner, double tex, double speed) {
  return planner == "P_D" ? speed > 21 && tex > 0.5 : speed > 3;
}

/// All that the claims may ask for.
class ClaimRules : public ::testing::Test {
 protected:
  ClaimRules() {
    for (auto& one : load_drives(paper_, {})) add(std::move(one));
    for (auto& one : load_besides({})) add(std::move(one));
    for (auto& one : load_concept_cases({})) add(std::move(one.driven));
  }
  void add(ReproducedDrive one) {
    one.drive = made();
    const auto name = one.folder;
    drives_[name] = std::move(one);
  }
  Evidence evidence() const {
    Evidence result{{}, &paper_, &published_, trials_.empty() ? nullptr : &trials_};
    for (const auto& [name, one] : drives_) result.drives[name] = &one;
    return result;
  }
  static Judged find(const std::vector<Judged>& list, const std::string& id) {
    for (const auto& one : list)
      if (one.id == id) return one;
    ADD_FAILURE() << id << " is not judged";
    return {};
  }
  Judged of_drives(const std::string& id) const {
    return find(judge(claims_.drives, evidence()), id);
  }
  std::string drives(const std::string& id) const { return verdict_words(of_drives(id).verdict); }
  Judged of_sweep(const std::string& id) const {
    return find(judge(claims_.sweep, evidence()), id);
  }
  std::string by_sweep(const std::string& id) const { return verdict_words(of_sweep(id).verdict); }

  PaperData paper_ = load_paper_data();
  report::PublishedSweep published_ = published_sweep();
  Claims claims_ = load_claims();
  std::map<std::string, ReproducedDrive> drives_;
  std::vector<SweepTrial> trials_ = sweep(like);
};

TEST_F(ClaimRules, EveryClaimFindsWhatItAsksFor) {
  EXPECT_EQ(judge(claims_.drives, evidence()).size(), claims_.drives.size());
  EXPECT_EQ(judge(claims_.sweep, evidence()).size(), claims_.sweep.size());
  EXPECT_EQ(claims_.drives.size() + claims_.sweep.size(), 35u);
  for (const auto& one : judge(claims_.drives, evidence()))
    EXPECT_EQ(one.ours.find_first_of("{}"), one.ours.npos) << one.ours;
}

TEST_F(ClaimRules, WhatWasNotDrivenIsNotJudged) {
  trials_.clear();
  EXPECT_TRUE(judge(claims_.sweep, evidence()).empty());
  const auto whole = judge(claims_.drives, evidence()).size();
  EXPECT_EQ(whole, claims_.drives.size() - 1) << "case E's claim looks at the sweep too";
  drives_.erase("E_A/P_A");
  std::vector<LeftOut> left_out;
  EXPECT_LT(judge(claims_.drives, evidence(), &left_out).size(), whole);
  ASSERT_GT(left_out.size(), 1u);
  EXPECT_EQ(left_out[0].id + ", " + left_out[0].asks_for, "minimum_time_arrives, E_A/P_A");
  EXPECT_EQ(left_out.back().id + ", " + left_out.back().asks_for, "small_tex_instead, the sweep");
}

TEST_F(ClaimRules, WhereAllIsDrivenAnUnknownDriveIsAMistake) {
  auto all = evidence();
  all.whole = true;
  EXPECT_EQ(judge(claims_.drives, all).size(), claims_.drives.size());
  all.drives.erase("E_A/P_A");
  try {
    (void)judge(claims_.drives, all);
    FAIL() << "nothing was thrown";
  } catch (const InvalidValue& wrong) {
    EXPECT_EQ(wrong.where() + ", " + wrong.found(), "claim minimum_time_arrives, 'E_A/P_A'");
  }
  EXPECT_THROW(
      paper_index({.drives = {}, .paper = &paper_, .published = &published_, .whole = true}),
      InvalidValue);
}

TEST_F(ClaimRules, WhatIsNotShownToBeDearerDoesNotHoldForIt) {
  for (std::size_t i = 0; i < 12; ++i)  // ratios about 1.1, and an interval that reaches beyond
    drives_["E_C/P_D"].drive.cycles[i].plan.report.cpu_s = i % 2 == 0 ? 0.0009 : 0.0012;
  EXPECT_EQ(drives("moving_is_free"), "holds in part");
  drives_["E_C/P_D"].drive = made();
  EXPECT_EQ(drives("moving_is_free"), "holds");
  drives_["E_B/P_C"].drive.cycles.resize(7);  // six later ones have an interval, five have none
  EXPECT_EQ(drives("moving_is_free"), "holds");
  drives_["E_B/P_C"].drive.cycles.resize(6);
  EXPECT_EQ(drives("moving_is_free"), "holds in part");
  EXPECT_NE(of_drives("moving_is_free").ours.find("E_B × 1.00 [–]; E_C × 1.00 [1.00, 1.00]"),
            std::string::npos);
}

TEST_F(ClaimRules, MinimumTimeHoldsWhereBothEnvironmentsDo) {
  EXPECT_EQ(drives("minimum_time_arrives"), "does not hold");
  EXPECT_EQ(drives("minimum_time_solves"), "does not hold");
  drives_["E_A/P_A"].drive = made(Outcome::goal, 9, 0.004);
  EXPECT_EQ(drives("minimum_time_arrives"), "holds in part");
  EXPECT_EQ(drives("minimum_time_solves"), "holds in part");
  drives_["E_A-figure/P_A"].drive = made(Outcome::goal, 7.5, 0.004);
  EXPECT_EQ(drives("minimum_time_arrives"), "holds");
  EXPECT_EQ(drives("minimum_time_solves"), "holds");
  drives_["E_A-figure/P_A"].drive = made(Outcome::goal, 7.4, 0.004);
  EXPECT_EQ(drives("minimum_time_arrives"), "holds in part");
  EXPECT_EQ(drives("baseline_misses"), "does not hold");
  drives_["E_A/P_A"].drive.cycles[3].plan.report.cpu_s = 0.6;
  EXPECT_EQ(drives("baseline_misses"), "holds");
  EXPECT_EQ(drives("minimum_time_speeds"), "does not hold") << "P_A's gains speed";
}

TEST_F(ClaimRules, SpeedsAndAreasOfTheFigures) {
  for (const char* environment : {"E_A", "E_A-figure"})
    for (auto& sample : drives_[std::string(environment) + "/P_A"].drive.plant)
      sample.state[vehicle::UX] = 20 - sample.t;
  EXPECT_EQ(drives("minimum_time_speeds"), "holds");
  EXPECT_EQ(drives("less_area"), "does not hold") << "as large";
  for (const char* planner : {"P_B", "P_C"})
    for (auto& sample : drives_[std::string("E_A-figure/") + planner].drive.plant)
      sample.state[vehicle::X] = 203;
  EXPECT_EQ(drives("less_area"), "holds");
}

TEST_F(ClaimRules, SolveTimesOfMovingObstacles) {
  EXPECT_EQ(drives("moving_is_free") + ", " + drives("dearer_to_avoid"), "holds, holds");
  EXPECT_EQ(drives("more_obstacles") + ", " + drives("danger"), "does not hold, does not hold");
  auto& cycles = drives_["E_C/P_D"].drive.cycles;  // it is nearest to O2 at the end, at 6 s
  for (std::size_t i = 8; i < cycles.size(); ++i) cycles[i].plan.report.cpu_s = 0.01;
  EXPECT_EQ(drives("danger"), "holds");
  for (auto& cycle : cycles) cycle.plan.report.cpu_s = 0.002;
  EXPECT_EQ(drives("danger"), "does not hold");
  EXPECT_EQ(drives("dearer_to_avoid"), "does not hold");
  EXPECT_EQ(drives("moving_is_free"), "holds in part");
  drives_["E_B/P_D"].drive = made(Outcome::goal, 6, 0.002);
  EXPECT_EQ(drives("moving_is_free"), "does not hold");
  drives_["E_B/P_D"].drive = made();
  drives_["E_C/P_C"].drive = made(Outcome::goal, 6, 0.002);
  EXPECT_EQ(drives("more_obstacles"), "holds");
}

TEST_F(ClaimRules, WhenSolvesAreLong) {
  auto& cycles = drives_["E_A-figure/P_A"].drive.cycles;
  cycles[11].plan.report.cpu_s = 0.1;  // planned at 5.5 s
  EXPECT_EQ(drives("slow_is_hard"), "holds");
  cycles[4].plan.report.cpu_s = 0.2;
  EXPECT_EQ(drives("slow_is_hard"), "does not hold");
  EXPECT_EQ(drives("real_time"), "holds");
  drives_["E_B/P_D"].drive.cycles[0].plan.report.cpu_s = 0.6;
  EXPECT_EQ(drives("real_time"), "does not hold");
  EXPECT_EQ(drives("effort_free"), "holds");
  drives_["E_A/P_C"].drive = made(Outcome::goal, 6, 0.00112);
  EXPECT_EQ(drives("effort_free"), "holds in part");
  drives_["E_A/P_C"].cpu = std::vector<double>(12, 0.0011);  // the median over repeats
  EXPECT_EQ(drives("effort_free"), "holds");
}

TEST_F(ClaimRules, EffortIsLessFromATenthOn) {
  const auto jerk = [&](double jx) {
    for (auto& sample : drives_["E_A-figure/P_C"].drive.plant) sample.control[vehicle::JX] = jx;
    return drives("effort_less") + ", " + drives("effort_no_more");
  };
  EXPECT_EQ(jerk(0.1), "does not hold, holds");
  EXPECT_EQ(jerk(0.099), "holds in part, holds");
  EXPECT_EQ(jerk(0.09), "holds, holds");
  EXPECT_EQ(jerk(0.11), "does not hold, holds in part");
}

TEST_F(ClaimRules, AreaIsBetweenPathAndLine) {
  for (auto& sample : drives_["E_A-figure/P_B"].drive.plant) sample.state[vehicle::X] = 203;
  const auto claim = of_drives("less_area");
  EXPECT_EQ(claim.ours, "E_A-figure: P_A 120 m², P_B 360 m², P_C 120 m²");  // 120 m along y
  EXPECT_EQ(claim.verdict, Verdict::in_part);
}

TEST_F(ClaimRules, MovingObstaclesAreSaferWhereOnlyTheOthersCrash) {
  EXPECT_EQ(drives("moving_is_safer"), "does not hold");
  drives_["E_B/P_C"].drive = crash("O1");
  EXPECT_EQ(drives("moving_is_safer"), "holds in part");
  drives_["E_C/P_C"].drive = crash("O2");
  EXPECT_EQ(drives("moving_is_safer"), "holds");
  EXPECT_EQ(drives("crash_speed"), "does not hold") << "at 3 s";
  drives_["E_C/P_C"].drive = crash("O2", 20);
  drives_["E_C/P_D"].drive = made(Outcome::goal, 28);
  EXPECT_EQ(drives("crash_speed"), "holds");
  EXPECT_EQ(drives("sides"), "holds in part") << "P_D strays left, too";
  for (auto& sample : drives_["E_B/P_D"].drive.plant) sample.state[vehicle::X] = 204;
  EXPECT_EQ(drives("sides"), "holds");
}

TEST_F(ClaimRules, RangeCountsTheDrivesThatCrash) {
  EXPECT_EQ(drives("range_50"), "does not hold");
  int count = 0;
  for (auto& [name, one] : drives_)
    if (name.rfind("seen-50/", 0) == 0 && ++count <= 10) one.drive = crash("O2");
  EXPECT_EQ(drives("range_50"), "holds in part");
  for (auto& [name, one] : drives_)
    if (name.rfind("seen-50/", 0) == 0) one.drive = crash("O2");
  EXPECT_EQ(drives("range_50"), "holds");
  EXPECT_EQ(drives("range_50_crash"), "does not hold");
  drives_["E_C-range-50/P_C"].drive = crash("O2");
  EXPECT_EQ(drives("range_50_crash"), "holds in part");
  for (const char* planner : {"P_C", "P_D"}) {
    auto& plant = drives_[std::string("E_C/") + planner].drive.plant;
    for (std::size_t i = 0; i < 6; ++i) plant[i].state[vehicle::X] = 6;
  }
  EXPECT_EQ(drives("lane_change"), "holds");
  EXPECT_NE(of_drives("lane_change").ours.find("from y = 0 m, with cones from 60 m"),
            std::string::npos);
}

TEST_F(ClaimRules, CasesHoldWhereAllEndAsTheTextSays) {
  const std::vector<std::pair<std::string, sim::Drive>> asText = {{"A", crash("O1")},
                                                                  {"B", made(Outcome::goal, 13)},
                                                                  {"C", made(Outcome::goal, 9)},
                                                                  {"D", made(Outcome::goal, 8)},
                                                                  {"E", crash("O1")},
                                                                  {"F", made(Outcome::goal, 8)}};
  for (const auto& [name, drive] : asText) drives_["cases/" + name].drive = drive;
  EXPECT_EQ(drives("cases"), "holds");
  drives_["cases/D"].drive = made(Outcome::goal, 10);
  EXPECT_EQ(drives("cases"), "holds in part");
  EXPECT_EQ(drives("kinematic_moving"), "does not hold");
  EXPECT_EQ(drives("small_tex_instead"), "holds");
  for (auto& [name, one] : drives_)
    if (name.rfind("case-E/", 0) == 0) one.drive = crash("O1");
  EXPECT_EQ(drives("small_tex_instead"), "holds in part");
  trials_ = sweep(unlike);
  EXPECT_EQ(drives("small_tex_instead"), "does not hold");
}

TEST_F(ClaimRules, IpoptAgreesWhereItsDrivesEndAlikeAndInTime) {
  EXPECT_EQ(drives("ipopt"), "holds");
  drives_["ipopt/E_B/P_D"].drive = crash("O1");
  EXPECT_EQ(drives("ipopt"), "holds in part");
  drives_["ipopt/E_B/P_D"].drive = made(Outcome::goal, 6, 0.6);
  EXPECT_EQ(drives("ipopt"), "does not hold");
}

TEST_F(ClaimRules, OfTheSweepForAndAgainst) {
  EXPECT_NE(of_sweep("safer").ours.find("P_C 4 of 20, P_D 12 of 20: × 3.00"), std::string::npos);
  EXPECT_NE(
      of_sweep("not_needed")
          .ours.find("P_C arrives in 4 of 4; at larger tex in 0 of 4, with a faster O2 in 0 of 6"),
      std::string::npos);
  EXPECT_NE(of_sweep("safety_by_tex").ours.find("P_C at most 0.40; P_D 0.80 up to .5 s, 0.40"),
            std::string::npos);
  for (const char* id : {"safer", "shares", "not_needed", "too_fast", "small_tex", "danger"})
    EXPECT_EQ(by_sweep(id), "holds") << id;
  trials_ = sweep(unlike);
  for (const char* id : {"safer", "shares", "not_needed", "too_fast", "small_tex"})
    EXPECT_EQ(by_sweep(id), "does not hold") << id;
}

TEST_F(ClaimRules, RealTimeHoldsOnlyWhereItIsHard) {
  EXPECT_EQ(by_sweep("real_time"), "does not hold") << "below 1 at every tex";
  trials_ = sweep(like, 0.3);  // the factor is 4.2 at .1 s, 1.4, .96 and .73
  EXPECT_EQ(by_sweep("real_time"), "holds");
  EXPECT_EQ(by_sweep("trade_off"), "holds");
  trials_ = sweep(like, 0.15);  // 2.1 at .1 s, below 1 at the others
  EXPECT_EQ(by_sweep("real_time"), "holds in part");
  trials_ = sweep(like);
  EXPECT_EQ(by_sweep("trade_off"), "does not hold");
}

TEST_F(ClaimRules, SolveTimesOfPairs) {
  EXPECT_EQ(by_sweep("solve_times"), "holds");
  for (auto& trial : trials_)
    if (trial.planner == "P_D") trial.median = 0.002;
  EXPECT_EQ(by_sweep("solve_times"), "holds in part");
  for (auto& trial : trials_)
    if (trial.planner == "P_D") trial.longest = 0.01;
  EXPECT_EQ(by_sweep("solve_times"), "does not hold");
}

TEST_F(ClaimRules, SafetyByHorizonAndSpeed) {
  EXPECT_EQ(by_sweep("safety_by_tex"), "holds in part") << "P_C arrives in 2 of 5 at small tex";
  EXPECT_EQ(by_sweep("slower_is_safer"), "holds");
  trials_ = sweep(unlike);
  EXPECT_EQ(by_sweep("safety_by_tex"), "does not hold");
  EXPECT_EQ(by_sweep("slower_is_safer"), "does not hold");
  trials_ = sweep([](const std::string& planner, double tex, double speed) {
    return planner == "P_D" ? like(planner, tex, speed) : speed == 0;
  });
  EXPECT_EQ(by_sweep("safety_by_tex"), "holds");
  for (auto& trial : trials_) trial.longest = trial.outcome == "goal" ? 0.01 : 0.001;
  EXPECT_EQ(by_sweep("danger"), "does not hold");
}

TEST_F(ClaimRules, TooFastAsksForFastTrials) {
  std::erase_if(trials_, [](const auto& trial) { return trial.speed > 21; });
  for (const auto& one : judge(claims_.sweep, evidence())) EXPECT_NE(one.id, "too_fast");
}

TEST_F(ClaimRules, TheIndexHasOursOrADash) {
  for (const auto& row : paper_index(evidence())) EXPECT_NE(row.of, "");
  trials_.clear();
  int dashes = 0;
  for (const auto& row : paper_index(evidence())) dashes += row.ours == "–";
  EXPECT_EQ(dashes, 3) << "of the sweep";
}

TEST(Parameters, AreOursAsPrintedButForTwo) {
  EXPECT_EQ(compare_parameters("veh"), "16 of 16 values as printed");
  EXPECT_EQ(compare_parameters("enva"), "22 of 22 values as printed");
  EXPECT_EQ(compare_parameters("envc"), "232 of 232 values as printed");
  // The formulation says why these two are not.
  EXPECT_EQ(compare_parameters("parama"),
            "41 of 43 values as printed; differ: planner.X0_tol[6] 0.25, ours 0.025, "
            "planner.w_ax 0.1, ours 0");
}

TEST(Parameters, AreReadAndRoundedAsPrinted) {
  const auto values = [](const char* text) { return expanded(io::parse_argument(text, "here")); };
  using Texts = std::vector<std::string>;
  EXPECT_EQ(values("29"), Texts{"29"});
  EXPECT_EQ(values("[6, -10, 3 x 0.4]"), (Texts{"6", "-10", "0.4", "0.4", "0.4"}));
  EXPECT_EQ(values("[281, 0:5:15]"), (Texts{"281", "0", "5", "10", "15"}));
  EXPECT_TRUE(agrees("2689", 2688.7));
  EXPECT_TRUE(agrees("0.387", 0.38735));
  EXPECT_FALSE(agrees("0.25", 0.025));
  EXPECT_FALSE(agrees("2688", 2688.7));
}

}  // namespace
}  // namespace slalom::paper
