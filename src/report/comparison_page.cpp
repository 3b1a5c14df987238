#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "drive_data.hpp"
#include "playing_page.hpp"
#include "slalom/base/error.hpp"
#include "slalom/report/report.hpp"

namespace slalom::report {
namespace {

using Json = nlohmann::ordered_json;

/// Deeper than the data of any drive; what writes them again calls itself as often.
constexpr int kMostDepth = 100;

constexpr const char* kExpected = "the report.html of 'slalom simulate'";

/// A drive as its page carries it, and what it is called.
struct CarriedDrive {
  Json data;
  std::string name;
};

/// The element of a page that has its data; a page has "</script" only where an element ends.
std::string_view data_text(const NamedPage& page) {
  constexpr std::string_view open = R"(<script type="application/json" id="drive-data">)";
  const std::string_view html = page.html;
  const auto at = html.find(open);
  if (at == html.npos) throw InvalidValue(page.name, "no drive", kExpected);
  const auto from = at + open.size();
  return html.substr(from, html.find("</script", from) - from);
}

/// Throws InvalidValue naming the page unless its drive is in the format of drive_data().
void check_format(const NamedPage& page, const Json& data) {
  if (data.is_array())
    throw InvalidValue(page.name, fmt::format("{} drives", data.size()), "the page of one");
  if (!data.is_object()) throw InvalidValue(page.name, "a drive that is damaged", kExpected);
  const auto format = data.find("format");
  const bool there = format != data.end();
  if (!there || *format != kDriveFormat)
    throw InvalidValue(
        page.name + ": format",
        there ? format->dump(-1, ' ', false, Json::error_handler_t::replace) : "none",
        fmt::format("\"{}\"", kDriveFormat));
}

CarriedDrive read_drive(const NamedPage& page) {
  bool deep = false;
  const auto shallow = [&deep](int depth, Json::parse_event_t, Json&) {
    deep = deep || depth > kMostDepth;
    return depth <= kMostDepth;
  };
  CarriedDrive drive{Json::parse(data_text(page), shallow, false), ""};
  if (deep) throw InvalidValue(page.name, "a drive that is damaged", kExpected);
  check_format(page, drive.data);
  bool driven = false;
  try {
    drive.name = fmt::format("{} with {}", drive.data.at("scenario").get<std::string>(),
                             drive.data.at("planner").at("name").get<std::string>());
    driven = !drive.data.at("plant").at("t").empty();
  } catch (const Json::exception&) {
    throw InvalidValue(page.name, "a drive that is damaged", kExpected);
  }
  if (!driven)
    throw InvalidValue(page.name, "a drive in which nothing was driven", "one that moved");
  return drive;
}

}  // namespace

std::string comparison_page(const NamedPage& first, const NamedPage& second) {
  auto a = read_drive(first), b = read_drive(second);
  return playing_page({fmt::format("{} · {} · compared", a.name, b.name), "", "",
                       Json::array({std::move(a.data), std::move(b.data)})});
}

}  // namespace slalom::report
