#include "semantic_check.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <string_view>
#include <tuple>

namespace slalom::io {
namespace {

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Position of `word` in `text` as a word of its own, or npos.
std::size_t find_word(const std::string& text, const std::string& word) {
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const auto end = at + word.size();
    if ((at == 0 || !is_word(text[at - 1])) && (end == text.size() || !is_word(text[end])))
      return at;
  }
  return std::string::npos;
}

/// How near a place is to the user: the command line, then the scenario, then a file it names.
int rank_of(const Place& place, const std::string& file) {
  if (place.line == 0) return 0;
  return place.source == file ? 1 : 2;
}

/// The place of a key that `text` names: the longest whole path; else, of bare keys, the one
/// nearest to the user, for a contradiction of two is more likely the fault of the one just
/// overridden.
const Place* place_of(const std::string& text, const std::string& file, const Places& places) {
  const Place* best = nullptr;
  std::tuple<std::size_t, int, std::size_t> best_order;
  for (const auto& [path, place] : places) {
    auto whole = path, last = path.substr(path.rfind('.') + 1);
    if (last.ends_with("_deg") && find_word(text, last) == std::string::npos) {
      whole.resize(whole.size() - 4);
      last.resize(last.size() - 4);
    }
    // A bare letter ("x", "a") is as likely an article or a unit as a key.
    auto at = find_word(text, whole);
    const bool bare = at == std::string::npos;
    if (bare && last.size() > 1) at = find_word(text, last);
    if (at == std::string::npos) continue;
    const std::tuple order(bare ? SIZE_MAX : SIZE_MAX - whole.size(), rank_of(place, file), at);
    if (best == nullptr || order < best_order) {
      best = &place;
      best_order = order;
    }
  }
  return best;
}

/// What the check names after the file: "start x", "region", "obstacle O2 a", or nothing.
std::string subject_of(const InvalidValue& error, const std::string& file) {
  const auto prefix = file + ": ";
  return error.where().starts_with(prefix) ? error.where().substr(prefix.size()) : "";
}

/// The path of such a subject: "start.x", "obstacles.O2.a".
std::string path_of(std::string subject) {
  std::replace(subject.begin(), subject.end(), ' ', '.');
  constexpr std::string_view kOne = "obstacle.";
  if (subject.starts_with(kOne)) return "obstacles." + subject.substr(kOne.size());
  return subject;
}

}  // namespace

void check_scenario(const sim::Scenario& scenario, const std::string& file, const Places& places) {
  try {
    sim::check(scenario, file);
  } catch (const InvalidValue& error) {
    const auto subject = subject_of(error, file);
    const auto text = path_of(subject) + " " + error.found() + " " + error.expected();
    const Place* place = place_of(text, file, places);
    // "start x" is a value, "start" or "region" a whole section.
    const auto* joint = subject.find(' ') != std::string::npos ? " = " : ": ";
    throw InvalidValue(place != nullptr ? place->to_string() : file + ":1:1",
                       subject.empty() ? error.found() : subject + joint + error.found(),
                       error.expected());
  }
}

}  // namespace slalom::io
