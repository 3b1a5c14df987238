#pragma once

#include <string>
#include <vector>

#include "../io/section.hpp"

namespace slalom::paper {

/// The map in a file of the built-in config/paper. Throws InvalidValue for a file that holds none
/// and for members other than `known`.
io::Value read_map(const std::string& file, const std::vector<std::string>& known);

/// The notes of such a map: what a reader must know of a table (`topic`, `text`).
template <class Note>
std::vector<Note> read_notes(const io::Value& root) {
  static const auto table = [] {
    OptionTable<Note> t;
    t.text("topic", &Note::topic, "Table of the page.").text("text", &Note::text, "What to know.");
    return t;
  }();
  const io::Value* list = root.find("notes");
  return list == nullptr ? std::vector<Note>{} : io::read_list(*list, "notes", table);
}

}  // namespace slalom::paper
