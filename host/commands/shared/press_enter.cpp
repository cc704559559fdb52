#include "host/commands/shared/press_enter.hpp"

#include <fmt/format.h>

#include "host/base/trimmed.hpp"

namespace astro::commands {

std::string enter_or(const AskLine& ask, const std::string& prompt,
                     const std::function<bool(const std::string&)>& accepted) {
  std::string question = prompt;
  while (true) {
    const std::string line = ask(question), answer(trimmed(line));
    if (answer.empty() || accepted(answer)) return answer;
    question = fmt::format("'{}' is no answer to this.\n{}", answer, prompt);
  }
}

void press_enter(const AskLine& ask, const std::string& prompt) {
  enter_or(ask, prompt, [](const std::string&) { return false; });
}

}  // namespace astro::commands
