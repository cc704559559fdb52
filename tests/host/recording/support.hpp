#pragma once

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>

#include "host/base/bytes.hpp"
#include "host/base/pose2.hpp"
#include "host/base/text/sense.hpp"
#include "host/recording/run.hpp"

/// What several tests of recordings need.
namespace astro::recording::support {

/// A temporary folder for one test, removed with the object.
class TempFolder {
 public:
  TempFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "astro-recording-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
    path_ = pattern;
  }
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline void spill(const std::filesystem::path& path, ByteView bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// A drive of 3 s at 100 Hz: `rest_s` of standstill, then from the start to `odometry_end` (as odometry sees
/// it) and `truth_end` (as it is), both seen from the start, then standstill again.
struct Drive {
  Pose2 odometry_frame, truth_frame;  // the start pose in the two frames
  Pose2 odometry_end, truth_end;
  double rest_s = 0.5;
  double noise_m = 0, noise_rad = 0;  // of truth, one standard deviation
  unsigned seed = 1;

  Run run() const {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    Run out;
    out.info.kind = "square";
    out.info.direction = Sense::cw;
    out.info.index = 3;
    out.info.phase = "before";
    for (int i = 0; i <= 300; ++i) {
      const double share = std::clamp((0.01 * i - rest_s) / (3 - 2 * rest_s), 0.0, 1.0);
      const std::int64_t time_us = 5'000'000 + 10'000 * i;
      const Pose2 o = odometry_frame * part(odometry_end, share);
      const Pose2 t = truth_frame * part(truth_end, share);
      const auto counts = static_cast<std::int32_t>(10'000 * share);
      out.odometry.push_back({time_us, o.x_m, o.y_m, o.theta_rad, 0.1, 0.2, counts, -counts});
      out.truth.push_back({time_us + 1234, t.x_m + noise_m * normal(random), t.y_m + noise_m * normal(random),
                           t.theta_rad + noise_rad * normal(random), true});
    }
    return out;
  }

 private:
  static Pose2 part(const Pose2& pose, double share) {
    return {share * pose.x_m, share * pose.y_m, share * pose.theta_rad};
  }
};

}  // namespace astro::recording::support
