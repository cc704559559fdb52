#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace astro::film {

/// Why a film cannot be followed. Values: the file; of unusual_size also its pictures' width and height.
enum class FilmFileProblem { not_a_film, unusual_size };

/// What the container of a film says.
struct FilmInfo {
  int width = 0, height = 0;  // as the sensor is read: not turned upright
  int rotation_deg = 0;       // by which a player turns it
  std::string codec;
  double frames_per_s = 0;  // on average; frames come at uneven times
  double duration_s = 0;    // 0: not stated
  std::size_t frames = 0;   // 0: not stated

  /// `seconds` as a fraction of the film's length; 0 if its length is not stated.
  double part(double seconds) const {
    return duration_s > 0 ? std::clamp(seconds / duration_s, 0.0, 1.0) : 0;
  }
};

/// Reads it with ffprobe.
///
/// Errors  astro::Error: no such file, not a film, a recording that was never completed, pictures of a size in which no tag can
///         be followed, no ffprobe.
FilmInfo read_film_info(const std::filesystem::path& film);

/// The arguments that pass a film to ffmpeg and ffprobe. The film is always read as a file, never as an
/// option or an address, whatever its name, and only if it is a container that holds pictures. Playlists
/// (HLS, ffconcat) are excluded, because they can name other files, pipes and addresses, which would then be
/// read.
std::vector<std::string> as_input(const std::filesystem::path& film);

}  // namespace astro::film
