#include "../../src/io/file_set.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "io/files.hpp"
#include "slalom/io/drive_files.hpp"

namespace slalom::io {
namespace {

using test::TemporaryFolder;

std::vector<std::string> asides(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".aside") names.push_back(entry.path().filename().string());
  return names;
}

TEST(FileSet, NamesAsideCannotBeForeseenAndFitWhateverTheNameIs) {
  TemporaryFolder folder;
  const std::string longest(255, 'n');
  FileSet first, second;
  first.add(folder / longest, "1");
  second.add(folder / longest, "2");
  EXPECT_EQ(asides(folder.path()).size(), 2U);
  first.commit();
  second.commit();
  EXPECT_EQ(test::read(folder / longest), "2");
  EXPECT_EQ(test::count(folder.path()), 1U);
}

TEST(FileSet, WhatKilledRunsLeftIsSweptUpAndNothingElse) {
  TemporaryFolder folder;
  const auto plant = [&] {
    for (const char* name : {".a.txt.4711.aside", ".b.txt.00c0ffee00c0ffee.aside"})
      test::write(folder / name, "half a fi");
  };
  for (const char* name : {"notes.aside", ".aside", ".mine.aside", ".a.txt.4711.aside.txt"})
    test::write(folder / name, "mine");
  std::filesystem::create_symlink(folder / "notes.aside", folder / ".link.0123.aside");
  plant();
  {
    FileSet at_work;
    at_work.add(folder / "c.txt", "c");
    EXPECT_EQ(test::count(folder.path()), 6U);
    plant();
    write_file(folder / "d.txt", "d");  // somebody is at work: whose they are is not known
    EXPECT_EQ(test::count(folder.path()), 9U);
    at_work.commit();
  }
  prepare_folder(folder.path(), true);
  EXPECT_EQ(test::count(folder.path()), 7U);
  for (const char* name : {"notes.aside", ".aside", ".mine.aside", ".a.txt.4711.aside.txt"})
    EXPECT_EQ(test::read(folder / name), "mine");
}

TEST(FileSet, ResultsThatAreReplacedGoOnceTheNewOnesStand) {
  TemporaryFolder folder;
  for (const char* name : {"plan.csv", "resolved.yaml", "notes.txt", "index.html"})
    test::write(folder / name, "old");
  {
    FileSet given_up;
    given_up.add(folder / "lap.csv", "new");
    given_up.replace_results(folder.path());
  }
  EXPECT_EQ(test::count(folder.path()), 4U);
  FileSet files;
  files.add(folder / "resolved.yaml", "new");
  files.replace_results(folder.path());
  EXPECT_EQ(test::read(folder / "plan.csv"), "old");
  files.commit();
  EXPECT_EQ(test::read(folder / "resolved.yaml"), "new");
  EXPECT_FALSE(std::filesystem::exists(folder / "plan.csv"));
  for (const char* name : {"notes.txt", "index.html"}) EXPECT_EQ(test::read(folder / name), "old");
}

}  // namespace
}  // namespace slalom::io
