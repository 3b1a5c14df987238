#pragma once

#include <string>

namespace slalom::paper {

/// What a rule makes of a claim.
enum class Verdict { holds, in_part, fails };

/// A claim judged: what the paper says and where, its figures and ours, in words.
struct Judged {
  std::string id, says, at, printed, ours;
  Verdict verdict = Verdict::fails;
};

}  // namespace slalom::paper
