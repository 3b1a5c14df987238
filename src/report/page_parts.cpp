#include "page_parts.hpp"

#include <fmt/format.h>

#include <map>

#include "html.hpp"

namespace slalom::report {
namespace {

/// The document without its XML declaration.
std::string plain_svg(const std::string& document) {
  const auto start = document.find("<svg");
  return start == document.npos ? document : document.substr(start);
}

}  // namespace

std::string cell(const std::string& html, const char* kind) {
  return fmt::format("<td class=\"{}\">{}</td>", kind, html);
}

std::string head_cells(const std::vector<std::string>& names) {
  std::string html = "<tr>";
  for (const auto& name : names)
    html += fmt::format("<th scope=\"col\"{}>{}</th>",
                        &name == &names.front() ? "" : " class=\"num\"", name);
  return html + "</tr>";
}

std::string row_head(const std::string& text) {
  return "<tr><th scope=\"row\">" + escape(text) + "</th>";
}

std::string table(const std::string& head, const std::string& rows) {
  return fmt::format(
      "<div class=\"scroll\"><table>\n<thead>{}</thead>\n<tbody>\n{}</tbody></table></div>\n", head,
      rows);
}

std::string figure_html(const Figure& figure) {
  return fmt::format("<figure class=\"figure card\">\n{}<figcaption>{} {}</figcaption></figure>\n",
                     plain_svg(figure.svg), escape(figure.caption),
                     link("figures/" + figure.file, "SVG"));
}

Stroke planner_stroke(const std::string& planner) {
  static const std::map<std::string, Stroke> strokes = {{"P_A", {colours::ink, 1, "", 1}},
                                                        {"P_B", {colours::green, 2, "", 1}},
                                                        {"P_C", {colours::vermilion, 1, "4 2", 1}},
                                                        {"P_D", {colours::blue, 1, "", 1}}};
  const auto found = strokes.find(planner);
  return found == strokes.end() ? Stroke{colours::purple, 1, "", 1} : found->second;
}

}  // namespace slalom::report
