#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/experiment/files/run_set.hpp"

/// Sessions by folder, for those who keep each day's or each mounting's drives in a folder of its own.
namespace astro::experiment {

/// The name of the folder in which each file lies, with as many folders above it as tell it apart from the folders of the other
/// files: "monday", or "april/monday" and "may/monday". Files in one folder get equal names, and only they. A file that is a
/// folder, as some bags are, lies in the folder above.
std::vector<std::string> sessions_by_folder(std::span<const std::filesystem::path> files);

/// The same for drives whose wheels and whose ground truth are files of their own. Drives are of one session only if both
/// their wheels and their ground truth lie in one folder: then neither `wheels/monday` with `takes` nor `wheels` with
/// `takes/monday` nor `monday/wheels` with `monday/takes` is mixed with Tuesday's. To split a session costs a little
/// precision, but to mix two puts the tracked body where it never sat. The name is that of the folder of the ground truth,
/// followed by that of the wheels if it is another. Precondition: as many of one as of the other.
std::vector<std::string> sessions_by_folder(std::span<const std::filesystem::path> wheels,
                                            std::span<const std::filesystem::path> truth);

/// The same for the recordings of read_run_set(folder).
std::vector<std::string> sessions_by_folder(const RunSet& set, const std::filesystem::path& folder);

}  // namespace astro::experiment
