#pragma once

namespace slalom::io {

/// The version of the project, as results and `slalom --version` state it.
inline constexpr const char* kVersion = "0.1.0";

}  // namespace slalom::io
