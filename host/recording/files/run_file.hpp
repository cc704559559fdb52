#pragma once

#include <filesystem>
#include <string>

#include "host/base/error.hpp"
#include "host/base/bytes.hpp"
#include "host/recording/run/run.hpp"

/// Runs on disk, one MCAP file each. See run_writer.hpp for topics and limits.
///
/// Round trip  write then read gives the same run: times, positions, twists, counts and info bit for bit;
///             headings to 1e-12 rad per thousand radians, whole turns included. The pose of an invalid truth
///             sample comes back as NaN. `warning` is not stored.
namespace astro::recording {

/// Appears under its name whole or not at all. Throws astro::Error naming the file.
void write_run(const std::filesystem::path& path, const Run& run);

/// What becomes of a damaged file. A hole in the middle would calibrate wrongly without anyone noticing, so
/// it is used only if somebody says so.
enum class Damage { refused, accepted };

/// Some of the file cannot be read, and it was not asked to use the rest.
class DamagedRecording : public Error {
 public:
  using Error::Error;
};

/// A file that was cut off gives what is left of it, and `warning` says so; whole turns of the first headings
/// are unknown then, so they start in [-pi, pi]. So does a damaged one if that is accepted; whole turns may
/// be lost in its holes. Throws astro::Error naming the file if it is not there or is not a recording of a
/// run, and DamagedRecording.
Run read_run(const std::filesystem::path& path, Damage damage = Damage::refused);

/// The same for a file that is in memory; `name` is what complaints call it.
Run run_from_bytes(ByteView file, const std::string& name, Damage damage = Damage::refused);

/// The info alone, without expanding the data: for lists. Throws as read_run, but overlooks damage in the
/// data that leaves the file's checksums out of play.
RunInfo read_run_info(const std::filesystem::path& path);

}  // namespace astro::recording
