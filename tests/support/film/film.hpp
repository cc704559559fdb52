#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "tests/support/film/frame_times.hpp"
#include "tests/support/film/picture/renderer.hpp"

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

/// All that a film is made from. Times are the robot's clock unless they say otherwise.
struct FilmSetup {
  Scene scene;  // the robot that matters is the first one
  Lens lens;
  double blur_px = 0.65;
  SensorModel sensor;
  Shutter shutter;
  FilmClock clock;
  Codec codec;
  /// The camera at a frame's stamp.
  std::function<Camera(double pts_s)> camera;
  double begin_s = 0, end_s = 0;
  std::optional<Cut> cut;
  std::uint64_t seed = 1;
};

/// The first robot's tag in a frame, as it really was.
struct TrueFrame {
  FrameTime time;
  FloorPose at_first_row;  // at time.robot_s
  double row = 0;          // of the tag's centre when its row was exposed
  double row_s = 0;        // the robot's time then
  FloorPose at_row;        // and the pose
};

TrueFrame true_frame(const FilmSetup& setup, const FrameTime& time);

/// Renders all frames into an MP4. Throws what Encoder does.
std::vector<TrueFrame> make_film(const FilmSetup& setup, const std::filesystem::path& mp4);

}  // namespace astro::support::film
