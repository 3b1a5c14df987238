#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace slalom {

/// Thrown at set-up (never from a solve): says what was found, where, and what was expected.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A value that breaks a stated rule, with the place where it stands.
class InvalidValue : public Error {
 public:
  /// `where`: a name or file:line:column; `found`: the offending value; `expected`: the rule;
  /// `keys`: of the values at fault, as far as they have keys.
  InvalidValue(std::string where, std::string found, std::string expected,
               std::vector<std::string> keys = {})
      : Error(where + ": found " + found + ", expected " + expected),
        where_(std::move(where)),
        found_(std::move(found)),
        expected_(std::move(expected)),
        keys_(std::move(keys)) {}

  const std::string& where() const { return where_; }
  const std::string& found() const { return found_; }
  const std::string& expected() const { return expected_; }
  /// Keys of the values at fault, counted from what was checked: "sigma" of a goal, "goal.sigma" of
  /// a scenario. Several where values contradict each other, the likeliest culprit first.
  const std::vector<std::string>& keys() const { return keys_; }
  /// The same, with keys that count from what holds what was checked under the name `section`.
  InvalidValue within(const std::string& section) const {
    InvalidValue outer = *this;
    for (auto& key : outer.keys_) key.insert(0, section + ".");
    return outer;
  }

 private:
  std::string where_, found_, expected_;
  std::vector<std::string> keys_;
};

/// Calls `check` of the part of a whole that has the name `section`; an InvalidValue that it throws
/// then has keys of the whole.
template <class F>
void check_within(const std::string& section, const F& check) {
  try {
    check();
  } catch (const InvalidValue& error) {
    throw error.within(section);
  }
}

}  // namespace slalom
