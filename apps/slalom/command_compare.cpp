#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "../../src/io/text_file.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "slalom/io/drive_files.hpp"
#include "slalom/report/report.hpp"

namespace slalom::app {
namespace {

namespace fs = std::filesystem;

struct CompareOptions {
  std::string first, second, out = "compare.html";
  bool force = false;
};

/// Far more than the page of any drive.
constexpr std::size_t kMostBytes = 64'000'000;

report::NamedPage page_in(const std::string& folder) {
  constexpr const char* expected = "a folder of results of 'slalom simulate'";
  std::error_code error;
  if (!fs::exists(folder, error)) throw InvalidValue(folder, "no such folder", expected);
  if (!fs::is_directory(folder, error)) throw InvalidValue(folder, "a file", expected);
  const auto file = fs::path(folder) / "report.html";
  return {file.string(), io::read_file(file, kMostBytes, "the page of a drive")};
}

int compare(const CompareOptions& options) {
  const auto html = report::comparison_page(page_in(options.first), page_in(options.second));
  std::error_code error;
  if (!options.force && fs::exists(options.out, error))
    throw OutputError(options.out + ": stands already; --force replaces it");
  write_or_fail([&] { io::write_file(options.out, html); });
  print(fmt::format("written to {}\n", options.out));
  return kOk;
}

}  // namespace

void add_compare(CLI::App& app, Command& run) {
  auto options = std::make_shared<CompareOptions>();
  auto* command = app.add_subcommand("compare", "Make one page that plays two drives together");
  const char* folder = "Folder of results of 'slalom simulate'";
  command->add_option("A", options->first, folder)->required()->type_name("DIR");
  command->add_option("B", options->second, folder)->required()->type_name("DIR");
  command->add_option("--out", options->out, "The page")->type_name("FILE")->capture_default_str();
  command->add_flag("--force", options->force, "Replace a file that stands there already");
  command->footer(
      std::string("The drives may be of different scenarios: the page says what differs.\n"
                  "Example: slalom compare drives/P_D drives/P_E --out P_D-P_E.html\n\n") +
      kExitCodeHelp);
  command->callback([options, &run] { run = [options] { return compare(*options); }; });
}

}  // namespace slalom::app
