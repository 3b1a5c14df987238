#pragma once

#include "slalom/base/error.hpp"

namespace slalom::app {

/// What the program returns; kExitCodeHelp says the same to the user.
enum ExitCode : int {
  kOk = 0,
  kNotExpected = 1,
  kBadInput = 2,
  kNotWritten = 3,
  kInternal = 4,
  kInterrupted = 130,
};

inline constexpr const char* kExitCodeHelp =
    "Exit codes:\n"
    "  0    done; with --expect, the outcome is an expected one\n"
    "  1    the outcome is none of those expected; of replay, problems: the answers differ\n"
    "  2    bad input or usage: the message says where, what was found and what was expected\n"
    "  3    output could not be written, or stands already and --force is not given\n"
    "  4    internal error\n"
    "  130  interrupted, or a sweep's processes were killed; what was driven is written and valid\n"
    "Without --expect, a drive that ends in a crash is a result like any other: 0.\n";

/// Output that could not be written; ends the program with kNotWritten.
class OutputError : public Error {
 public:
  using Error::Error;
};

}  // namespace slalom::app
