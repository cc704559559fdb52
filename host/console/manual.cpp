#include "host/console/manual.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

namespace astro::console {
namespace {

/// Text that man shows as it is: a hyphen could become a dash, and a line that begins with a dot would be a request.
std::string literal(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::vector<const CLI::App*> shown_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* sub) { return !sub->get_group().empty(); });
}

std::string names_of(const CLI::Option& option) {
  std::string names = "\\fB" + literal(option.get_name(option.get_positional(), true)) + "\\fR";
  if (option.get_items_expected_max() == 0) return names;
  names += " \\fI" + literal(option.get_type_name()) + "\\fR";
  if (!option.get_default_str().empty()) names += " (default " + literal(option.get_default_str()) + ")";
  if (option.get_required()) names += " (required)";
  return names;
}

/// Text below the options, whose lines stay as they are.
std::string as_it_stands(const std::string& text) { return ".nf\n" + literal(text) + "\n.fi\n"; }

class Pages {
 public:
  explicit Pages(std::string version) : version_(std::move(version)) {}

  /// `path`: the words of the command, as in 'astrolabe calibrate'.
  void add(const CLI::App& command, const std::string& path) {
    std::string name = path;
    std::ranges::replace(name, ' ', '-');
    std::string out = fmt::format(".TH \"{}\" 1 \"\" \"{}\" \"User Commands\"\n", upper(name), version_);
    out += fmt::format(".SH NAME\n{} \\- {}\n", literal(name), literal(command.get_description()));
    out += ".SH SYNOPSIS\n.B " + literal(path) + "\n" + synopsis(command) + "\n";
    out += options_of(command);
    for (const CLI::App* sub : shown_commands(command)) add(*sub, path + " " + sub->get_name());
    out += commands_of(command, name);
    if (!command.get_footer().empty()) out += ".SH NOTES\n" + as_it_stands(command.get_footer());
    pages_.push_back({std::move(name), std::move(out)});
  }

  std::vector<ManualPage> take() && { return std::move(pages_); }

 private:
  static std::string synopsis(const CLI::App& command) {
    std::string words = "[\\fIOPTION\\fR]...";
    for (const CLI::Option* option : command.get_options())
      if (option->get_positional()) words += " \\fI" + literal(upper(option->get_name(true))) + "\\fR";
    if (!shown_commands(command).empty()) words += " \\fICOMMAND\\fR";
    return words;
  }

  static std::string options_of(const CLI::App& command) {
    std::string out = ".SH OPTIONS\n";
    for (const CLI::Option* option : command.get_options())
      if (!option->get_group().empty())
        out += ".TP\n" + names_of(*option) + "\n" + literal(option->get_description()) + "\n";
    return out;
  }

  static std::string commands_of(const CLI::App& command, const std::string& name) {
    std::string out, heading;
    for (const CLI::App* sub : shown_commands(command)) {
      if (out.empty()) out = ".SH COMMANDS\n";
      if (sub->get_group() != heading && sub->get_group() != "Subcommands")
        out += ".SS " + literal(sub->get_group()) + "\n";
      heading = sub->get_group();
      out += fmt::format(".TP\n.BR {} (1)\n{}\n", literal(name + "-" + sub->get_name()),
                         literal(sub->get_description()));
    }
    return out;
  }

  std::string version_;
  std::vector<ManualPage> pages_;
};

}  // namespace

std::vector<ManualPage> manual_of(Command program, const std::string& version) {
  Pages pages(version);
  pages.add(*program.app(), program.app()->get_name());
  return std::move(pages).take();
}

}  // namespace astro::console
