#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/experiment/files/run_set.hpp"

/// Sessions by folder, for users who keep the drives of each day or each mounting in a separate folder.
namespace astro::experiment {

/// The name of the folder in which each file lies, with as many folders above it as tell it apart from the folders of the other
/// files: "monday", or "april/monday" and "may/monday". Files in one folder get equal names, and only they. A file that is a
/// folder, as some bags are, lies in the folder above.
std::vector<std::string> sessions_by_folder(std::span<const std::filesystem::path> files);

/// The same for drives whose wheels and ground truth are separate files. Two drives are of one session only if their wheels
/// lie in one folder and their ground truth lies in one folder. So `wheels/monday` with `takes`, `wheels` with
/// `takes/monday`, and `monday/wheels` with `monday/takes` are each kept apart from Tuesday's. To split a session costs a
/// little precision, but to mix two gives a wrong lever arm. The name is that of the ground truth's folder, followed by that
/// of the wheels' folder if it is another. Precondition: as many files of wheels as of ground truth.
std::vector<std::string> sessions_by_folder(std::span<const std::filesystem::path> wheels,
                                            std::span<const std::filesystem::path> truth);

/// The same for the recordings of read_run_set(folder).
std::vector<std::string> sessions_by_folder(const RunSet& set, const std::filesystem::path& folder);

}  // namespace astro::experiment
