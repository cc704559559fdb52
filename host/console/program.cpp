#include "host/console/program.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include "host/console/console.hpp"
#include "host/console/help.hpp"

namespace astro::console {
namespace {

/// The command that the user was giving when the mistake was found.
struct CommandContext {
  const CLI::App* command;
  std::string path;
  std::string unknown;  // the first word that is no subcommand, perhaps an option; "": none
};

const CLI::App* find(const CLI::App& app, std::string_view name) {
  const auto found =
      app.get_subcommands([&](const CLI::App* sub) { return sub->check_name(std::string(name)); });
  return found.empty() ? nullptr : found.front();
}

bool has_commands(const CLI::App& app) {
  return !app.get_subcommands([](const CLI::App*) { return true; }).empty();
}

CommandContext context_of(const CLI::App& app, int argc, char** argv) {
  CommandContext context{&app, app.get_name(), ""};
  for (int i = 1; i < argc && has_commands(*context.command); ++i) {
    const std::string word = argv[i];
    const CLI::App* next = find(*context.command, word);
    if (next == nullptr) {
      context.unknown = word;
      break;
    }
    context.command = next;
    context.path += " " + word;
  }
  return context;
}

/// Levenshtein's distance.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = std::exchange(row[j + 1], std::min({row[j] + 1, row[j + 1] + 1, replaced}));
    }
  }
  return row.back();
}

template <class Names>
std::string suggestion(const std::string& word, const Names& names) {
  std::string best;
  std::size_t least = word.size() < 4 ? 2 : 3;  // a larger distance means another word
  for (const std::string& name : names)
    if (const std::size_t apart = distance(word, name); apart < least) {
      least = apart;
      best = name;
    }
  return best.empty() ? "" : fmt::format("; did you mean '{}'?", best);
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(sub->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string unknown_argument(const CommandContext& context, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  if (!name.starts_with('-')) return fmt::format("'{}' has no place for '{}'", context.path, word);
  return fmt::format("'{}' has no option '{}'{}", context.path, name,
                     suggestion(name, option_names(*context.command)));
}

// CLI11 lists the unknown words after a colon, in no helpful order. The word to name is the first option
// among them, because the words after it are probably its value.
std::string first_extra(const std::string& said, int argc, char** argv) {
  std::string first;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if ((said + " ").find(" " + word + " ") == std::string::npos) continue;
    if (word.starts_with("-")) return word;
    if (first.empty()) first = word;
  }
  return first;
}

bool takes(const CLI::App& command, const std::string& option) {
  return command.get_option_no_throw(option.substr(0, option.find('='))) != nullptr;
}

bool names_no_command(const CommandContext& context) {
  return !context.unknown.empty() && !context.unknown.starts_with('-');
}

std::string unknown_command(const CommandContext& context) {
  return fmt::format("there is no command '{} {}'{}", context.path, context.unknown,
                     suggestion(context.unknown, command_names(*context.command)));
}

std::string what_is_wrong(const CommandContext& context, const CLI::ParseError& error, int argc,
                          char** argv) {
  if (context.unknown.starts_with('-') && !takes(*context.command, context.unknown))
    return unknown_argument(context, context.unknown);
  if (names_no_command(context)) return unknown_command(context);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr)
    return unknown_argument(context, first_extra(error.what(), argc, argv));
  if (context.command->get_require_subcommand_min() > 0)
    return fmt::format("'{}' needs a command", context.path);
  const std::string said = error.what();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr && said.find(": ") != std::string::npos)
    return said.substr(0, said.find(": ")) +
           (said.find("At Most") != std::string::npos ? " is given more than once" : " needs a value");
  return said;
}

std::string sentence_for(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  const CommandContext context = context_of(app, argc, argv);
  return fmt::format("{} ('{} --help' explains)", what_is_wrong(context, error, argc, argv), context.path);
}

constexpr int kWrongUsage = 2;

int answer = 0;  // one command runs in a process

}  // namespace

void answer_no() { answer = kAnswerIsNo; }

Program::Program(const char* name, const char* what) {
  set_program_name(name);  // first: complaints about what follows name the program
  app_ = std::make_unique<CLI::App>(what, name);
  fit_help(*app_);
}

Program::~Program() = default;

void Program::version(const std::string& text) { app_->set_version_flag("--version", text); }

void Program::foreign_words(const std::string& begin, const std::string& end) {
  foreign_begin_ = begin;
  foreign_end_ = end;
}

std::vector<std::string> Program::with_values(int argc, char** argv) const {
  std::vector<std::string> words;
  bool inside = false;
  for (int i = 0; i < argc; ++i) {
    const std::string word = argv[i];
    if (!foreign_begin_.empty() && word == (inside ? foreign_end_ : foreign_begin_))
      inside = !inside;
    else
      words.push_back(inside ? foreign_begin_ + '=' + word : word);
  }
  return words;
}

int Program::run(int count, char** given) {
  std::vector<std::string> words = with_values(count, given);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  const int argc = static_cast<int>(pointers.size());
  char** argv = pointers.data();
  try {
    app_->parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {  // --help, --version
    // CLI11 would print the help of the parent command although the next word is unknown.
    if (const CommandContext context = context_of(*app_, argc, argv); names_no_command(context)) {
      complain(fmt::format("{} ('{} --help' explains)", unknown_command(context), context.path));
      return kWrongUsage;
    }
    return app_->exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    complain(sentence_for(*app_, error, argc, argv));
    return kWrongUsage;
  }
  return answer;
}

}  // namespace astro::console
