#include "tests/host/guides/page.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace astro::guides {
namespace {

constexpr std::string_view kAnything = "...";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// A number at the beginning of a text: its digits with at most one point between them. "" if there is none.
std::string number_at(std::string_view text) {
  std::size_t end = 0;
  bool point = false;
  while (end < text.size() && (is_digit(text[end]) || (text[end] == '.' && !point && end > 0 &&
                                                       end + 1 < text.size() && is_digit(text[end + 1])))) {
    point = point || text[end] == '.';
    ++end;
  }
  return std::string(text.substr(0, end));
}

bool same_number(const std::string& shown, const std::string& actual) {
  const std::size_t point = shown.find('.');
  const double digit = point == shown.npos ? 1 : std::pow(0.1, static_cast<double>(shown.size() - point - 1));
  const double a = std::stod(shown), b = std::stod(actual);
  return std::abs(a - b) <= std::max(0.25 * std::max(a, b), 2 * digit);
}

bool same(std::string_view shown, std::string_view actual) {
  if (shown.starts_with(kAnything)) {
    for (std::size_t at = 0; at <= actual.size(); ++at)
      if (same(shown.substr(kAnything.size()), actual.substr(at))) return true;
    return false;
  }
  if (shown.empty() || actual.empty()) return shown.empty() && actual.empty();
  const std::string number = number_at(shown), other = number_at(actual);
  if (!number.empty() && !other.empty())
    return same_number(number, other) && same(shown.substr(number.size()), actual.substr(other.size()));
  return shown[0] == actual[0] && same(shown.substr(1), actual.substr(1));
}

std::string with_single_blanks(const std::string& line) {
  std::string out;
  for (const std::string& word : words_of(line)) out += (out.empty() ? "" : " ") + word;
  return out;
}

}  // namespace

std::vector<Command> commands_of(const std::string& page) {
  constexpr std::string_view kBlock = "    ", kOutput = "      ", kFence = "```";
  std::vector<Command> commands;
  std::istringstream lines(page);
  bool goes_on = false;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.starts_with(kFence)) {
      commands.push_back({number, "cat > " + line.substr(line.find(' ') + 1) + " <<'END'\n", {}});
      for (; std::getline(lines, line) && !line.starts_with(kFence); ++number)
        commands.back().text += line + "\n";
      commands.back().text += "END";
      ++number;
      goes_on = false;
      continue;
    }
    if (!line.starts_with(kBlock)) {
      goes_on = false;
      continue;
    }
    if (goes_on) {
      commands.back().text.pop_back();  // the backslash
      commands.back().text += line.substr(line.find_first_not_of(' '));
    } else if (line.starts_with(kOutput)) {
      if (!commands.empty()) commands.back().shown.push_back(line.substr(kOutput.size()));
      continue;
    } else {
      commands.push_back({number, line.substr(kBlock.size()), {}});
    }
    goes_on = commands.back().text.ends_with('\\');
  }
  return commands;
}

std::string missing_line(const std::vector<std::string>& shown, const std::string& output) {
  std::istringstream lines(output);
  std::string line;
  for (const std::string& each : shown) {
    const std::string wanted = with_single_blanks(each);
    if (wanted == kAnything) continue;
    bool found = false;
    while (!found && std::getline(lines, line)) found = same(wanted, with_single_blanks(line));
    if (!found) return each;
  }
  return "";
}

}  // namespace astro::guides
