#include "host/experiment/files/toml_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "host/base/error.hpp"
#include "host/base/files.hpp"

namespace astro::experiment {
namespace {

constexpr int kMostLevels = 16;  // of brackets, and of dots within each; our own files have two

/// Walks over TOML and measures how deeply it nests, by brackets and by the dots of keys. The library's
/// tables are nested as deeply as the text, and it visits them by recursion: text that nests deeply enough
/// would exhaust the stack. Text that is no TOML gets some answer; the library refuses it.
class Nesting {
 public:
  explicit Nesting(std::string_view text) : text_(text) {}

  /// The line at which there are more than `most` levels; 0: nowhere.
  int exceeds(int most) {
    while (at_ < text_.size()) {
      step();
      if (brackets_ > most || dots_ > most) return line_;
    }
    return 0;
  }

 private:
  void step() {
    const char c = text_[at_];
    if (c == '"' || c == '\'') return skip_string(c);
    if (c == '#') return skip_to_end_of_line();
    if (c == '[' || c == '{') ++brackets_;
    if (c == ']' || c == '}') --brackets_;
    // Each of the characters in the string below ends a key; a blank does not, because blanks may stand
    // around dots.
    if (c == '.') ++dots_;
    if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) dots_ = 0;
    advance(1);
  }
  void skip_string(char quote) {
    const std::string_view three = quote == '"' ? "\"\"\"" : "\'\'\'";
    const bool multi_line = text_.substr(at_, 3) == three;
    const std::string_view end = multi_line ? three : three.substr(0, 1);
    advance(end.size());
    while (at_ < text_.size() && text_.substr(at_, end.size()) != end) {
      if (!multi_line && text_[at_] == '\n') return;  // not closed: refused by the library
      advance(quote == '"' && text_[at_] == '\\' ? 2 : 1);
    }
    advance(end.size());
    // A text in three quotes may end in one or two quotes of its own.
    for (int i = 0; multi_line && i < 2 && at_ < text_.size() && text_[at_] == quote; ++i) advance(1);
  }
  void skip_to_end_of_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }
  void advance(std::size_t count) {
    for (; count > 0 && at_ < text_.size(); --count, ++at_)
      if (text_[at_] == '\n') ++line_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1, brackets_ = 0, dots_ = 0;
};

constexpr std::string_view kAnnounced = " The last line is '# end'.\n", kEnd = "# end\n";

/// The announced line need not be the last one, because somebody may have added lines after it.
bool is_cut_off(std::string_view text) {
  const std::string_view first = text.substr(0, std::min(text.find('\n') + 1, text.size()));
  return first.ends_with(kAnnounced) && text.find("\n" + std::string(kEnd)) == std::string_view::npos;
}

}  // namespace

std::string toml_file(const std::string& what, const std::string& body) {
  return fmt::format("# {}{}\n{}\n{}", what, kAnnounced, body, kEnd);
}

toml::table parse_toml(const std::filesystem::path& path) {
  const Bytes bytes = load_file(path, kMaxSettingsBytes);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (const int line = Nesting(text).exceeds(kMostLevels); line > 0)
    throw Error(fmt::format("'{}' line {} nests more than {} levels deep, which no file of Astrolabe does",
                            path.string(), line, kMostLevels),
                TomlProblem::nests_too_deeply, {path.string(), std::to_string(line)});
  if (is_cut_off(text))
    throw Error(fmt::format("'{}' is cut off: its last line, '# end', is missing", path.string()),
                TomlProblem::cut_off, {path.string()});
  try {
    return toml::parse(text, path.string());
  } catch (const toml::parse_error& error) {
    const auto line = error.source().begin.line;
    throw Error(fmt::format("'{}' line {} is not TOML: {}", path.string(), line, error.description()),
                TomlProblem::not_toml, {path.string(), std::to_string(line)});
  }
}

std::string real_text(double value) {
  if (!std::isfinite(value)) return "nan";
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

}  // namespace astro::experiment
