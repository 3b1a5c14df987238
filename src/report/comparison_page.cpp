#include <fmt/format.h>

#include <string_view>

#include "drive_data.hpp"
#include "playing_page.hpp"
#include "slalom/base/error.hpp"
#include "slalom/report/report.hpp"

namespace slalom::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto replace = Json::error_handler_t::replace;
constexpr const char* kExpected = "the report.html of 'slalom simulate'";

std::string name_of(const Json& drive) {
  return fmt::format("{} with {}", drive["scenario"].get<std::string>(),
                     drive["planner"]["name"].get<std::string>());
}

/// The element of a page that has its data; a page has "</script" only where an element ends.
std::string_view data_text(const NamedPage& page) {
  constexpr std::string_view open = R"(<script type="application/json" id="drive-data">)";
  const std::string_view html = page.html;
  const auto at = html.find(open);
  if (at == html.npos) throw InvalidValue(page.name, "no drive", kExpected);
  const auto from = at + open.size();
  return html.substr(from, html.find("</script", from) - from);
}

/// The drive on a page. Throws InvalidValue naming the page when there is none, or not one that
/// this program understands.
Json read_drive(const NamedPage& page) {
  const Json data = Json::parse(data_text(page), nullptr, false);
  if (data.is_array())
    throw InvalidValue(page.name, fmt::format("{} drives", data.size()), "the page of one");
  if (!data.is_object()) throw InvalidValue(page.name, "a drive that is damaged", kExpected);
  const auto format = data.find("format");
  if (format == data.end() || *format != kDriveFormat)
    throw InvalidValue(page.name + ": format",
                       format == data.end() ? "none" : format->dump(-1, ' ', false, replace),
                       fmt::format("\"{}\"", kDriveFormat));
  if (data.at("plant").at("t").empty())
    throw InvalidValue(page.name, "a drive in which nothing was driven", "one with an instant");
  return data;
}

}  // namespace

std::string comparison_page(const NamedPage& first, const NamedPage& second) {
  auto drives = Json::array({read_drive(first), read_drive(second)});
  const auto title = fmt::format("{} · {} · compared", name_of(drives[0]), name_of(drives[1]));
  return playing_page({title, "", "", std::move(drives)});
}

}  // namespace slalom::report
