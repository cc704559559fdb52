#pragma once

#include <string>

#include "host/base/error.hpp"
#include "host/base/remedy.hpp"

/// Where what the libraries know would help becomes the words of this command line.
namespace astro::commands {

/// What is put behind a fact, with the joint between them: ": 'astrolabe ports' lists ..."; "" for Help::none.
std::string in_words(const Remedy& remedy);

/// The whole sentence of an error for a person.
std::string in_words(const Error& error);

/// The same of a remark.
std::string in_words(const Remark& remark);

}  // namespace astro::commands
