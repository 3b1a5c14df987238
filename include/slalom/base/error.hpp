#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace slalom {

/// Thrown at set-up (never from a solve): says what was found, where, and what was expected.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A value that breaks a stated rule, with the place where it stands.
class InvalidValue : public Error {
 public:
  /// `where`: a name or file:line:column; `found`: the offending value; `expected`: the rule.
  InvalidValue(std::string where, std::string found, std::string expected)
      : Error(where + ": found " + found + ", expected " + expected),
        where_(std::move(where)),
        found_(std::move(found)),
        expected_(std::move(expected)) {}

  const std::string& where() const { return where_; }
  const std::string& found() const { return found_; }
  const std::string& expected() const { return expected_; }

 private:
  std::string where_, found_, expected_;
};

}  // namespace slalom
