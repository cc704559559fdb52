#pragma once

#include <toml++/toml.h>
#include <filesystem>
#include <string>

namespace astro::experiment {

/// What is wrong with a TOML file. Values: the file and, for all but cut_off, the line.
enum class TomlProblem { nests_too_deeply, cut_off, not_toml };

/// The text of a file: a first line that says what it is and what its last line is, then the body, then that last line. So a
/// truncated file is detected wherever it was cut; without this, half of a number would still be read as a number.
std::string toml_file(const std::string& what, const std::string& body);

/// Throws astro::Error naming the file, and the line that is not TOML or nests deeper than any file of ours; also if the
/// file is larger than 1 MiB, or does not end as its first line says. Files whose first line does not announce a last line
/// are read as they are.
toml::table parse_toml(const std::filesystem::path& path);

/// Shortest digits that give the same double again, with a point, so that TOML and YAML read a float; "nan".
std::string real_text(double value);

}  // namespace astro::experiment
