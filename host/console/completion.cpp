#include "host/console/completion.hpp"

#include <CLI/CLI.hpp>
#include <sstream>

namespace astro::console {
namespace {

bool is_shown(const CLI::App* command) {
  return !command->get_group().empty() && !command->get_name().empty();
}

const CLI::App* subcommand(const CLI::App& app, const std::string& word) {
  const auto found = app.get_subcommands([&](const CLI::App* sub) { return sub->check_name(word); });
  return found.empty() ? nullptr : found.front();
}

/// The first sentence of a description, in one line.
std::string in_a_line(const std::string& what) {
  std::istringstream words(what.substr(0, what.find("; ")));
  std::string out;
  for (std::string word; words >> word;) out += (out.empty() ? "" : " ") + word;
  return out;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

std::string longest_name(const CLI::Option& option) {
  if (!option.get_lnames().empty()) return "--" + option.get_lnames().front();
  return "-" + option.get_snames().front();
}

/// The words of `a|b|c`, of which an option takes one.
std::vector<std::string> choices(const CLI::Option& option) {
  std::vector<std::string> words;
  const std::string type = option.get_type_name();
  if (type.find('|') == std::string::npos) return words;
  std::istringstream parts(type);
  for (std::string word; std::getline(parts, word, '|');) words.push_back(word);
  return words;
}

class Completer {
 public:
  /// `before`: what stands in the same word in front of what is begun, as in --order=cw.
  explicit Completer(const std::string& begun, const std::string& before = "")
      : begun_(begun), before_(before) {}

  void offer(const std::string& word, const std::string& what = "") {
    if (word.starts_with(begun_)) out_.words.push_back({before_ + word, in_a_line(what)});
  }
  void offer_values(const CLI::Option& option) {
    for (const std::string& word : choices(option)) offer(word);
    out_.files = choices(option).empty();
  }
  Completion result() && { return std::move(out_); }

 private:
  std::string begun_, before_;
  Completion out_;
};

/// Behind the = of an option.
Completion complete_value(const CLI::App& command, const std::string& begun) {
  const std::size_t value = begun.find('=') + 1;
  Completer out(begun.substr(value), begun.substr(0, value));
  const CLI::Option* option = command.get_option_no_throw(begun.substr(0, value - 1));
  if (option != nullptr && takes_value(*option)) out.offer_values(*option);
  return std::move(out).result();
}

}  // namespace

Completion complete(Command program, const std::vector<std::string>& typed) {
  const CLI::App* command = program.app();
  const CLI::Option* open = nullptr;  // an option that waits for its value
  for (std::size_t i = 0; i + 1 < typed.size(); ++i) {
    const std::string& word = typed[i];
    if (open != nullptr) {
      open = nullptr;
    } else if (word.starts_with('-')) {
      const CLI::Option* option = command->get_option_no_throw(word);
      if (option != nullptr && takes_value(*option)) open = option;
    } else if (const CLI::App* next = subcommand(*command, word)) {
      command = next;
    }
  }
  const std::string begun = typed.empty() ? "" : typed.back();
  Completer out(begun);
  if (open != nullptr) {
    out.offer_values(*open);
    return std::move(out).result();
  }
  if (begun.starts_with('-') && begun.find('=') != std::string::npos) return complete_value(*command, begun);
  if (begun.starts_with('-')) {
    for (const CLI::Option* option : command->get_options())
      if (option->nonpositional()) out.offer(longest_name(*option), option->get_description());
    return std::move(out).result();
  }
  const auto commands = command->get_subcommands(is_shown);
  for (const CLI::App* sub : commands) out.offer(sub->get_name(), sub->get_description());
  if (commands.empty())
    for (const CLI::Option* option : command->get_options())
      if (option->get_positional()) out.offer_values(*option);
  return std::move(out).result();
}

}  // namespace astro::console
