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

}  // namespace astro::commands
