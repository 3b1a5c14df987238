#include "slalom/io/scenario_set.hpp"

#include <fmt/format.h>

#include "file_set.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/scenario_file.hpp"

namespace slalom::io {
namespace fs = std::filesystem;

void write_scenarios(const fs::path& folder, const std::vector<sim::Scenario>& scenarios,
                     bool force) {
  FileSet files;
  for (const auto& scenario : scenarios) {
    const auto path = folder / (scenario.name + ".yaml");
    std::error_code error;
    if (!force && fs::symlink_status(path, error).type() != fs::file_type::not_found)
      throw Error(fmt::format("{}: stands already; use --force to replace it", path.string()));
    files.add(path, to_yaml(scenario));
  }
  files.commit();
}

}  // namespace slalom::io
