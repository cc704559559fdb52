#pragma once

#include <string>

#include "host/base/error.hpp"
#include "host/base/remedy.hpp"

/// The words of this command line for the remedies that libraries name as data.
namespace astro::commands {

/// The text that follows a fact, with its punctuation: ": 'astrolabe ports' lists ..."; "" for Help::none.
std::string in_words(const Remedy& remedy);

/// The whole sentence of an error for a person.
std::string in_words(const Error& error);

/// The same of a remark.
std::string in_words(const Remark& remark);

/// The sentence for std::bad_alloc. A constant, because there is no memory to make one.
inline constexpr const char* kNoMemory =
    "there is not enough memory: end other programs, or do less at a time";

}  // namespace astro::commands
