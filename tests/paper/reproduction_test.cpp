#include "../../src/paper/reproduction.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "../../src/paper/claims.hpp"
#include "../../src/paper/comparison.hpp"
#include "../../src/paper/evaluation.hpp"
#include "../../src/paper/paper_data.hpp"
#include "report/markup.hpp"
#include "report/synthetic_drive.hpp"

namespace slalom::paper {
namespace {

using namespace report::testing;

ReproducedDrive reproduced(const std::string& environment, const std::string& planner,
                           sim::Drive drive = synthetic_drive()) {
  auto scenario = synthetic_scenario();
  scenario.name = environment;
  scenario.planner.name = planner;
  return {scenario, std::move(drive), environment + "/" + planner};
}

std::vector<ReproducedDrive> all_drives() {
  auto crash = synthetic_drive();
  crash.outcome = sim::Outcome::crash;
  crash.goal_time.reset();
  crash.hit = "O2";
  return {reproduced("E_A", "P_A"),        reproduced("E_A", "P_B"),
          reproduced("E_A", "P_C"),        reproduced("E_A-figure", "P_A"),
          reproduced("E_A-figure", "P_B"), reproduced("E_A-figure", "P_C"),
          reproduced("E_B", "P_C", crash), reproduced("E_B", "P_D"),
          reproduced("E_C", "P_C", crash), reproduced("E_C", "P_D")};
}

PaperData paper_data() {
  PaperData paper;
  PaperDrive drive;
  drive.environment = "E_C";
  drive.planner = "P_D";
  drive.outcome = "goal";
  drive.time = 4.5;
  drive.note = "a note on <this> drive";
  drive.snapshots = {{0, 0, 0, 0, 1.57, true, 2.5},
                     {2, 2.0, 1.9, 34, 1.57, true, 2.5},
                     {3, 3.0, 30, 34, 1.57, true, 2.5},
                     {4.5, 4.5, 0, 76, 1.57, true, 2.5}};
  paper.drives = {drive};
  paper.notes = {{"effort", "why the effort differs"}};
  paper.effort_P_B = {5.86e-4, 1.29e-3, .530, .532};
  paper.effort_P_C = {4.22e-4, 9.22e-4, .420, .421};
  return paper;
}

TEST(ReproductionPage, SetsOursBesideThePapers) {
  const auto page = reproduction_page(all_drives(), paper_data());
  EXPECT_GT(count(page, "href=\"E_C/P_D/report.html\""), 0);
  EXPECT_GT(count(page, "href=\"E_C/P_D/report.html#t=2.0000\""), 0);
  EXPECT_EQ(count(page, "a note on &lt;this&gt; drive"), 1);
  EXPECT_EQ(count(page, "why the effort differs"), 1);
  EXPECT_EQ(count(page, "−20.9 %"), 1);
  for (const char* environment : {"E_A-figure", "E_A"}) {
    EXPECT_EQ(count(page, std::string(environment) + "<br><small>0.1 ∫(·)² dt, the paper’s"), 1);
    EXPECT_EQ(count(page, std::string(environment) + "<br><small>the cost’s weights 0.1, 1, 0.01"),
              1);
  }
  EXPECT_EQ(count(page, "✓ within"), 1);
  EXPECT_EQ(count(page, "✕ outside"), 1);
  EXPECT_EQ(count(page, "over at 4.00 s"), 1);
  EXPECT_EQ(count(page, "{{"), 0);
}

TEST(ReproductionPage, IsSelfContained) {
  const auto page = reproduction_page(all_drives(), paper_data());
  EXPECT_FALSE(std::regex_search(page, std::regex("src=|@import|url\\((?!#)")));
  EXPECT_FALSE(std::regex_search(page, std::regex("https?://(?!www\\.w3\\.org)")));
  EXPECT_EQ(count(page, "<script"), 0);
}

TEST(ReproductionPage, MarksSnapshotsOfSeriesThatLag) {
  auto paper = paper_data();
  auto& drive = paper.drives.front();
  drive.lag = 0.4;
  for (auto& snapshot : drive.snapshots) snapshot.comparable = false;
  const auto page = reproduction_page(all_drives(), paper);
  EXPECT_EQ(count(page, "✓ within"), 0);
  EXPECT_EQ(count(page, "the series lags</span>"), 2);
}

TEST(ReproductionPage, WithstandsOddDrives) {
  EXPECT_NO_THROW(reproduction_page({}, {}));
  EXPECT_NO_THROW(reproduction_page({}, paper_data()));
  for (const auto& odd : odd_drives()) {
    SCOPED_TRACE(odd.name);
    auto drives = all_drives();
    for (auto& one : drives) one.drive = odd.drive;
    drives.push_back({odd.scenario, odd.drive, "odd & <name>/P_D"});
    const auto page = reproduction_page(drives, paper_data());
    EXPECT_EQ(count(page, "<script"), 0);
    for (const auto& figure : reproduction_figures(drives, paper_data()))
      EXPECT_NO_THROW(parse_xml(figure.svg)) << figure.file;
  }
}

TEST(ReproductionFigures, AreOneGroupAnEnvironment) {
  std::vector<std::string> names;
  for (const auto& figure : reproduction_figures(all_drives(), paper_data())) {
    names.push_back(figure.file);
    EXPECT_NO_THROW(parse_xml(figure.svg)) << figure.file;
  }
  std::vector<std::string> expected;
  for (const std::string environment : {"E_A", "E_A-figure", "E_B", "E_C"}) {
    for (const char* what : {"_traces", "_dynamics", "_path", ""})
      expected.push_back(environment + what + ".svg");
    if (environment == "E_B" || environment == "E_C")
      expected.push_back(environment + "_crash.svg");
  }
  EXPECT_EQ(names, expected);
}

TEST(ReproductionFigures, MarkThePapersPositions) {
  for (const auto& figure : reproduction_figures(all_drives(), paper_data()))
    EXPECT_EQ(count(figure.svg, ">paper’s positions</text>"),
              figure.file == "E_C_path.svg" || figure.file == "E_C.svg")
        << figure.file;
}

TEST(ReproductionFigures, ShowEachCrashWithItsPlan) {
  auto crash = synthetic_drive();
  crash.outcome = sim::Outcome::crash;
  crash.hit = "O2";
  const auto figures = reproduction_figures(
      {reproduced("E_C", "P_C", crash), reproduced("E_C", "P_D", crash)}, paper_data());
  ASSERT_EQ(figures.size(), 6u);
  EXPECT_EQ(figures[4].file, "E_C_crash.svg");
  EXPECT_EQ(figures[5].file, "E_C_crash_P_D.svg");
  EXPECT_EQ(count(figures[4].svg, ">plan</text>"), 1);
  // The plan that drives at 4 s is the sixth, of 3 s: it holds O2, whose edge is drawn once more.
  EXPECT_EQ(count(figures[4].svg, "stroke-dasharray=\"2 1.5\""), 1);
  EXPECT_EQ(count(figures[2].svg, ">plan</text>"), 0);
}

TEST(ReproductionFigures, ShowTheLimitsOfAccelerationThatAreNear) {
  auto braking = synthetic_drive();
  for (auto& sample : braking.plant) sample.state[vehicle::AX] = -4;
  const auto limits = [](const sim::Drive& drive) {
    const auto figures = reproduction_figures({reproduced("E_B", "P_D", drive)}, {});
    return count(figures.front().svg, "stroke-dasharray=\"1 1.5\"");
  };
  EXPECT_EQ(limits(synthetic_drive()), 1);
  EXPECT_EQ(limits(braking), 2);
}

TEST(ReproductionPage, ShowsVerdicts) {
  const std::vector<Judged> claims = {{"a", "it <is> so", "", "1", "2", Verdict::holds},
                                      {"b", "partly", "", "1", "2", Verdict::in_part},
                                      {"c", "not", "", "1", "2", Verdict::fails}};
  const auto page = reproduction_page(all_drives(), paper_data(), {}, claims);
  EXPECT_EQ(count(page, "✓ yes</span></td><td>it &lt;is&gt; so"), 1);
  EXPECT_EQ(count(page, "in&nbsp;part</span></td><td>partly"), 1);
  EXPECT_EQ(count(page, "✕ no</span></td><td>not"), 1);
  EXPECT_EQ(count(page, "Claims that hold</dt><dd class=\"bad\">1 <small>of 3"), 1);
}

TEST(Comparison, IsByOutcomeObstacleAndTime) {
  PaperDrive paper;
  paper.outcome = "goal";
  paper.earliest = 3.5;
  paper.latest = 4.5;
  auto drive = synthetic_drive();
  EXPECT_TRUE(as_paper(drive, paper));
  drive.time = 4.6;
  EXPECT_FALSE(as_paper(drive, paper));
  drive.time = 4;
  drive.outcome = sim::Outcome::crash;
  drive.hit = "O2";
  EXPECT_FALSE(as_paper(drive, paper));
  paper.outcome = "crash";
  EXPECT_FALSE(as_paper(drive, paper)) << "another obstacle";
  paper.hit = "O2";
  EXPECT_TRUE(as_paper(drive, paper));
}

TEST(Evaluation, HasEveryTable) {
  Reproduction all;
  all.paper = load_paper_data();
  all.drives = all_drives();
  const auto json = nlohmann::json::parse(evaluation_json(all));
  ASSERT_EQ(json["drives"].size(), 10u);
  const auto& last = json["drives"].back();
  EXPECT_EQ(last["folder"], "E_C/P_D");
  EXPECT_EQ(last["printed"]["as_paper"], false) << "4 s are too early";
  EXPECT_EQ(last["printed"]["snapshots"].size(), 3u) << "the start is given";
  EXPECT_EQ(last["printed"]["snapshots"][0]["ours"], nullptr) << "ours was over";
  EXPECT_EQ(json["effort"].size(), 2u);
  EXPECT_EQ(json["sweeps"].size(), 0u);
  EXPECT_GT(json["claims"].size(), 10u);
  EXPECT_GT(json["claims_left_out"].size(), 5u) << "of cases, of the sweep, and of drives besides";
  EXPECT_GT(json["index"].size(), 10u);
  ASSERT_EQ(json["figures"].size(), 18u) << "four an environment, and two crashes";
  EXPECT_EQ(json["figures"][12]["file"], "E_B_crash.svg");
  EXPECT_NE(json["figures"][12]["caption"].get<std::string>().find("edge of O2"),
            std::string::npos);
}

std::vector<ConceptCase> three_cases(double b_arrives, double c_arrives) {
  auto crash = synthetic_drive(3);
  crash.outcome = sim::Outcome::crash;
  crash.hit = "O1";
  auto b = synthetic_drive(), c = synthetic_drive();
  b.goal_time = b_arrives;
  c.goal_time = c_arrives;
  return {{"A", "S1", "it <collides>", "crash", "", reproduced("one", "P_A", crash)},
          {"B", "S1, S3", "it arrives", "goal", "", reproduced("one", "P_A", b)},
          {"C", "S1 to S3", "it arrives before", "goal", "B", reproduced("one", "P_B", c)}};
}

std::string case_verdicts(const std::vector<ConceptCase>& cases) {
  const auto page = reproduction_page({}, {}, cases);
  const std::regex row("<tr><th scope=\"row\">(.)</th>.*(yes|no)</span></td></tr>");
  std::string verdicts;
  for (std::sregex_iterator it(page.begin(), page.end(), row), end; it != end; ++it)
    verdicts += (*it)[1].str() + " " + (*it)[2].str() + " ";
  return verdicts;
}

TEST(ConceptCases, HoldByOutcomeAndOrder) {
  EXPECT_EQ(case_verdicts(three_cases(3.6, 3.4)), "A yes B yes C yes ");
  EXPECT_EQ(case_verdicts(three_cases(3.4, 3.6)), "A yes B yes C no ");
  auto cases = three_cases(3.6, 3.4);
  cases[0].driven.drive.outcome = sim::Outcome::goal;
  cases[1].driven.drive.outcome = sim::Outcome::timeout;
  EXPECT_EQ(case_verdicts(cases), "A no B no C no ") << "C's rival has not arrived";
}

TEST(ConceptCases, AreStripsWithTheirVerdicts) {
  const auto figures = reproduction_figures({}, {}, three_cases(3.6, 3.4));
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_NO_THROW(parse_xml(figures[0].svg));
  EXPECT_EQ(count(figures[0].svg, ">A: crashed into O1 at 3.0 s (S1)</text>"), 1);
  EXPECT_EQ(count(figures[0].svg, ">C: arrives at 3.4 s (S1 to S3)</text>"), 1);
  const auto page = reproduction_page({}, {}, three_cases(3.6, 3.4));
  EXPECT_EQ(count(page, "it &lt;collides&gt;"), 1);
  EXPECT_EQ(count(page, "{{"), 0);
}

TEST(ConceptCases, WithstandOddDrives) {
  for (const auto& odd : odd_drives()) {
    SCOPED_TRACE(odd.name);
    auto cases = three_cases(3.6, 3.4);
    for (auto& one : cases) one.driven = {odd.scenario, odd.drive, "cases/x"};
    for (const auto& figure : reproduction_figures({}, {}, cases))
      EXPECT_NO_THROW(parse_xml(figure.svg));
    EXPECT_EQ(count(reproduction_page({}, {}, cases), "<script"), 0);
  }
}

}  // namespace
}  // namespace slalom::paper
