#pragma once

#include <toml++/toml.h>
#include <filesystem>
#include <string>

namespace astro::experiment {

/// Values: the file and, of all but cut_off, the line.
enum class TomlProblem { nests_too_deeply, cut_off, not_toml };

/// A file of ours: a first line that says what it is and how it ends, the body, and that end. So a file that was cut off is told
/// from a whole one, wherever it was cut: half of a number is a number, too.
std::string toml_file(const std::string& what, const std::string& body);

/// Throws astro::Error naming the file, and the line that is not TOML or nests deeper than any file of ours;
/// also if the file is larger than 1 MiB, or does not end as its first line says. Files that say nothing of their end are read.
toml::table parse_toml(const std::filesystem::path& path);

/// Shortest digits that give the same double again, with a point, so that TOML and YAML read a float; "nan".
std::string real_text(double value);

}  // namespace astro::experiment
