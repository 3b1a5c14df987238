#pragma once

#include "slalom/base/options.hpp"
#include "slalom/io/study.hpp"

namespace slalom::io {

/// The plain keys of a study file.
const OptionTable<StudySettings>& study_options();

}  // namespace slalom::io
