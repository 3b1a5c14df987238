#include "slalom/io/drive_files.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/files.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/scenario_file.hpp"

namespace slalom::io {
namespace {

using test::TemporaryFolder;

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::size_t columns(const std::string& line) {
  return static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
}

sim::Drive made_up_drive() {
  sim::Drive drive;
  drive.outcome = sim::Outcome::crash;
  drive.time = 0.1 + 0.2;
  drive.hit = "O1";
  drive.least_clearance = std::numeric_limits<double>::infinity();
  sim::PlantSample sample;
  sample.t = 1.0 / 3;
  sample.state = {200, 1e-17, -0.0, 0.1, 1.5707963267948966, 0, 17, 0};
  sample.clearance = std::numeric_limits<double>::infinity();
  drive.plant = {sample, sample};
  for (int index : {0, 1, 2}) {
    sim::Cycle cycle;
    cycle.index = index;
    cycle.tex = 0.5;
    cycle.plan.t_start = 0.5 * index;
    cycle.plan.t = {0, 1, 2};
    cycle.plan.tf = 2;
    cycle.plan.states.resize(3);
    cycle.plan.controls.resize(3);
    cycle.plan.report.wall_s = index == 0 ? 9 : 0.25 * index;
    cycle.plan.report.status = planner::PlanStatus::solved;
    cycle.plan.report.worst_constraint = "obstacle[a, \"b\"] at node 3";
    cycle.plan.report.cost_terms = {{"final_time", 2.5}};
    if (index == 2) cycle.plan.report.cost_terms.push_back({"goal", 1.5});
    drive.cycles.push_back(cycle);
  }
  return drive;
}

/// Of a planner that verifies: a new plan, then the least bad of two that were refused.
sim::Drive verified_drive() {
  auto drive = made_up_drive();
  auto& first = drive.cycles[1].plan;
  first.rung = planner::Rung::new_plan;
  first.certificate = {true, 0.25, 0.15, "O1", 2100, 7.5, "", 0};
  first.candidates = {{"way 1", 12, first.certificate}};
  auto& second = drive.cycles[2].plan;
  second.rung = planner::Rung::least_bad;
  second.certificate = {false, -0.5, 0.15, "O1", 1900, 3, "clearance to O1, at 2 s", 2};
  second.candidates = {{"rest", 11, second.certificate}, {"way 1", 0, second.certificate}};
  drive.cycles[2].t_swap = 1.5;
  second.report.status = planner::PlanStatus::unverified;
  second.report.detail = second.certificate.refused;
  return drive;
}

TEST(DriveFiles, PlantHasTheColumnsPromised) {
  const auto lines = lines_of(plant_csv(made_up_drive()));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0], "t,x,y,v,r,psi,sa,ux,ax,sr,jx,Fz_rl,Fz_rr,Fz_fl,Fz_fr,clearance");
  EXPECT_EQ(lines[1],
            "0.3333333333333333,200,1e-17,-0,0.1,1.5707963267948966,0,17,0,0,0,0,0,0,0,inf");
}

TEST(DriveFiles, PlansAndCyclesLeaveTheWarmUpOut) {
  const auto drive = made_up_drive();
  const auto plans = lines_of(plans_csv(drive));
  EXPECT_EQ(plans[0], "cycle,t_start,node,t,x,y,v,r,psi,sa,ux,ax,sr,jx");
  ASSERT_EQ(plans.size(), 7U);
  EXPECT_EQ(plans[2].substr(0, 12), "1,0.5,1,1.5,");

  const auto cycles = lines_of(cycles_csv(drive));
  ASSERT_EQ(cycles.size(), 3U);
  EXPECT_EQ(cycles[0].find("cycle,t0,tex,solve_time_s,iterations,status,cpu_time_s,cost,"), 0U);
  EXPECT_NE(cycles[0].find(",cost_final_time,cost_goal,worst_constraint,"), std::string::npos);
  EXPECT_NE(cycles[1].find(",2.5,0,\"obstacle[a, \"\"b\"\"] at node 3\","), std::string::npos);
  EXPECT_EQ(columns(cycles[1]), columns(cycles[0]) + 1) << "one comma stands in quotes";
}

TEST(DriveFiles, SummaryIsJsonWithoutInfinity) {
  const auto scenario = load_scenario({"E_C", "P_C", {}, {}});
  const auto json = nlohmann::json::parse(summary_json(scenario, made_up_drive()));
  EXPECT_EQ(json["scenario"], "E_C");
  EXPECT_EQ(json["planner"], "P_C");
  EXPECT_EQ(json["outcome"], "crash");
  EXPECT_EQ(json["hit"], "O1");
  EXPECT_EQ(json["time_s"], 0.1 + 0.2);
  EXPECT_TRUE(json["goal_time_s"].is_null());
  EXPECT_TRUE(json["least_clearance_m"].is_null());
  EXPECT_EQ(json["cycles"], 2);
  EXPECT_EQ(json["solve_time_max_s"], 0.5);
  EXPECT_EQ(json["solve_time_median_s"], 0.375);
  EXPECT_EQ(json["warm_up"]["solve_time_s"], 9);
  EXPECT_EQ(json["tex_s"], 0.5);
  EXPECT_EQ(json["floor"], 0.9);
}

