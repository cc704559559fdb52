#pragma once

#include <string>

#include "host/base/error.hpp"
#include "host/commands/shared/unused_choices.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/import/drives/unused_choice.hpp"

/// Says in words of the options what is wrong with what they state.
namespace astro::commands {

/// What is wrong with the options themselves; "" for any other error.
std::string in_words_of_options(const Error& error);

/// Calls `statements`, whose errors about what is stated become console::WrongUsage.
template <typename Statements>
auto stated(const Statements& statements) try {
  return statements();
} catch (const importing::UnusedChoice& unused) {
  throw wrong_usage(unused);
} catch (const Error& error) {
  const std::string words = in_words_of_options(error);
  if (words.empty()) throw;
  throw console::WrongUsage(words);
}

}  // namespace astro::commands
