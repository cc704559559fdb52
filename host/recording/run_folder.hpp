#pragma once

#include <filesystem>
#include <vector>

#include "host/recording/run.hpp"
#include "host/recording/run_file.hpp"

/// The runs of an experiment: all *.mcap below one folder.
namespace astro::recording {

/// The recordings below `folder`, in natural order of their paths ("cw-2" before "cw-10"), whatever order the
/// file system gives. Throws astro::Error naming the folder if it does not exist, cannot be read or holds no
/// recording.
std::vector<std::filesystem::path> list_runs(const std::filesystem::path& folder);

/// The runs themselves, in that order. Throws astro::Error naming a file that is no run.
std::vector<Run> read_runs(const std::filesystem::path& folder, Damage damage = Damage::refused);

}  // namespace astro::recording
