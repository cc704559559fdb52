#include "host/commands/base/flags.hpp"
#include "host/commands/base/advice.hpp"
#include "host/console/console.hpp"

namespace astro::commands {
namespace {

constexpr Advice kFlagsAdvice[] = {
    {console::ConsoleProblem::nobody_agrees, ": give --yes to agree beforehand"}};

}  // namespace

void add_yes(console::Command command, bool& yes, const char* answers) {
  advise(kFlagsAdvice);
  command.add_flag("--yes,-y", yes, answers);
}

void add_json_flag(console::Command command, bool& json) {
  command.add_flag("--json", json, "print JSON instead of text for people");
}

}  // namespace astro::commands
