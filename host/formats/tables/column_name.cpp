#include "host/formats/tables/column_name.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

#include "host/base/text/trimmed.hpp"

namespace astro::tables {
namespace {

constexpr std::size_t kLongestName = 200;

bool is_lower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }
bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || static_cast<unsigned char>(c) >= 0x80;
}
char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

std::vector<std::string> words_in(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_word(text[i])) continue;
    const bool goes_on = i > 0 && is_word(text[i - 1]);
    const bool hump = goes_on && is_upper(text[i]) &&
                      (is_lower(text[i - 1]) || (i + 1 < text.size() && is_lower(text[i + 1]) &&
                                                 (i + 2 >= text.size() || is_lower(text[i + 2]))));
    if (!goes_on || hump) words.emplace_back();
    words.back() += lower(text[i]);
  }
  return words;
}

/// The unit in brackets at the end, which goes; nothing if there are none.
std::optional<std::string> take_brackets(std::string_view& text) {
  const std::size_t end = text.find_last_not_of(" \t");
  if (end == std::string_view::npos || (text[end] != ')' && text[end] != ']')) return std::nullopt;
  const std::size_t open = text.find_last_of("([", end);
  if (open == std::string_view::npos || open == 0) return std::nullopt;
  std::string unit(trimmed(text.substr(open + 1, end - open - 1)));
  std::transform(unit.begin(), unit.end(), unit.begin(), lower);
  text = text.substr(0, open);
  return unit;
}

/// Takes the unit that the last words are, the longest that there is. At least one word stays.
void take_unit_words(ColumnName& name) {
  for (std::size_t count = std::min<std::size_t>(3, name.words.size() - 1); count > 0; --count) {
    std::string text;
    for (std::size_t i = name.words.size() - count; i < name.words.size(); ++i)
      text += (text.empty() ? "" : "_") + name.words[i];
    name.unit = unit_named(text);
    if (!name.unit) continue;
    name.unit_text = text;
    name.words.resize(name.words.size() - count);
    return;
  }
}

}  // namespace

bool ColumnName::has(std::initializer_list<std::string_view> any) const {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return std::find(any.begin(), any.end(), word) != any.end();
  });
}

ColumnName column_name(std::string_view text) {
  text = text.substr(0, kLongestName);
  ColumnName name;
  if (const auto brackets = take_brackets(text)) {
    name.unit_text = *brackets;
    name.unit = unit_named(*brackets);
  }
  name.words = words_in(text);
  if (!name.unit && name.unit_text.empty() && name.words.size() > 1) take_unit_words(name);
  return name;
}

}  // namespace astro::tables
