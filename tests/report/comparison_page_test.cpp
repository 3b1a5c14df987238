#include <gtest/gtest.h>

#include <string>

#include "report/markup.hpp"
#include "report/synthetic_drive.hpp"
#include "slalom/base/error.hpp"
#include "slalom/report/report.hpp"

namespace slalom::report {
namespace {

using namespace testing;

NamedPage page_of(const sim::Scenario& scenario, const sim::Drive& drive) {
  return {"A/report.html", drive_page(scenario, drive)};
}

/// The message with which a page is refused as the second of two.
std::string refusal(const std::string& html) {
  const auto good = page_of(synthetic_scenario(), synthetic_drive());
  try {
    (void)comparison_page(good, {"B/report.html", html});
  } catch (const InvalidValue& error) {
    return error.what();
  }
  return "not refused";
}

std::string changed(const std::string& what, const std::string& to) {
  auto html = drive_page(synthetic_scenario(), synthetic_drive());
  return html.replace(html.find(what), what.size(), to);
}

TEST(ComparisonPage, CarriesBothDrivesAsTheirPagesDo) {
  auto other = synthetic_scenario();
  other.name = "other </script>";
  other.planner.name = "P_<X>";
  const auto a = page_of(synthetic_scenario(), synthetic_drive());
  const auto b = page_of(other, synthetic_drive(2));
  const auto page = comparison_page(a, b);
  const auto drives = page_data(page);
  ASSERT_EQ(drives.size(), 2U);
  EXPECT_EQ(drives[0], page_data(a.html));
  EXPECT_EQ(drives[1], page_data(b.html));
  EXPECT_EQ(count(page,
                  "<title>synthetic with P_D · other &lt;/script&gt; with P_&lt;X&gt; · "
                  "compared</title>"),
            1);
  EXPECT_EQ(count(page, "<script"), 2);
  EXPECT_EQ(count(page, "{{"), 0);
}

TEST(ComparisonPage, IsOfWhatThePagesCarryToBeCompared) {
  auto drive = synthetic_drive();
  drive.cycles[2].plan.report.solved = false;
  const auto data = page_data(drive_page(synthetic_scenario(), drive));
  const auto& summary = data["summary"];
  EXPECT_EQ(summary["goal_time"], *drive.goal_time);
  EXPECT_EQ(summary["least_wheel_load"], drive.least_wheel_load);
  EXPECT_EQ(summary["cycles"], drive.cycles.size() - 1) << "the warm-up is none";
  EXPECT_EQ(summary["cycles_unsolved"], 1);
  EXPECT_TRUE(summary["cycles_unverified"].is_null());
  EXPECT_EQ(data["settings"]["loop"]["tex"], "0.5");
  EXPECT_EQ(data["settings"]["start"].size(), vehicle::kStates);
}

TEST(ComparisonPage, RefusesWhatIsNoDriveOfThisFormat) {
  EXPECT_EQ(refusal("<html></html>"),
            "B/report.html: found no drive, expected the report.html of 'slalom simulate'");
  EXPECT_EQ(refusal(changed("\"slalom drive 3\"", "\"slalom drive 0\"")),
            "B/report.html: format: found \"slalom drive 0\", expected \"slalom drive 3\"");
  EXPECT_EQ(refusal(changed("\"format\"", "\"other\"")),
            "B/report.html: format: found none, expected \"slalom drive 3\"");
  EXPECT_EQ(refusal(changed("\"plant\":", "\"plant\"")),
            "B/report.html: found a drive that is damaged, expected the report.html of 'slalom "
            "simulate'");
  EXPECT_EQ(refusal(changed("\"plant\":{\"t\"", "\"plant\":{\"T\"")),
            "B/report.html: found a drive that is damaged, expected the report.html of 'slalom "
            "simulate'");
  EXPECT_EQ(refusal(drive_page(synthetic_scenario(), {})),
            "B/report.html: found a drive in which nothing was driven, expected one that moved");
  // So deep that what writes it again would run out of stack.
  const std::string deep(200'000, '['), shut(200'000, ']');
  for (const char* where : {"\"format\":", "\"message\":"})
    EXPECT_EQ(refusal(changed(where, where + deep + shut + ",\"more\":")),
              "B/report.html: found a drive that is damaged, expected the report.html of 'slalom "
              "simulate'");
  const auto good = page_of(synthetic_scenario(), synthetic_drive());
  EXPECT_EQ(refusal(comparison_page(good, good)),
            "B/report.html: found 2 drives, expected the page of one");
}

}  // namespace
}  // namespace slalom::report
