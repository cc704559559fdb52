#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "host/recording/run.hpp"
#include "host/recording/run_file.hpp"

/// The runs of an experiment: all *.mcap below one folder.
namespace astro::recording {

/// The recordings below `folder`, in natural order of their paths ("cw-2" before "cw-10"), whatever order the
/// file system gives. Throws astro::Error naming the folder if it does not exist, cannot be read or holds no
/// recording.
std::vector<std::filesystem::path> list_runs(const std::filesystem::path& folder);

/// The runs in these files, in their order; several are read at a time. Throws astro::Error naming the first file that is no run.
std::vector<Run> read_runs(std::span<const std::filesystem::path> files, Damage damage = Damage::refused);

/// The same of a whole folder.
std::vector<Run> read_runs(const std::filesystem::path& folder, Damage damage = Damage::refused);

}  // namespace astro::recording
