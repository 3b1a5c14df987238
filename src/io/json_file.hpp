#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "slalom/nlp/solver.hpp"

namespace slalom::io {

using Json = nlohmann::ordered_json;

/// JSON has no numbers that are not finite: they are text.
Json json_number(double value);
Json json_numbers(const std::vector<double>& list);
template <class Row>
Json json_table(const std::vector<Row>& rows) {
  Json json = Json::array();
  for (const auto& row : rows) json.push_back(json_numbers({row.begin(), row.end()}));
  return json;
}
Json json_point(const nlp::Start& point);
Json json_options(const nlp::Options& options);

/// The parts of a file, with messages that name file and key. `content` says what the file is.
class JsonReader {
 public:
  JsonReader(std::string file, std::string content, const Json& json, std::string path = "");

  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const;
  bool has(const std::string& key) const { return json_.is_object() && json_.contains(key); }
  JsonReader at(const std::string& key) const;
  JsonReader at(std::size_t index) const;
  std::size_t size() const;  ///< of a list

  /// What `read` makes of each item of a list.
  template <class Read>
  auto each(Read read) const {
    std::vector<std::invoke_result_t<Read, JsonReader>> list;
    for (std::size_t i = 0; i < size(); ++i) list.push_back(read(at(i)));
    return list;
  }

  double real() const;
  int whole() const;
  std::size_t count() const;  ///< an integer >= 0
  bool flag() const;
  std::string text() const;
  std::vector<double> list() const;
  /// `width` numbers a row.
  std::vector<std::vector<double>> table(std::size_t width) const;
  std::vector<std::string> texts() const;
  std::vector<std::size_t> counts() const;
  nlp::Start point() const;
  nlp::Options options() const;
  /// The value of an enum whose values from 0 to `last` to_string names.
  template <class E>
  E one_of(E last) const {
    std::string names;
    for (int i = 0; i <= static_cast<int>(last); ++i) {
      const auto each = static_cast<E>(i);
      if (json_ == to_string(each)) return each;
      names += (i > 0 ? ", " : "") + std::string(to_string(each));
    }
    refuse(shown(), "one of " + names);
  }
  std::string where() const { return path_.empty() ? file_ : file_ + ": " + path_; }

 private:
  std::string shown() const;

  std::string file_, content_, path_;
  const Json& json_;
};

/// The JSON of a file of at most `max_bytes`, whose `format` must be one of those given. Throws
/// InvalidValue.
Json read_json(const std::string& file, std::size_t max_bytes, const std::string& content,
               const std::vector<std::string>& formats);

}  // namespace slalom::io
