#include "expression.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cstdlib>
#include <utility>

#include "slalom/base/error.hpp"

namespace slalom::paper {
namespace {

bool letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool word_part(char c) {
  return letter(c) || std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// The tokens of a formula, one after the other.
class Tokens {
 public:
  Tokens(const std::string& text, std::string where) : text_(text), where_(std::move(where)) {
    next();
  }

  const std::string& token() const { return token_; }
  bool at_end() const { return token_.empty(); }
  bool take(const std::string& wanted) {
    if (token_ != wanted) return false;
    next();
    return true;
  }
  void expect(const std::string& wanted) {
    if (!take(wanted)) refuse("'" + wanted + "'");
  }
  std::string word() {
    auto found = token_;
    next();
    return found;
  }
  [[noreturn]] void refuse(const std::string& expected) const {
    throw InvalidValue(where_, at_end() ? "the end of '" + text_ + "'" : "'" + token_ + "'",
                       expected);
  }

 private:
  void next() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    const auto start = at_;
    if (start == text_.size()) {
      token_.clear();
      return;
    }
    const char c = text_[at_];
    if (letter(c))
      skip_word();
    else if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.')
      skip_number();
    else
      at_ += std::string("<>=!").find(c) != std::string::npos && text_[at_ + 1] == '=' ? 2 : 1;
    token_ = text_.substr(start, at_ - start);
  }
  void skip_word() {
    while (word_part(text_[at_]) || (std::string("/-.").find(text_[at_]) != std::string::npos &&
                                     at_ + 1 < text_.size() && word_part(text_[at_ + 1])))
      if (++at_ == text_.size()) return;
  }
  void skip_number() {
    char* end = nullptr;
    std::strtod(text_.c_str() + at_, &end);
    at_ = std::max<std::size_t>(static_cast<std::size_t>(end - text_.c_str()), at_ + 1);
  }

  const std::string text_;
  std::string where_, token_;
  std::size_t at_ = 0;
};

Expression operation(std::string name, std::vector<Expression> parts) {
  return {Expression::Kind::operation, 0, std::move(name), std::move(parts)};
}

/// From loosest to tightest; `not` stands between the second and the third.
const std::array<std::vector<std::string>, 5> kOperators = {
    {{"or"}, {"and"}, {"<", "<=", ">", ">=", "==", "!="}, {"+", "-"}, {"*", "/"}}};
constexpr std::size_t kComparison = 2;

Expression binary(Tokens& tokens, std::size_t level);

Expression call(Tokens& tokens, const std::string& name) {
  Expression result{Expression::Kind::call, 0, name, {}};
  if (tokens.take(")")) return result;
  do result.parts.push_back(binary(tokens, 0));
  while (tokens.take(","));
  tokens.expect(")");
  return result;
}

Expression atom(Tokens& tokens) {
  if (tokens.take("(")) {
    auto inner = binary(tokens, 0);
    tokens.expect(")");
    return inner;
  }
  if (tokens.take("-")) return operation("negate", {atom(tokens)});
  if (tokens.at_end()) tokens.refuse("a number, a word or a measure");
  const char c = tokens.token().front();
  if (letter(c)) {
    const auto name = tokens.word();
    if (tokens.take("(")) return call(tokens, name);
    return {Expression::Kind::word, 0, name, {}};
  }
  char* end = nullptr;
  const double value = std::strtod(tokens.token().c_str(), &end);
  if (*end != '\0') tokens.refuse("a number, a word or a measure");
  tokens.word();
  return {Expression::Kind::number, value, "", {}};
}

Expression binary(Tokens& tokens, std::size_t level) {
  if (level == kOperators.size()) return atom(tokens);
  if (level == kComparison && tokens.take("not")) return operation("not", {binary(tokens, level)});
  auto left = binary(tokens, level + 1);
  for (bool more = true; more;) {
    more = false;
    for (const auto& name : kOperators[level])
      if (!more && tokens.take(name)) {
        left = operation(name, {std::move(left), binary(tokens, level + 1)});
        more = true;
      }
  }
  return left;
}

}  // namespace

Expression parse_expression(const std::string& text, const std::string& where) {
  Tokens tokens(text, where);
  auto expression = binary(tokens, 0);
  if (!tokens.at_end()) tokens.refuse("an operator or the end");
  return expression;
}

}  // namespace slalom::paper
