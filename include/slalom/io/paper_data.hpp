#pragma once

#include "slalom/study/reproduction.hpp"

namespace slalom::io {

/// Reads what the paper printed from the built-in config/paper. Throws InvalidValue with
/// file:line:column when a file there is not as it should be.
study::PaperData load_paper_data();

}  // namespace slalom::io
