#pragma once

#include <optional>
#include <string>

#include "host/motor/model/wiring.hpp"

/// The words by which a person says at a command line what turned.
namespace astro::commands {

/// "left-forward", "lf", ..., "none"; nullopt for any other word.
std::optional<motor::Sighting> sighting_from(const std::string& word);

}  // namespace astro::commands
