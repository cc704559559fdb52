#include "host/formats/files/yaml_scalars.hpp"

#include <yaml.h>

#include <new>

#include "host/base/error.hpp"

namespace astro::bag {
namespace {

constexpr std::size_t kMostLevels = 64;
constexpr std::size_t kMostBytes = std::size_t{16} << 20;

class Parser {
 public:
  explicit Parser(std::string_view text) {
    if (yaml_parser_initialize(&parser_) == 0) throw std::bad_alloc();
    yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text.data()), text.size());
  }
  ~Parser() {
    yaml_event_delete(&event_);
    yaml_parser_delete(&parser_);
  }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;

  /// Null if the text is no YAML.
  const yaml_event_t* next() {
    yaml_event_delete(&event_);
    return yaml_parser_parse(&parser_, &event_) == 0 ? nullptr : &event_;
  }
  int line() const { return static_cast<int>(parser_.problem_mark.line) + 1; }
  std::string problem() const { return parser_.problem == nullptr ? "unknown" : parser_.problem; }

 private:
  yaml_parser_t parser_{};
  yaml_event_t event_{};
};

struct Level {
  bool is_map = false;
  bool key_next = false;      // of a map
  std::size_t index = 0;      // of a list
  std::size_t path_size = 0;  // of the path that leads here
};

class Walker {
 public:
  Walker(std::string_view text, std::string_view name) : parser_(text), name_(name) {}

  std::vector<YamlScalar> walk() {
    while (true) {
      const yaml_event_t* event = parser_.next();
      if (event == nullptr)
        refuse(YamlProblem::not_yaml, parser_.line(), "this is not YAML: " + parser_.problem());
      if (event->type == YAML_STREAM_END_EVENT) return std::move(found_);
      take(*event);
    }
  }

 private:
  [[noreturn]] void refuse(YamlProblem problem, int line, const std::string& what) const {
    throw Error(std::string(name_) + ", line " + std::to_string(line) + ": " + what + ": name the right file",
                problem, {std::string(name_), std::to_string(line)});
  }

  void take(const yaml_event_t& event) {
    const int line = static_cast<int>(event.start_mark.line) + 1;
    switch (event.type) {
      case YAML_SCALAR_EVENT:
        return scalar({reinterpret_cast<const char*>(event.data.scalar.value), event.data.scalar.length},
                      line, event.data.scalar.style != YAML_PLAIN_SCALAR_STYLE);
      case YAML_ALIAS_EVENT:
        begin_node("?");
        return end_node();
      case YAML_MAPPING_START_EVENT:
      case YAML_SEQUENCE_START_EVENT:
        return open(event.type == YAML_MAPPING_START_EVENT, line);
      case YAML_MAPPING_END_EVENT:
      case YAML_SEQUENCE_END_EVENT:
        levels_.pop_back();
        return end_node();
      default:
        return;
    }
  }

  bool at_key() const { return !levels_.empty() && levels_.back().is_map && levels_.back().key_next; }

  /// Before a node: extends the path by its key or its number.
  void begin_node(std::string_view key) {
    if (levels_.empty()) return;
    Level& level = levels_.back();
    if (level.is_map && !level.key_next) return;
    path_.resize(level.path_size);
    if (!path_.empty()) path_ += '/';
    path_ += level.is_map ? std::string(key) : std::to_string(level.index++);
  }
  void end_node() {
    if (levels_.empty()) return;
    Level& level = levels_.back();
    if (level.is_map) level.key_next = !level.key_next;
    if (!level.is_map || level.key_next) path_.resize(level.path_size);
  }

  void open(bool is_map, int line) {
    begin_node("?");  // a map or list may be a key, too
    if (levels_.size() >= kMostLevels)
      refuse(YamlProblem::nested_too_deep, line, "this nests deeper than any file of parameters");
    levels_.push_back({is_map, true, 0, path_.size()});
  }

  void scalar(std::string_view value, int line, bool quoted) {
    const bool is_key = at_key();
    begin_node(value);
    if (!is_key) {
      bytes_ += sizeof(YamlScalar) + path_.size() + value.size();
      if (bytes_ > kMostBytes)
        refuse(YamlProblem::too_many_values, line, "this file has more values than any file of parameters");
      found_.push_back({path_, std::string(value), line, quoted});
    }
    end_node();
  }

  Parser parser_;
  std::string_view name_;
  std::vector<Level> levels_;
  std::string path_;
  std::size_t bytes_ = 0;
  std::vector<YamlScalar> found_;
};

}  // namespace

std::vector<YamlScalar> yaml_scalars(std::string_view text, std::string_view name) {
  return Walker(text, name).walk();
}

}  // namespace astro::bag
