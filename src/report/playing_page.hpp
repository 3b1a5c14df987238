#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace slalom::report {

/// What differs between the page of one drive and that of two.
struct PlayingPage {
  std::string title;            ///< text
  std::string head, settings;   ///< HTML; the page's script fills both for two drives
  nlohmann::ordered_json data;  ///< drive_data() of one drive, or an array of two
};

/// The page on which drives play.
std::string playing_page(const PlayingPage& page);

}  // namespace slalom::report
