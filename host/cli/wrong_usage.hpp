#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "host/base/error.hpp"

/// What was typed cannot be meant: one line, exit code 2.
namespace astro::cli {

/// Options that are well-formed one by one and wrong together; found by a callback.
class WrongUsage : public Error {
 public:
  using Error::Error;
};

/// The sentence for what CLI11 found wrong, naming the word in question and the help that explains it.
std::string sentence_for(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv);

}  // namespace astro::cli
