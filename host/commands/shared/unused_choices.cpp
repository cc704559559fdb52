#include "host/commands/shared/unused_choices.hpp"

#include <algorithm>
#include <string>

namespace astro::commands {
namespace {

using importing::Choice;

/// As add_import calls it.
std::string option_of(Choice choice) {
  std::string name = "--" + std::string(importing::name_of(choice));
  std::ranges::replace(name, '_', '-');
  return name;
}

}  // namespace

console::WrongUsage wrong_usage(const importing::UnusedChoice& unused) {
  const std::string why = unused.choice() == Choice::controller
                              ? "no parameters of controllers (YAML) are named with --robot"
                              : unused.why();
  return console::WrongUsage(option_of(unused.choice()) + " does not apply here: " + why);
}

void refuse_unused_choices(const ImportOptions& options) try {
  importing::refuse_unused_choices(options);
} catch (const importing::UnusedChoice& unused) {
  throw wrong_usage(unused);
}

void refuse_choices_without_drives(const ImportOptions& options) {
  for (const Choice choice : importing::stated_choices(options))
    throw console::WrongUsage(option_of(choice) + " goes with --wheels and --truth");
}

}  // namespace astro::commands
