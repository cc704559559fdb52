#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <string>
#include <string_view>

#include "host/film/picture/film_info.hpp"
#include "host/film/picture/film_program.hpp"
#include "host/film/picture/gray_frame.hpp"

namespace astro::film {

/// The pictures of a film one after the other, decoded by ffmpeg, each with its own presentation time: phones drop frames
/// and film at uneven rates, so a frame's number says nothing about its time.
///
/// Memory  one picture, whatever the length of the film.
/// Errors  astro::Error if ffmpeg is not installed or reports no times. A film of which nothing can be decoded has no pictures.
class FrameStream {
 public:
  enum class Pictures : std::uint8_t { all, key_only };

  FrameStream(const std::filesystem::path& film, const FilmInfo& info, Pictures pictures);

  /// Overwrites `frame` with the next picture; false at the end of the film.
  bool next(GrayFrame& frame);

  /// The decoder's last error message; "" if there was none.
  const std::string& complaint() const { return complaint_; }

 private:
  struct Stamp {
    double pts_s;
    bool key;
  };
  void take_line(std::string_view line);

  int width_, height_;
  double time_base_s_ = 0;
  std::deque<Stamp> stamps_;  // of pictures that are still to come
  std::string complaint_;
  FilmProgram decoder_;
};

}  // namespace astro::film
