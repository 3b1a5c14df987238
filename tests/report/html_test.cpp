#include "../../src/report/html.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "slalom/base/error.hpp"

namespace slalom::report {
namespace {

TEST(Html, EscapesWhatMarkupReads) {
  EXPECT_EQ(escape("<a href=\"x\" b='y'> & \x01z"),
            "&lt;a href=&quot;x&quot; b=&#39;y&#39;&gt; &amp; z");
}

TEST(Html, JsonCannotEndItsScript) {
  const nlohmann::ordered_json json = {{"a", "</script><!-- \xff"}, {"</b>", 1}};
  const auto text = script_json(json);
  EXPECT_EQ(text.find('<'), std::string::npos);
  const auto read = nlohmann::json::parse(text);
  EXPECT_EQ(read["a"], "</script><!-- \xef\xbf\xbd");
  EXPECT_EQ(read["</b>"], 1);
}

TEST(Html, FillsEachNameOnceAndNothingInsideValues) {
  EXPECT_EQ(fill("{{a}}-{{b}}-{{a}}", {{"a", "{{b}}"}, {"b", "2"}}), "{{b}}-2-{{b}}");
  EXPECT_EQ(fill("no names {{", {}), "no names {{");
  EXPECT_THROW(fill("{{missing}}", {{"a", "1"}}), Error);
}

TEST(Html, NumbersForPeople) {
  EXPECT_EQ(number(-1.25, 1), "−1.2");
  EXPECT_EQ(number(-0.001, 2), "0.00");
  EXPECT_EQ(number(std::numeric_limits<double>::infinity(), 2), "–");
  EXPECT_EQ(number(std::numeric_limits<double>::quiet_NaN(), 2), "–");
  EXPECT_EQ(significant(5.86e-4, 3), "0.000586");
  EXPECT_EQ(significant(0.5304, 3), "0.530");
  EXPECT_EQ(significant(-1234.5, 3), "−1234");
  EXPECT_EQ(significant(0, 3), "0");
  EXPECT_EQ(significant(1.5e-9, 2), "1.5e-09");
}

TEST(Html, LinksAreEncoded) {
  EXPECT_EQ(link("E_C/P \"D\"/report.html#t=1.5", "<x>"),
            "<a href=\"E_C/P%20%22D%22/report.html#t=1.5\">&lt;x&gt;</a>");
}

}  // namespace
}  // namespace slalom::report
