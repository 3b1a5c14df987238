// hour_page FILE: writes the page of a drive of an hour, for the test of the page in a browser.
#include <fstream>

#include "report/hour_drive.hpp"
#include "slalom/report/report.hpp"

int main(int argc, char** argv) {
  using namespace slalom::report;
  if (argc != 2) return 2;
  const auto made = testing::hour_drive();
  std::ofstream file(argv[1], std::ios::binary);
  file << drive_page(made.scenario, made.drive);
  return file.good() ? 0 : 1;
}
