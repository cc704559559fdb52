#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/base/error.hpp"

namespace astro::commands {

/// An option or a subcommand that helps against one kind of error. It is defined beside the command that has
/// it.
struct Advice {
  Kind kind;
  const char*
      words;  // after the error's sentence, with punctuation: "; give {0} with --tape". {0}: the first value
};

/// Registers a command's advice. `all` must live as long as the program; registering it again changes
/// nothing.
void advise(std::span<const Advice> all);

/// All registered advice.
std::vector<Advice> all_advice();

/// The error's sentence for a person, followed by the advice on its kind if any is registered.
std::string in_words(const Error& error);

/// The same of a remark.
std::string in_words(const Remark& remark);

/// The sentence for std::bad_alloc. A constant, because there is no memory to make one.
inline constexpr const char* kNoMemory =
    "there is not enough memory: end other programs, or do less at a time";

}  // namespace astro::commands
