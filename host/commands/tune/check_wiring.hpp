#pragma once

#include <optional>
#include <string>

#include "host/motor/model/wiring.hpp"

/// How a person says at a command line what turned.
namespace astro::commands {

/// "left-forward", "lf", ..., "none"; nullopt for what is no answer.
std::optional<motor::Sighting> sighting_from(const std::string& word);

}  // namespace astro::commands
