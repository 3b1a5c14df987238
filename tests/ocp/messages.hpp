#pragma once

#include <gtest/gtest.h>

#include <string>

#include "slalom/base/error.hpp"

namespace slalom::test {

/// What `action` throws as InvalidValue; "accepted" when it throws nothing.
template <class Action>
std::string refusal(Action action) {
  try {
    action();
  } catch (const InvalidValue& e) {
    return e.what();
  }
  return "accepted";
}

}  // namespace slalom::test
