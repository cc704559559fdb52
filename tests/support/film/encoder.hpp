#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <span>

namespace astro::support::film {

struct Codec {
  double mbit_per_s = 14;  // as phones write; 0: lossless
  const char* preset = "superfast";
};

/// A film on its way to a file, through `ffmpeg` as a child process. Throws std::runtime_error if it cannot be started, ends early
/// or fails.
class Encoder {
 public:
  Encoder(const std::filesystem::path& mp4, int width_px, int height_px, double fps, const Codec& codec);
  ~Encoder();
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  /// `brightness`: width times height numbers. Stamps grow; the file has them in units of 1/90000 s.
  void add(double pts_s, std::span<const std::uint8_t> brightness);
  void finish();

 private:
  void write(std::span<const std::uint8_t> bytes);

  std::filesystem::path mp4_;
  std::FILE* pipe_ = nullptr;
  std::size_t colour_bytes_;
};

}  // namespace astro::support::film
