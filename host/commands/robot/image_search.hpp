#pragma once

#include <filesystem>
#include <string_view>

namespace astro::commands {

/// The firmware image for a board that stands on this computer: below `build`, as a checkout builds it, otherwise below `share`,
/// as a package installs it. Throws astro::Error that names both places if neither has one, and for a board that takes no image, as
/// that of a simulator.
///
/// Params  board  as the robot names it: "teensy40", "rp2040"
std::filesystem::path find_image(std::string_view board, const std::filesystem::path& build,
                                 const std::filesystem::path& share);

/// The same, of the folder `build` in the current one and the folder share/astrolabe/firmware beside that of the program.
std::filesystem::path find_image(std::string_view board);

}  // namespace astro::commands
