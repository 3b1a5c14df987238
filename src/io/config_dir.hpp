#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "slalom/io/scenario_file.hpp"

namespace slalom::io {

/// The folder of built-in configuration: $SLALOM_CONFIG_DIR if set, else the installed one beside
/// the executable, else the source tree's. Throws Error naming what was tried when there is none.
std::filesystem::path config_dir();

/// The files of config/`folder` ("scenarios", "planners", "vehicles"), sorted by name, with the
/// `title` each states.
std::vector<BuiltIn> built_in(const std::string& folder);

/// The file behind a built-in name or a path; a relative path counts from `base` (the folder of
/// the file that names it, or the working folder). Throws InvalidValue at `where` when it is
/// neither; `what` is "scenario", "planner", "vehicle" or "study".
std::filesystem::path find_config(const std::string& what, const std::string& name_or_file,
                                  const std::filesystem::path& base, const std::string& where);

}  // namespace slalom::io
