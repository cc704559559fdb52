#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

/// The members of a question. Each of these throws astro::Error in a sentence that names the member if it has another type.
namespace astro::page {

/// "", nothing, false or none if the member is missing.
std::string text_in(const nlohmann::json& question, const char* name);
std::optional<double> number_in(const nlohmann::json& question, const char* name);
bool flag_in(const nlohmann::json& question, const char* name);
std::vector<std::string> texts_in(const nlohmann::json& question, const char* name);

/// Throws astro::Error also if the number is not from `least` to `most`, naming both.
std::optional<double> number_in(const nlohmann::json& question, const char* name, double least, double most);

/// Below the folder: whatever a call writes. No file that was put into the folder can have this name, so that none is written
/// over.
inline constexpr const char* kMade = ".made";

/// A file that was put into the folder. Throws astro::Error if the name leads anywhere else, or to what calls have made: whoever
/// asks may be a stranger.
std::filesystem::path file_in(const std::filesystem::path& folder, const std::string& name);

}  // namespace astro::page
