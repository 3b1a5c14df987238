#include "slalom/base/options.hpp"

#include <gtest/gtest.h>

#include "slalom/base/error.hpp"

namespace slalom {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

enum class Colour { red, green, blue };
struct Settings {
  double weight = 2;
  int count = 3;
  bool on = false;
  std::string title = "none";
  Colour colour = Colour::green;
  std::array<double, 2> range{0, 1};
};

OptionTable<Settings> table() {
  OptionTable<Settings> t;
  t.real("weight", &Settings::weight, OptionRange::positive(), "kg", "How heavy.", "Table 1")
      .integer("count", &Settings::count, OptionRange::closed(1, 10), "1", "How many.")
      .boolean("on", &Settings::on, "Whether.")
      .text("title", &Settings::title, "What it is called.")
      .choice("colour", &Settings::colour, {"red", "green", "blue"}, "Which.")
      .vector("range", &Settings::range, OptionRange::non_negative(), "m", "From, to.");
  return t;
}

/// Sets one option by name; the message if that throws.
std::string message_of(const std::string& name, const OptionValue& value) {
  Settings settings;
  const auto options = table();
  try {
    options.set(settings, *options.find(name), value, "here");
  } catch (const InvalidValue& error) {
    return error.what();
  }
  return "";
}
const std::int64_t kTwo = 2;
const std::vector<double> kPair = {3, 4};

TEST(OptionTable, StoresAndReadsEveryKind) {
  Settings s;
  const auto options = table();
  const auto round_trip = [&](const char* name, const OptionValue& value) {
    options.set(s, *options.find(name), value, "here");
    EXPECT_EQ(options.find(name)->get(s), value) << name;
  };
  round_trip("weight", 4.5);
  round_trip("count", kTwo);
  round_trip("on", true);
  round_trip("title", std::string("a b"));
  round_trip("colour", std::string("blue"));
  round_trip("range", kPair);
  EXPECT_EQ(s.weight, 4.5);
  EXPECT_EQ(s.count, 2);
  EXPECT_TRUE(s.on);
  EXPECT_EQ(s.title, "a b");
  EXPECT_EQ(s.colour, Colour::blue);
  EXPECT_EQ(s.range, (std::array<double, 2>{3, 4}));
}

TEST(OptionTable, KeepsWhatWasSaidAtRegistration) {
  const auto options = table();
  ASSERT_EQ(options.entries().size(), 6u);
  const auto& info = options.find("weight")->info;
  EXPECT_EQ(info.kind, OptionKind::real);
  EXPECT_EQ(info.unit, "kg");
  EXPECT_EQ(info.doc, "How heavy.");
  EXPECT_EQ(info.source, "Table 1");
  EXPECT_EQ(options.find("range")->info.length, 2u);
  EXPECT_EQ(options.find("colour")->info.choices.size(), 3u);
  EXPECT_EQ(options.find("Weight"), nullptr) << "names are matched as they are";
}

TEST(OptionTable, TakesAnIntegerForARealButNotTheReverse) {
  Settings s;
  const auto options = table();
  options.set(s, *options.find("weight"), kTwo, "here");
  EXPECT_EQ(s.weight, 2.0);
  EXPECT_EQ(message_of("count", 2.0), "here: found a number 2, expected an integer for count");
}

TEST(OptionTable, RefusesTheWrongKindSayingBoth) {
  EXPECT_EQ(message_of("weight", true),
            "here: found a boolean true, expected a number > 0 for weight");
  EXPECT_EQ(message_of("weight", std::string("2")),
            "here: found text 2, expected a number > 0 for weight");
  EXPECT_EQ(message_of("count", kPair), "here: found a list [3, 4], expected an integer for count");
  EXPECT_EQ(message_of("on", kTwo), "here: found an integer 2, expected true or false for on");
  EXPECT_EQ(message_of("title", 1.5), "here: found a number 1.5, expected text for title");
  EXPECT_EQ(message_of("colour", kTwo),
            "here: found an integer 2, expected one of red, green, blue for colour");
  EXPECT_EQ(message_of("range", 1.0),
            "here: found a number 1, expected a list of 2 numbers for range");
}

TEST(OptionTable, RefusesWhatIsOutOfRangeNamingOptionAndRule) {
  EXPECT_EQ(message_of("weight", 0.0), "here: found weight = 0, expected a number > 0");
  EXPECT_EQ(message_of("count", std::int64_t{11}),
            "here: found count = 11, expected a number >= 1 and <= 10");
  EXPECT_EQ(message_of("range", std::vector<double>{1, -2}),
            "here: found range = -2, expected a number >= 0");
  EXPECT_EQ(message_of("range", std::vector<double>{1}),
            "here: found range with 1 numbers, expected a list of 2 numbers");
  for (double bad : {kInf, -kInf, kNaN}) {
    EXPECT_NE(message_of("weight", bad), "") << bad;
    EXPECT_NE(message_of("range", std::vector<double>{1, bad}), "") << bad;
  }
}

TEST(OptionTable, AnUnknownChoiceGetsTheNearestOne) {
  EXPECT_EQ(message_of("colour", std::string("gren")),
            "here: found colour = 'gren', expected one of red, green, blue (did you mean "
            "'green'?)");
  EXPECT_EQ(message_of("colour", std::string("ultraviolet")),
            "here: found colour = 'ultraviolet', expected one of red, green, blue");
}

TEST(OptionTable, ARefusedValueChangesNothing) {
  Settings s;
  const auto options = table();
  EXPECT_THROW(options.set(s, *options.find("weight"), -1.0, "here"), InvalidValue);
  EXPECT_EQ(s.weight, 2);
}

TEST(OptionTable, ChecksSettingsMadeInCode) {
  Settings s;
  EXPECT_NO_THROW(table().check(s, "in code"));
  s.range[1] = -5;
  try {
    table().check(s, "in code");
    FAIL() << "nothing thrown";
  } catch (const InvalidValue& error) {
    EXPECT_STREQ(error.what(), "in code: found range = -5, expected a number >= 0");
    EXPECT_EQ(error.keys(), std::vector<std::string>{"range"});
  }
}

TEST(OptionTable, EveryRefusalHasItsKey) {
  const std::vector<std::pair<const char*, OptionValue>> refused = {
      {"weight", true}, {"weight", -1.0},
      {"count", 2.5},   {"count", std::int64_t{11}},
      {"on", 1.0},      {"title", 1.0},
      {"colour", 1.0},  {"colour", std::string("grey")},
      {"range", 1.0},   {"range", std::vector<double>{1}}};
  const auto options = table();
  for (const auto& [name, value] : refused) {
    std::vector<std::string> keys;
    try {
      (void)options.find(name)->info.checked(value, "here");
    } catch (const InvalidValue& error) {
      keys = error.keys();
    }
    EXPECT_EQ(keys, std::vector<std::string>{name}) << to_string(value);
  }
}

TEST(OptionTable, ElementsOfAnArrayHaveNames) {
  using Pair = std::array<double, 2>;
  OptionTable<Pair> options;
  options.element("first", 0, OptionRange::any(), "m", "One.")
      .element("second", 1, OptionRange::positive(), "m", "Another.");
  Pair pair = {1, 2};
  options.set(pair, *options.find("second"), 3.0, "here");
  EXPECT_EQ(pair, (Pair{1, 3}));
  EXPECT_EQ(options.find("first")->get(pair), OptionValue(1.0));
  pair[1] = 0;
  EXPECT_THROW(options.check(pair, "here"), InvalidValue);
}

TEST(OptionTable, AnIntegerBeyondIntIsRefusedWhateverTheRange) {
  struct Wide {
    int n = 0;
  };
  OptionTable<Wide> options;
  options.integer("n", &Wide::n, OptionRange::any(), "1", "Any.");
  Wide s;
  EXPECT_THROW(options.set(s, options.entries()[0], std::int64_t{1} << 40, "here"), InvalidValue);
  EXPECT_THROW(options.set(s, options.entries()[0], -(std::int64_t{1} << 40), "here"),
               InvalidValue);
  EXPECT_EQ(s.n, 0);
}

TEST(OptionTable, AVectorOfAnyLengthSaysSo) {
  OptionInfo info;
  info.name = "list";
  info.kind = OptionKind::vector;
  EXPECT_NO_THROW((void)info.checked(std::vector<double>{1, 2, 3}, "here"));
  try {
    (void)info.checked(true, "here");
    FAIL() << "nothing thrown";
  } catch (const InvalidValue& error) {
    EXPECT_EQ(error.expected(), "a list of numbers for list");
  }
}

TEST(OptionRange, EndsAreInOrOutAsSaid) {
  EXPECT_TRUE(OptionRange::any().contains(-1e300));
  EXPECT_FALSE(OptionRange::positive().contains(0));
  EXPECT_TRUE(OptionRange::positive().contains(1e-300));
  EXPECT_TRUE(OptionRange::non_negative().contains(0));
  EXPECT_FALSE(OptionRange::non_negative().contains(-1e-300));
  const auto closed = OptionRange::closed(1, 2);
  EXPECT_TRUE(closed.contains(1) && closed.contains(2));
  EXPECT_FALSE(closed.contains(0.999) || closed.contains(2.001));
  const OptionRange open{.lo = 0, .hi = 1, .lo_open = true, .hi_open = true};
  EXPECT_FALSE(open.contains(0) || open.contains(1));
  EXPECT_FALSE(open.contains(kNaN));
  EXPECT_EQ(open.to_string(), "a number > 0 and < 1");
  EXPECT_EQ(closed.to_string(), "a number >= 1 and <= 2");
  EXPECT_EQ((OptionRange{.hi = 5}).to_string(), "a number <= 5");
  EXPECT_EQ(OptionRange::any().to_string(), "a finite number");
}

TEST(OptionValue, TextIsAsInFiles) {
  EXPECT_EQ(to_string(OptionValue{true}), "true");
  EXPECT_EQ(to_string(OptionValue{kTwo}), "2");
  EXPECT_EQ(to_string(OptionValue{0.1}), "0.1") << "the shortest text that reads back the same";
  EXPECT_EQ(to_string(OptionValue{std::string("word")}), "word");
  EXPECT_EQ(to_string(OptionValue{std::vector<double>{1, 0.5}}), "[1, 0.5]");
  EXPECT_EQ(to_string(OptionValue{std::vector<double>{}}), "[]");
}

TEST(NearestName, FindsTypingErrors) {
  const std::vector<std::string> names = {"radius", "velocity", "heading", "x", "tex"};
  EXPECT_EQ(nearest_name("radios", names), "radius");
  EXPECT_EQ(nearest_name("radus", names), "radius");
  EXPECT_EQ(nearest_name("raddius", names), "radius");
  EXPECT_EQ(nearest_name("velosity", names), "velocity");
  EXPECT_EQ(nearest_name("heading", names), "heading");
}

TEST(NearestName, IsSilentWhenNoneIsNear) {
  EXPECT_EQ(nearest_name("colour", {"radius", "velocity"}), "");
  EXPECT_EQ(nearest_name("radius", {}), "");
  EXPECT_EQ(nearest_name("", {"radius"}), "");
  EXPECT_EQ(nearest_name("q", {"x", "xy"}), "") << "nothing of the word is left";
}

}  // namespace
}  // namespace slalom
