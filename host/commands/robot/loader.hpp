#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace astro::commands {

/// Where a program of this name stands on the PATH; empty if it does not.
std::optional<std::filesystem::path> program_on_path(const std::string& name);

/// teensy_loader_cli on the PATH, or the program that the environment variable ASTROLABE_LOADER names. Throws
/// astro::Error if there is none.
std::filesystem::path find_loader();

/// Runs the loader on `hex` until it ends; it waits for a Teensy in its boot loader. Throws astro::Error with
/// the last line of its output if it fails, Interrupted on Ctrl-C.
void run_loader(const std::filesystem::path& loader, const std::filesystem::path& hex);

}  // namespace astro::commands