TEST(DriveFiles, CyclesOfAPlannerThatVerifiesSaySo) {
  constexpr const char* added =
      ",road_exit_m,road_exit_edge,rung,verified,verified_clearance,verified_wheel_load,verified_"
      "until,"
      "refused,candidates";
  auto drive = verified_drive();
  const auto lines = lines_of(cycles_csv(drive));
  EXPECT_TRUE(lines[0].ends_with(added)) << lines[0];
  EXPECT_TRUE(lines[1].ends_with(",new,1,0.25,2100,7.5,,1")) << lines[1];
  EXPECT_TRUE(lines[2].ends_with(",least_bad,0,-0.5,1900,3,\"clearance to O1, at 2 s\",2"))
      << lines[2];
  EXPECT_TRUE(lines_of(cycles_csv(made_up_drive()))[0].ends_with(
      ",t_swap,start_slack_m,start_slack_deg,passage_m,passage_obstacle,road_exit_m,road_exit_"
      "edge"));

  drive.cycles[1].plan = {};
  const auto without = lines_of(cycles_csv(drive));
  EXPECT_TRUE(without[1].ends_with(",0,,,0,,,,,")) << without[1];
  EXPECT_EQ(columns(without[1]), columns(without[0]));

  drive.cycles[1].plan.report.road_exit = {0.25, false, 4};
  EXPECT_NE(lines_of(cycles_csv(drive))[1].find(",0.25,right,"), std::string::npos);
}

TEST(DriveFiles, SummaryCountsRungsAndUnverifiedCycles) {
  const auto scenario = load_scenario({"E_C", "P_C", {}, {}});
  const auto json = nlohmann::json::parse(summary_json(scenario, verified_drive()));
  EXPECT_EQ(json["cycles_unverified"], 1);
  EXPECT_EQ(json["rungs"], nlohmann::json({{"new", 1}, {"rest", 0}, {"least_bad", 1}}));
  const auto without = nlohmann::json::parse(summary_json(scenario, made_up_drive()));
  EXPECT_FALSE(without.contains("rungs") || without.contains("cycles_unverified"));
}

TEST(DriveFiles, AFileIsWrittenWholeAndLeavesNothingBeside) {
  TemporaryFolder folder;
  write_file(folder / "a.txt", "first");
  write_file(folder / "a.txt", "second");
  EXPECT_EQ(test::read(folder / "a.txt"), "second");
  EXPECT_EQ(test::count(folder.path()), 1U);
}

TEST(DriveFiles, AFailedWriteKeepsTheOldFile) {
  TemporaryFolder folder;
  write_file(folder / "a.txt", "old");
  signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 4096;
  setrlimit(RLIMIT_FSIZE, &small);
  const auto message = error_of([&] { write_file(folder / "a.txt", std::string(100000, 'x')); });
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_NE(message.find("a.txt: cannot be written (File too large)"), std::string::npos)
      << message;
  EXPECT_EQ(test::read(folder / "a.txt"), "old");
  EXPECT_EQ(test::count(folder.path()), 1U);
}

TEST(DriveFiles, PathsThatCannotBeWritten) {
  TemporaryFolder folder;
  test::write(folder / "file", "");
  EXPECT_NE(error_of([&] { write_file(folder / "file/a.txt", "x"); }), "");
  EXPECT_NE(error_of([&] { write_file(folder.path(), "x"); }), "");
  EXPECT_NE(error_of([&] { prepare_folder(folder / "file", true); }).find("is a file"),
            std::string::npos);
  EXPECT_NE(error_of([&] { prepare_folder(folder / "file/sub", true); }), "");
  EXPECT_NE(error_of([&] { prepare_folder("/proc/slalom", false); }), "");
  EXPECT_EQ(test::read(folder / "file"), "");
}

TEST(DriveFiles, ResultsAreNotOverwrittenUnlessForced) {
  TemporaryFolder folder;
  prepare_folder(folder / "deep/out", false);
  EXPECT_EQ(test::count(folder / "deep/out"), 0U);
  prepare_folder(folder / "deep/out", false);
  test::write(folder / "deep/out/notes.txt", "mine");
  prepare_folder(folder / "deep/out", false);
  test::write(folder / "deep/out/summary.json", "{}");
  EXPECT_NE(error_of([&] { prepare_folder(folder / "deep/out", false); }).find("--force"),
            std::string::npos);
  prepare_folder(folder / "deep/out", true);
  EXPECT_EQ(test::read(folder / "deep/out/summary.json"), "{}");
  for (const char* name : {"lap.csv", "plan.csv", "plant.csv", "index.html"}) {
    const auto out = folder / name;
    std::filesystem::create_directory(out);
    test::write(out / name, "");
    EXPECT_NE(error_of([&] { prepare_folder(out, false); }).find(name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace slalom::io
