#include "host/console/program.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include "host/console/console.hpp"

namespace astro::console {
namespace {

/// The command that was being given when the mistake came up.
struct Place {
  const CLI::App* command;
  std::string path;
  std::string unknown;  // the word that was to name the next command, or an option; "": there is none
};

const CLI::App* find(const CLI::App& app, std::string_view name) {
  const auto found = app.get_subcommands([&](const CLI::App* sub) { return sub->get_name() == name; });
  return found.empty() ? nullptr : found.front();
}

bool has_commands(const CLI::App& app) {
  return !app.get_subcommands([](const CLI::App*) { return true; }).empty();
}

Place place_of(const CLI::App& app, int argc, char** argv) {
  Place place{&app, app.get_name(), ""};
  for (int i = 1; i < argc && has_commands(*place.command); ++i) {
    const std::string word = argv[i];
    const CLI::App* next = find(*place.command, word);
    if (next == nullptr) {
      place.unknown = word;
      break;
    }
    place.command = next;
    place.path += " " + word;
  }
  return place;
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
  std::size_t least = word.size() < 4 ? 2 : 3;  // further apart it is another word
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

std::string unknown_argument(const Place& place, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  if (!name.starts_with('-')) return fmt::format("'{}' has no place for '{}'", place.path, word);
  return fmt::format("'{}' has no option '{}'{}", place.path, name,
                     suggestion(name, option_names(*place.command)));
}

// CLI11 lists the words that it could not place behind a colon, in no helpful order. The one to name is the
// first option among them: what follows it is its value, and innocent.
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

bool names_no_command(const Place& place) {
  return !place.unknown.empty() && !place.unknown.starts_with('-');
}

std::string unknown_command(const Place& place) {
  return fmt::format("there is no command '{} {}'{}", place.path, place.unknown,
                     suggestion(place.unknown, command_names(*place.command)));
}

std::string what_is_wrong(const Place& place, const CLI::ParseError& error, int argc, char** argv) {
  if (place.unknown.starts_with('-') && !takes(*place.command, place.unknown))
    return unknown_argument(place, place.unknown);
  if (names_no_command(place)) return unknown_command(place);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr)
    return unknown_argument(place, first_extra(error.what(), argc, argv));
  if (place.command->get_require_subcommand_min() > 0) return fmt::format("'{}' needs a command", place.path);
  const std::string said = error.what();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr && said.find(": ") != std::string::npos)
    return said.substr(0, said.find(": ")) + " needs a value";
  return said;
}

std::string sentence_for(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  const Place place = place_of(app, argc, argv);
  return fmt::format("{} ('{} --help' explains)", what_is_wrong(place, error, argc, argv), place.path);
}

constexpr int kWrongUsage = 2;

}  // namespace

Program::Program(const std::string& name, const std::string& what)
    : app_(std::make_unique<CLI::App>(what, name)) {}

Program::~Program() = default;

void Program::version(const std::string& text) { app_->set_version_flag("--version", text); }

int Program::run(int argc, char** argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::Success& wish) {  // --help, --version
    // The library would explain the command above the word that it does not know.
    if (const Place place = place_of(*app_, argc, argv); names_no_command(place)) {
      complain(fmt::format("{} ('{} --help' explains)", unknown_command(place), place.path));
      return kWrongUsage;
    }
    return app_->exit(wish);
  } catch (const CLI::ParseError& error) {
    complain(sentence_for(*app_, error, argc, argv));
    return kWrongUsage;
  }
  return 0;
}

}  // namespace astro::console
