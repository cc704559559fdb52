#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/base/error.hpp"

namespace astro::commands {

/// An option or a subcommand that helps against a kind of error. It stands beside the command that has it.
struct Advice {
  Kind kind;
  const char*
      words;  // behind the error's sentence, with their joint: "; give {0} with --tape". {0} is the first value.
};

/// Makes a command's advice known. `all` has to live as long as the program; the same again changes nothing.
void advise(std::span<const Advice> all);

/// All that is known.
std::vector<Advice> all_advice();

/// The whole sentence of an error for a person, with the advice on its kind if a command has some.
std::string in_words(const Error& error);

/// The same of a remark.
std::string in_words(const Remark& remark);

/// The sentence for std::bad_alloc. A constant, because there is no memory to make one.
inline constexpr const char* kNoMemory =
    "there is not enough memory: end other programs, or do less at a time";

}  // namespace astro::commands
