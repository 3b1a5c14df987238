#include "claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../io/section.hpp"
#include "paper_files.hpp"
#include "slalom/base/error.hpp"

namespace slalom::paper {
namespace {

std::string shown(double value, const std::string& format) {
  if (!std::isfinite(value)) return "–";
  if (format == "ms") return fmt::format("{:.3g}", 1e3 * value);
  auto text = fmt::format(fmt::runtime("{:" + format + "}"), value);
  // What rounds to nothing has no sign.
  const bool nothing = text.find_first_of("123456789") == std::string::npos;
  if (nothing && (text.front() == '-' || text.front() == '+')) text.erase(0, 1);
  return text;
}

std::string shown(const Value& value, const std::string& format) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* one = std::get_if<double>(&value)) return shown(*one, format);
  const auto& list = std::get<Numbers>(value);
  if (list.size() != 3)
    throw InvalidValue("a text", fmt::format("a list of {}", list.size()), "an interval");
  const auto estimate = shown(list[0], format);
  if (std::isnan(list[1]) && std::isnan(list[2])) return estimate + " [–]";
  return fmt::format("{} [{}, {}]", estimate, shown(list[1], format), shown(list[2], format));
}

Expression read_formula(const io::Value& value) {
  const auto where = value.place.to_string();
  auto formula = parse_expression(io::to_text(value, "a formula"), where);
  check_names(formula, where);
  return formula;
}

std::vector<Expression> read_formulas(const io::Value& list) {
  std::vector<Expression> formulas;
  for (const auto& item : io::items_of(list, "a list of formulas"))
    formulas.push_back(read_formula(item));
  return formulas;
}

const OptionTable<Claim>& claim_options() {
  static const auto table = [] {
    OptionTable<Claim> t;
    t.text("claim", &Claim::id, "Its name.")
        .text("says", &Claim::says, "What the paper says.")
        .text("at", &Claim::at, "Where it does.");
    return t;
  }();
  return table;
}

/// Formulas by name, added to those that are there already.
void read_names(const io::Value* names, std::map<std::string, Expression>& into) {
  if (names == nullptr) return;
  io::require_map(*names, "names of formulas (a map)");
  for (const auto& member : names->members)
    into.insert_or_assign(member.key, read_formula(member.value));
}

Claim read_claim(const io::Value& map, const std::map<std::string, Expression>& of_all) {
  Claim claim;
  io::Places places;
  io::Section("claims")
      .add(claim_options(), claim)
      .read(map, places, {"printed", "ours", "names", "given", "holds", "part"});
  for (const char* key : {"claim", "says", "printed", "ours", "holds"})
    if (map.find(key) == nullptr)
      throw InvalidValue(map.place.to_string(), "a claim without " + std::string(key), "one");
  claim.printed = Template(*map.find("printed"));
  claim.ours = Template(*map.find("ours"));
  claim.holds = read_formulas(*map.find("holds"));
  if (const auto* part = map.find("part")) claim.part = read_formulas(*part);
  if (const auto* given = map.find("given")) claim.given = read_formula(*given);
  claim.names = of_all;
  read_names(map.find("names"), claim.names);
  return claim;
}

std::vector<Claim> read_claims(const io::Value* list,
                               const std::map<std::string, Expression>& of_all) {
  std::vector<Claim> claims;
  if (list == nullptr) return claims;
  for (const auto& item : io::items_of(*list, "a list of claims"))
    claims.push_back(read_claim(item, of_all));
  return claims;
}

Verdict verdict(const Claim& claim, const Context& context) {
  const auto is_so = [&](const Expression& check) { return number_of(check, context) != 0; };
  const auto all = [&](const auto& list) { return std::all_of(list.begin(), list.end(), is_so); };
  if (all(claim.holds)) return Verdict::holds;
  const bool part = claim.part.empty() ? std::any_of(claim.holds.begin(), claim.holds.end(), is_so)
                                       : all(claim.part);
  return part ? Verdict::in_part : Verdict::fails;
}

}  // namespace

Template::Template(const io::Value& value) {
  const auto text = io::to_text(value, "a text");
  const auto where = value.place.to_string();
  for (std::size_t at = 0; at < text.size();) {
    const auto open = text.find('{', at);
    Piece piece{text.substr(at, open - at), {}, ""};
    at = text.size();
    if (open != std::string::npos) {
      const auto close = text.find('}', open);
      if (close == std::string::npos) throw InvalidValue(where, "'{' without '}'", "both");
      auto formula = text.substr(open + 1, close - open - 1);
      if (const auto colon = formula.rfind(':'); colon != std::string::npos) {
        piece.format = formula.substr(colon + 1);
        formula.erase(colon);
      }
      piece.formula = parse_expression(formula, where);
      check_names(*piece.formula, where);
      at = close + 1;
    }
    pieces_.push_back(std::move(piece));
  }
}

std::string Template::fill(const Context& context) const {
  std::string text;
  for (const auto& piece : pieces_) {
    text += piece.text;
    if (piece.formula) text += shown(evaluate(*piece.formula, context), piece.format);
  }
  return text;
}

const char* verdict_words(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "holds";
    case Verdict::in_part:
      return "holds in part";
    case Verdict::fails:
      break;
  }
  return "does not hold";
}

Claims load_claims() {
  const io::Value root = read_map("claims.yaml", {"drives", "sweep", "names"});
  std::map<std::string, Expression> names;
  read_names(root.find("names"), names);
  return {read_claims(root.find("drives"), names), read_claims(root.find("sweep"), names)};
}

std::vector<Judged> judge(const std::vector<Claim>& claims, const Evidence& evidence,
                          std::vector<LeftOut>* left_out) {
  std::vector<Judged> list;
  for (const auto& claim : claims) {
    const Context context{&evidence, &claim.names, evidence.trials, nullptr};
    try {
      if (claim.given && number_of(*claim.given, context) == 0) continue;
      list.push_back({claim.id, claim.says, claim.at, claim.printed.fill(context),
                      claim.ours.fill(context), verdict(claim, context)});
    } catch (const NotDriven& missing) {  // then there is nothing to judge it by
      if (evidence.whole)
        throw InvalidValue("claim " + claim.id, "'" + missing.what + "'", "what is driven");
      if (left_out != nullptr) left_out->push_back({claim.id, missing.what});
    } catch (const InvalidValue& wrong) {
      throw InvalidValue("claim " + claim.id + ", " + wrong.where(), wrong.found(),
                         wrong.expected());
    }
  }
  return list;
}

}  // namespace slalom::paper
