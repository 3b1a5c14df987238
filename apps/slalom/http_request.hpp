#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace slalom::app {

/// The head of an HTTP/1 request (RFC 9112).
struct HttpRequest {
  std::string method;  ///< "GET", ...
  std::string target;  ///< as it stands there: "/index.html?a=b"
  /// By name in lower case; of one that comes several times, all values, joined by ", ".
  std::map<std::string, std::string> headers;

  /// The header's value; empty where it is missing.
  std::string header(const std::string& name) const;
  /// Whether content follows the head.
  bool has_content() const;
};

/// Reads a head without the empty line at its end; nothing where it is malformed.
std::optional<HttpRequest> parse_http_request(std::string_view head);

}  // namespace slalom::app
