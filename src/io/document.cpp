#include "document.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <sstream>
#include <unordered_set>

#include "text_file.hpp"

namespace slalom::io {
namespace {

/// Builds the tree from the parser's events. Events rather than YAML::Node, because nodes neither
/// keep the places of keys nor notice doubled keys, and expand aliases.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(std::string source, bool with_lines)
      : source_(std::move(source)), with_lines_(with_lines) {
    // What an empty document leaves.
    root_.place = {source_, with_lines_ ? 1 : 0, with_lines_ ? 1 : 0};
  }

  Value take() { return std::move(root_); }
  bool started() const { return started_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (started_)
      throw InvalidValue(at(mark).to_string(), "a second YAML document", "one document a file");
    started_ = true;
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override {
    leaf(mark, Value::Kind::null, "");
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw InvalidValue(at(mark).to_string(), "a YAML alias", "the value itself");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                const std::string& text) override {
    leaf(mark, Value::Kind::scalar, text, tag == "!");
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    open(mark, Value::Kind::sequence);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    open(mark, Value::Kind::map);
  }
  void OnMapEnd() override { close(); }

 private:
  /// A collection being read, and the key that waits for its value if it is a map.
  struct Frame {
    Value value;
    bool has_key = false;
    std::string key;
    Place key_place;
    std::unordered_set<std::string> keys;
  };

  Place at(const YAML::Mark& mark) const {
    if (!with_lines_) return {source_, 0, 0};
    return {source_, mark.line + 1, mark.column + 1};
  }

  Value make(const YAML::Mark& mark, Value::Kind kind) {
    if (++nodes_ > kMaxNodes)
      throw InvalidValue(at(mark).to_string(), fmt::format("more than {} values", kMaxNodes),
                         "a configuration file");
    Value value;
    value.kind = kind;
    value.place = at(mark);
    return value;
  }

  void leaf(const YAML::Mark& mark, Value::Kind kind, const std::string& text,
            bool quoted = false) {
    if (!stack_.empty() && stack_.back().value.kind == Value::Kind::map && !stack_.back().has_key) {
      if (kind != Value::Kind::scalar)
        throw InvalidValue(at(mark).to_string(), "an empty key", "a key before ':'");
      return begin_member(mark, text);
    }
    Value value = make(mark, kind);
    value.text = text;
    value.quoted = quoted;
    add(std::move(value));
  }

  void begin_member(const YAML::Mark& mark, const std::string& key) {
    Frame& frame = stack_.back();
    if (!frame.keys.insert(key).second) {
      const auto first = std::find_if(frame.value.members.begin(), frame.value.members.end(),
                                      [&](const Member& member) { return member.key == key; });
      throw InvalidValue(at(mark).to_string(), fmt::format("key '{}' a second time", key),
                         fmt::format("each key once (first at line {})", first->place.line));
    }
    frame.has_key = true;
    frame.key = key;
    frame.key_place = at(mark);
  }

  void open(const YAML::Mark& mark, Value::Kind kind) {
    if (stack_.size() >= kMaxDepth)
      throw InvalidValue(at(mark).to_string(), fmt::format("nesting deeper than {}", kMaxDepth),
                         "a configuration file");
    if (!stack_.empty() && stack_.back().value.kind == Value::Kind::map && !stack_.back().has_key)
      throw InvalidValue(at(mark).to_string(), "a list or map where a key belongs",
                         "a name (is a bracket left open?)");
    stack_.push_back({make(mark, kind), false, "", {}, {}});
  }

  void close() {
    Value value = std::move(stack_.back().value);
    stack_.pop_back();
    add(std::move(value));
  }

  void add(Value value) {
    if (stack_.empty()) {
      root_ = std::move(value);
      return;
    }
    Frame& frame = stack_.back();
    if (frame.value.kind == Value::Kind::sequence) {
      frame.value.items.push_back(std::move(value));
    } else {
      frame.value.members.push_back({frame.key, frame.key_place, std::move(value)});
      frame.has_key = false;
    }
  }

  std::string source_;
  bool with_lines_;
  bool started_ = false;
  std::size_t nodes_ = 0;
  std::vector<Frame> stack_;
  Value root_;
};

Value parse(const std::string& text, const std::string& source, bool with_lines) {
  TreeBuilder builder(source, with_lines);
  std::istringstream stream(text);
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    Place place{source, 0, 0};
    if (with_lines) {
      place.line = std::max(0, error.mark.line) + 1;
      place.column = std::max(0, error.mark.column) + 1;
    }
    throw InvalidValue(place.to_string(), fmt::format("a YAML error ({})", error.msg),
                       "valid YAML");
  }
  return builder.take();
}

}  // namespace

std::string Place::to_string() const {
  return line > 0 ? fmt::format("{}:{}:{}", source, line, column) : source;
}

const Value* Value::find(const std::string& key) const {
  for (const auto& member : members)
    if (member.key == key) return &member.value;
  return nullptr;
}

std::string Value::describe() const {
  switch (kind) {
    case Kind::null:
      return "nothing";
    case Kind::scalar:
      return fmt::format("'{}'", text.size() > 60 ? text.substr(0, 57) + "..." : text);
    case Kind::sequence:
      return "a list";
    case Kind::map:
      return "a map";
  }
  return "nothing";
}

Value parse_text(const std::string& text, const std::string& source, const std::string& content) {
  check_text(text, source, content);
  Value root = parse(text, source, true);
  if (root.kind == Value::Kind::null)
    throw InvalidValue(Place{source, 1, 1}.to_string(), "an empty file", content);
  return root;
}

Value parse_file(const std::filesystem::path& file, const std::string& content) {
  return parse_text(read_file(file, kMaxDocumentBytes, content), file.string(), content);
}

Value parse_argument(const std::string& text, const std::string& source) {
  check_text(text, source, "text");
  Value root = parse(text, source, false);
  return root;
}

}  // namespace slalom::io
