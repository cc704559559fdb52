#pragma once

#include <functional>
#include <string>

namespace astro::commands {

/// Puts a question at the terminal, returns the answer.
using AskLine = std::function<std::string(const std::string&)>;

/// Asks until the answer, without the blanks around it, is empty or recognised by `accepted`, and says why it asks again. So
/// nothing but Enter alone lets a robot drive: a person who types something else does not agree.
std::string enter_or(const AskLine& ask, const std::string& prompt,
                     const std::function<bool(const std::string&)>& accepted);

/// Asks until the answer is Enter alone.
void press_enter(const AskLine& ask, const std::string& prompt);

}  // namespace astro::commands
