#include "slalom/problems/library.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "slalom/base/error.hpp"

namespace slalom::problems {
namespace {

long count(Tag tag) {
  return std::count_if(library().begin(), library().end(),
                       [tag](const Entry& entry) { return entry.has(tag); });
}

TEST(Library, CoversWhatItIsFor) {
  EXPECT_GE(library().size(), 40u);
  EXPECT_GE(std::count_if(library().begin(), library().end(),
                          [](const Entry& entry) {
                            return std::any_of(entry.tags.begin(), entry.tags.end(), is_hard);
                          }),
            15);
  EXPECT_GE(count(Tag::phases), 6);
  EXPECT_GE(count(Tag::parameter_estimation), 5);
  EXPECT_GE(count(Tag::free_final_time), 8);
  for (const Tag tag : all_tags()) EXPECT_GE(count(tag), 2) << to_string(tag);
}

TEST(Library, NamesAreUniqueAndWordsOfACommandLine) {
  std::set<std::string> names;
  for (const auto& entry : library()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_EQ(entry.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"),
              std::string::npos)
        << entry.name;
  }
}

TEST(Library, EachProblemSaysWhereItIsFromAndWhatIsKnown) {
  for (const auto& entry : library()) {
    SCOPED_TRACE(entry.name);
    EXPECT_FALSE(entry.title.empty() || entry.source.empty() || entry.hard.empty());
    EXPECT_TRUE(entry.published || entry.closed_form || entry.converged);
    EXPECT_TRUE(std::isfinite(entry.reference()));
    EXPECT_GT(entry.tolerance(), 0);
    // A print that the converged value refutes is refuted with figures.
    if (entry.published && entry.converged) EXPECT_FALSE(entry.remark.empty());
  }
}

TEST(Library, TagsTellPhasesAndFreeTimesAsTheProblemsHaveThem) {
  for (const auto& entry : library()) {
    SCOPED_TRACE(entry.name);
    const Statement statement = entry.state();
    const auto* several = std::get_if<ocp::PhasedProblem>(&statement.problem);
    EXPECT_EQ(several != nullptr, entry.has(Tag::phases));
    const auto& last =
        several ? several->phases().back() : std::get<ocp::Problem>(statement.problem);
    const auto bounds = last.tf().bounds;
    EXPECT_EQ(bounds.lower < bounds.upper, entry.has(Tag::free_final_time));
    const std::size_t phases = several ? several->phases().size() : 1;
    EXPECT_TRUE(statement.guesses.empty() || statement.guesses.size() == phases);
    // A plain guess: a few straight lines.
    for (const auto& guess : statement.guesses) EXPECT_LE(guess.tau.size(), 5u);
  }
}

TEST(Library, FindsByNameAndNamesTheNearest) {
  EXPECT_EQ(find(library(), "goddard").title, "Goddard's rocket, highest ascent");
  try {
    (void)find(library(), "godard");
    FAIL();
  } catch (const InvalidValue& error) {
    EXPECT_EQ(error.found(), "'godard'");
    EXPECT_EQ(error.expected(), "perhaps 'goddard'");
  }
  EXPECT_THROW((void)find(library(), ""), InvalidValue);
}

TEST(Published, IsAsPreciseAsItsDigits) {
  const Published long_number{"9.02229e-3", ""}, whole{"350", ""};
  EXPECT_DOUBLE_EQ(long_number.value(), 9.02229e-3);
  EXPECT_NEAR(long_number.resolution(), 5e-9, 1e-20);
  EXPECT_NEAR(whole.resolution(), 0.5, 1e-15);
}

TEST(Entry, IsHeldToItsClosedFormBeforeItsPrint) {
  Entry entry;
  entry.published = Published{"5.46", ""};
  EXPECT_NEAR(entry.reference(), 5.46, 1e-12);
  EXPECT_NEAR(entry.tolerance(), 0.005, 1e-12);
  entry.converged = 5.4579;
  EXPECT_NEAR(entry.tolerance(), 5.4579e-5, 1e-12);
  entry.closed_form = ClosedForm{0, ""};
  EXPECT_EQ(entry.reference(), 0);
  EXPECT_EQ(entry.tolerance(), 1e-5);
}

}  // namespace
}  // namespace slalom::problems
