#pragma once

#include "slalom/base/options.hpp"
#include "slalom/sweep/study.hpp"

namespace slalom::sweep {

/// The plain keys of a study file.
const OptionTable<StudySettings>& study_options();

}  // namespace slalom::sweep
