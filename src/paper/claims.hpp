#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "../io/document.hpp"
#include "evaluate.hpp"
#include "judged.hpp"

namespace slalom::paper {

/// Text with formulas in braces, each with a format: "P_A {time(E_A/P_A):.1f} s". A format is one
/// of std::format's for numbers, or "ms", which shows seconds as milliseconds. Lists of three are
/// shown as an estimate with its interval in brackets, "[–]" where there is none.
class Template {
 public:
  Template() = default;
  /// Throws InvalidValue at the value's place.
  explicit Template(const io::Value& value);
  /// Throws NotDriven.
  std::string fill(const Context& context) const;

 private:
  struct Piece {
    std::string text;  ///< before the formula
    std::optional<Expression> formula;
    std::string format;
  };
  std::vector<Piece> pieces_;
};

const char* verdict_words(Verdict verdict);  ///< "holds", "holds in part", "does not hold"

/// A claim of the paper and the rule by which it is judged; config/paper/claims.yaml.
struct Claim {
  std::string id, says;
  std::string at;    ///< where the paper says it
  Template printed;  ///< the figures that it prints
  Template ours;     ///< ours, in one sentence
  std::map<std::string, Expression> names;
  std::optional<Expression> given;  ///< the claim is judged only where this holds
  std::vector<Expression> holds;    ///< it holds if all of these do
  /// Otherwise it holds in part if all of these do; without these, if one of `holds` does.
  std::vector<Expression> part;
};

/// The claims about single drives, and those about the sweep.
struct Claims {
  std::vector<Claim> drives, sweep;
};
/// Throws InvalidValue with file:line:column when the file is not as it should be.
Claims load_claims();

/// A claim that is not judged, and what it asks for that was not driven.
struct LeftOut {
  std::string id, asks_for;
};

/// The claims in their order. Those that ask for what was not driven are left out, and added to
/// `left_out`; where the evidence is whole there is no such thing: InvalidValue.
std::vector<Judged> judge(const std::vector<Claim>& claims, const Evidence& evidence,
                          std::vector<LeftOut>* left_out = nullptr);

}  // namespace slalom::paper
