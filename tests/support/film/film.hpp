#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "tests/support/film/encoder.hpp"
#include "tests/support/film/frame_times.hpp"
#include "tests/support/film/picture/renderer.hpp"

namespace astro::support::film {

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
