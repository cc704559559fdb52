#include "host/console/help.hpp"

#include <CLI/CLI.hpp>
#include <memory>
#include <sstream>

namespace astro::console {
namespace {

constexpr std::size_t kWidth = 80, kNames = 30;

class HelpFormatter final : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(kNames); }

  std::string make_description(const CLI::App* app) const override {
    return wrapped(Formatter::make_description(app), 0, 0) + '\n';
  }

  std::string make_usage(const CLI::App* app, std::string name) const override {
    constexpr std::size_t kIndent = 4;
    return wrapped(Formatter::make_usage(app, std::move(name)), 0, kIndent) + '\n';
  }

  std::string make_option(const CLI::Option* option, bool positional) const override {
    return row(make_option_name(option, positional) + make_option_opts(option), make_option_desc(option));
  }

  std::string make_subcommand(const CLI::App* app) const override {
    return row(app->get_display_name(true), app->get_description());
  }

  std::string make_footer(const CLI::App* app) const override {
    std::istringstream lines(Formatter::make_footer(app));
    const CLI::App* root = app;
    while (root->get_parent() != nullptr) root = root->get_parent();
    const std::string program = root->get_name();
    std::string out, rest;  // what did not fit the line before
    for (std::string line; std::getline(lines, line);) {
      const bool goes_on = !line.empty() && line[0] != ' ' && !line.starts_with("Example");
      if (!rest.empty() && !goes_on) out += rest + '\n';
      if (!rest.empty() && goes_on) line = rest + ' ' + line;
      rest.clear();
      if (line.starts_with("  ")) {
        out += indented(line, program + ' ') + '\n';
        continue;
      }
      const std::string fitting = wrapped(line, 0, 0);
      const std::size_t end = fitting.rfind('\n');
      if (end != std::string::npos) rest = fitting.substr(end + 1);
      out += fitting.substr(0, end) + '\n';
    }
    return rest.empty() ? out : out + rest + '\n';
  }

 private:
  static std::string row(const std::string& names, const std::string& what) {
    std::string out = "  " + names;
    if (what.empty()) return out + '\n';
    if (out.size() + 1 > kNames)
      out += '\n' + std::string(kNames, ' ');
    else
      out.resize(kNames, ' ');
    return out + wrapped(what, kNames, kNames) + '\n';
  }

  /// A line of a footer that stands apart. A command that is too long goes on before one of its options.
  static std::string indented(std::string line, const std::string& program) {
    const std::size_t indent = line.find_first_not_of(' ');
    const std::string blanks(indent, ' ');
    if (line.size() <= kWidth) return line;
    if (line.compare(indent, program.size(), program) != 0) return blanks + wrapped(line, indent, indent);
    std::string out;
    while (line.size() > kWidth) {
      constexpr std::size_t kBreak = 2;  // the characters that end the line
      std::size_t at = line.rfind(" --", kWidth - kBreak);
      if (at == std::string::npos || at < line.find_first_not_of(' ')) at = line.rfind(' ', kWidth - kBreak);
      if (at == std::string::npos || at < line.find_first_not_of(' ')) break;  // one long word
      out += line.substr(0, at) + " \\\n";
      line = blanks + "    " + line.substr(at + 1);
    }
    return out + line;
  }
};

}  // namespace

std::string wrapped(std::string_view text, std::size_t at, std::size_t indent) {
  std::istringstream words{std::string(text)};
  std::string out, word;
  bool first = true;
  while (words >> word) {
    if (!first && at + 1 + word.size() > kWidth) {
      out += '\n' + std::string(indent, ' ');
      at = indent;
    } else if (!first) {
      out += ' ';
      ++at;
    }
    out += word;
    at += word.size();
    first = false;
  }
  return out;
}

void fit_help(CLI::App& app) { app.formatter(std::make_shared<HelpFormatter>()); }

}  // namespace astro::console
