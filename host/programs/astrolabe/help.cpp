#include "host/programs/astrolabe/help.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/commands/shared/params_page.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/completion.hpp"
#include "host/guides/guides.hpp"

namespace astro::commands {
namespace {

void add_topic(console::Command help, const std::string& name, const std::string& title,
               const std::string& text) {
  const console::Command topic = help.add_subcommand(name, title);
  topic.footer(fmt::format("{}\nExamples:\n  astrolabe help {}", text, name));
  topic.callback([text] { write(text); });
}

/// What the help shows of the commands below one.
std::vector<std::string> names_of(console::Command command) {
  std::vector<std::string> names;
  for (const auto& [name, what] : console::complete(command, {""}).words) names.push_back(name);
  return names;
}

std::string list(const std::vector<std::pair<std::string, std::string>>& topics) {
  std::string text = "Guides, each shown by 'astrolabe help TOPIC':\n\n";
  for (const auto& [name, title] : topics) text += fmt::format("  {:<16}  {}\n", name, title);
  return text + "\n'astrolabe --help' lists the commands, 'astrolabe help COMMAND' explains one.\n";
}

}  // namespace

void add_help(console::Command app, const std::function<int(const std::vector<std::string>&)>& run) {
  const std::vector<std::string> commands = names_of(app);
  app.under("About", [&] {
    const console::Command help =
        app.add_subcommand("help", "guides: a first robot, your own logs, symptoms, mathematics");
    std::vector<std::pair<std::string, std::string>> topics;
    const auto add = [&](const std::string& name, const std::string& title, const std::string& text) {
      topics.emplace_back(name, title);
      add_topic(help, name, title, text);
    };
    for (const guides::Guide& guide : guides::all())
      add(std::string(guide.name), std::string(guide.title()), std::string(guide.text));
    add("parameters", "Every parameter of the robot", parameters_page());
    help.footer("Examples:\n  astrolabe help first-robot\n  astrolabe help umbmark");
    help.callback([help, topics] {
      if (!help.has_subcommand()) write(list(topics));
    });
    help.under("", [&] {
      const std::vector<std::string> shown = names_of(help);
      for (const std::string& command : commands)
        if (std::ranges::find(shown, command) == shown.end())
          help.add_subcommand(command, "").callback([run, command] { run({command, "--help"}); });
    });
  });
}

}  // namespace astro::commands
