#pragma once

#include <filesystem>
#include <string>

#include "host/base/bytes.hpp"
#include "host/base/error.hpp"
#include "host/recording/run.hpp"

/// Runs on disk, one MCAP file each. See run_writer.hpp for topics and limits.
///
/// Round trip  write then read gives the same run: times, positions, twists, counts and info bit for bit;
///             headings to 1e-12 rad per thousand radians, whole turns included. The pose of an invalid truth
///             sample comes back as NaN. `warning` is not stored.
namespace astro::recording {

/// Writes a run; the file appears complete or not at all. Throws astro::Error naming the file.
void write_run(const std::filesystem::path& path, const Run& run);

/// Whether a damaged file is used. A hole in the middle could make a calibration wrong without anyone
/// noticing, so it is used only on request.
enum class Damage { refused, accepted };

/// Part of the file cannot be read, and Damage::refused was given. Its kind is the first bag::McapProblem
/// that was found; its values are the file and those of that problem.
class DamagedRecording : public Error {
 public:
  using Error::Error;
};

/// A file that was cut off gives what is left of it, and `warning` says so; whole turns of the first headings
/// are unknown then, so they start in [-pi, pi]. The same holds for a damaged file if that is accepted; whole
/// turns may be lost in its holes. Throws astro::Error naming the file if it does not exist or is not a
/// recording of a run, and DamagedRecording.
Run read_run(const std::filesystem::path& path, Damage damage = Damage::refused);

/// The same for a file in memory; `name` is its name in messages.
Run run_from_bytes(ByteView file, const std::string& name, Damage damage = Damage::refused);

/// What the file says of its run, also if it is damaged or was cut off; the samples are not looked at, so the memory it
/// takes does not grow with the file. Throws as read_run does.
RunInfo read_run_info(const std::filesystem::path& path);

}  // namespace astro::recording
