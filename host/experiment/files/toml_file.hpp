#pragma once

#include <toml++/toml.h>
#include <filesystem>
#include <string>

namespace astro::experiment {

/// Throws astro::Error naming the file, and the line that is not TOML or nests deeper than any file of ours;
/// also if the file is larger than 1 MiB.
toml::table parse_toml(const std::filesystem::path& path);

/// Shortest digits that give the same double again, with a point, so that TOML and YAML read a float; "nan".
std::string real_text(double value);

}  // namespace astro::experiment
