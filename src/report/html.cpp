#include "html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "slalom/base/error.hpp"

namespace slalom::report {
namespace {

std::string with_minus_sign(std::string text) {
  const bool zero = text.find_first_of("123456789") == std::string::npos;
  if (!text.empty() && text.front() == '-') text = zero ? text.substr(1) : "−" + text.substr(1);
  return text;
}

bool letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

std::string percent_encoded(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (letter_or_digit(c) || std::string_view("/-_.~#=").find(c) != std::string_view::npos)
      out += c;
    else
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

}  // namespace

std::string escape(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t') out += c;
    }
  }
  return out;
}

std::string script_json(const nlohmann::ordered_json& json) {
  const auto text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

std::string fill(std::string_view page,
                 const std::vector<std::pair<std::string_view, std::string>>& values) {
  std::string out;
  for (std::size_t at = 0;;) {
    const auto open = page.find("{{", at);
    const auto close = open == page.npos ? page.npos : page.find("}}", open);
    if (close == page.npos) return out.append(page.substr(at));
    const auto name = page.substr(open + 2, close - open - 2);
    const auto found =
        std::find_if(values.begin(), values.end(), [&](const auto& v) { return v.first == name; });
    if (found == values.end()) throw Error(fmt::format("page template: no value for '{}'", name));
    out.append(page.substr(at, open - at)).append(found->second);
    at = close + 2;
  }
}

std::string number(double value, int digits) {
  return std::isfinite(value) ? with_minus_sign(fmt::format("{:.{}f}", value, digits)) : "–";
}

std::string significant(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return "0";
  const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(value))));
  if (magnitude < -7 || magnitude > 7)
    return with_minus_sign(fmt::format("{:.{}e}", value, digits - 1));
  return number(value, std::max(0, digits - 1 - magnitude));
}

std::string link(std::string_view target, std::string_view text) {
  return fmt::format("<a href=\"{}\">{}</a>", percent_encoded(target), escape(text));
}

std::string plain_name(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (!letter_or_digit(c) && c != '.' && c != '-' && c != '_') c = '_';
  return out;
}

}  // namespace slalom::report
