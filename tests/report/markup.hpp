#pragma once

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace slalom::report::testing {

/// The document as a tree; throws when it is not well-formed XML.
inline boost::property_tree::ptree parse_xml(const std::string& text) {
  std::istringstream stream(text);
  boost::property_tree::ptree tree;
  boost::property_tree::read_xml(stream, tree);
  return tree;
}

/// The data that the page of a drive carries, found as a browser finds it: up to the first
/// "</script".
inline nlohmann::json page_data(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"drive-data\">";
  const auto at = page.find(open) + open.size();
  return nlohmann::json::parse(page.substr(at, page.find("</script", at) - at));
}

/// How often `what` occurs.
inline int count(const std::string& text, const std::string& what) {
  int n = 0;
  for (auto at = text.find(what); at != text.npos; at = text.find(what, at + what.size())) ++n;
  return n;
}

}  // namespace slalom::report::testing
