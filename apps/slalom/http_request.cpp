#include "http_request.hpp"

#include <algorithm>
#include <utility>

namespace slalom::app {
namespace {

/// A character of a token (RFC 9110, section 5.6.2).
bool is_token(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
}

bool is_visible(char c) {
  return c > ' ' && c <= '~';
}

bool is_space(char c) {
  return c == ' ' || c == '\t';
}

template <class F>
bool all(std::string_view text, const F& holds) {
  return !text.empty() && std::all_of(text.begin(), text.end(), holds);
}

/// The text up to `mark`, which is taken away with it; nothing where there is no mark.
std::optional<std::string_view> cut(std::string_view& text, std::string_view mark) {
  const auto end = text.find(mark);
  if (end == std::string_view::npos) return std::nullopt;
  const auto first = text.substr(0, end);
  text.remove_prefix(end + mark.size());
  return first;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

std::string in_lower_case(std::string_view text) {
  std::string lower(text);
  for (auto& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

bool read_first_line(std::string_view line, HttpRequest& request) {
  const auto method = cut(line, " ");
  const auto target = cut(line, " ");
  if (!method || !target || !all(*method, is_token) || !all(*target, is_visible)) return false;
  request.method = *method;
  request.target = *target;
  return line == "HTTP/1.1" || line == "HTTP/1.0";
}

bool read_header(std::string_view line, HttpRequest& request) {
  const auto name = cut(line, ":");
  if (!name || !all(*name, is_token)) return false;
  const auto value = trimmed(line);
  const auto is_text = [](char c) { return is_space(c) || is_visible(c); };
  if (!value.empty() && !all(value, is_text)) return false;
  const auto [place, is_new] = request.headers.emplace(in_lower_case(*name), value);
  if (!is_new) (place->second += ", ") += value;
  return true;
}

}  // namespace

std::string HttpRequest::header(const std::string& name) const {
  const auto found = headers.find(name);
  return found == headers.end() ? "" : found->second;
}

bool HttpRequest::has_content() const {
  const auto length = header("content-length");
  return headers.count("transfer-encoding") > 0 || !(length.empty() || length == "0");
}

std::optional<HttpRequest> parse_http_request(std::string_view head) {
  HttpRequest request;
  bool first = true;
  while (!head.empty()) {
    auto line = cut(head, "\r\n");
    if (!line) line = std::exchange(head, {});
    if (!(first ? read_first_line(*line, request) : read_header(*line, request)))
      return std::nullopt;
    first = false;
  }
  if (first) return std::nullopt;
  return request;
}

}  // namespace slalom::app
