#include "tests/support/film/filmed_drives.hpp"

#include <chrono>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "host/experiment/drive/record_run.hpp"
#include "host/robot/parameters/parameters.hpp"
#include "host/simulation/robot/in_process.hpp"

namespace astro::support::film {
namespace {

constexpr int kTruthEvery = 10;  // of the track's samples, in a recording

/// What the robot really does, without noise, in each millisecond. What passes here also goes into the track.
class TrueMotion : public truth::Source {
 public:
  explicit TrueMotion(std::shared_ptr<simulation::VirtualRobot> robot) : robot_(std::move(robot)) {}

  std::vector<recording::TruthSample> poll() override {
    std::vector<recording::TruthSample> seen = robot_->take_truth();
    all_.insert(all_.end(), seen.begin(), seen.end());
    return seen;
  }
  std::string name() const override { return "sim"; }
  std::string clock() const override { return "robot"; }

  PoseTrack track() const {
    std::vector<FloorPose> poses;
    for (const recording::TruthSample& sample : all_) {
      if (sample.time_us != all_.front().time_us + static_cast<std::int64_t>(poses.size()) * 1000)
        throw std::logic_error("the true path has a hole");
      poses.push_back({sample.x_m, sample.y_m, sample.theta_rad});
    }
    return {static_cast<double>(all_.front().time_us) * 1e-6, 1e-3, std::move(poses)};
  }

 private:
  std::shared_ptr<simulation::VirtualRobot> robot_;
  std::vector<recording::TruthSample> all_;
};

simulation::MocapConfig exact_cameras() {
  simulation::MocapConfig cameras;
  cameras.rate_hz = 1000;
  cameras.position_sd_m = cameras.heading_sd_rad = 0;
  cameras.origin = {};
  return cameras;
}

void thin(std::vector<recording::TruthSample>& truth) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < truth.size(); i += kTruthEvery) truth[kept++] = truth[i];
  truth.resize(kept);
}

}  // namespace

DriveWish square_wish(double side_m, Sense sense, int index) {
  constexpr robot::PathLimits kLimits{0.4, 1.5};
  DriveWish wish{"square-" + std::string(name_of(sense)) + "-" + std::to_string(index),
                 {},
                 robot::square(side_m, sense, kLimits)};
  wish.info.kind = "square";
  wish.info.direction = sense;
  wish.info.index = index;
  wish.info.size_m = side_m;
  wish.info.speed_mps = kLimits.speed_mps;
  return wish;
}

DriveWish free_wish(const std::string& name, robot::Path path) {
  DriveWish wish{name, {}, std::move(path)};
  wish.info.kind = "free";
  wish.info.index = 1;
  return wish;
}

FilmedDrives film_drives(const sim::Config& config, const FloorPose& start,
                         const std::vector<DriveWish>& wishes, double rest_s) {
  const auto robot = std::make_shared<simulation::VirtualRobot>(config, exact_cameras());
  robot->board().place({start.x_m, start.y_m, start.theta_rad});
  robot::Client client(std::make_unique<simulation::InProcessTransport>(robot));
  client.connect();
  client.pump(std::chrono::milliseconds(50));  // through boot
  TrueMotion truth(robot);
  const auto rest = [&] {
    client.pump(std::chrono::milliseconds(std::lround(rest_s * 1000)));
    truth.poll();
  };
  std::vector<std::string> names;
  std::vector<recording::Run> runs;
  rest();
  for (const DriveWish& wish : wishes) {
    recording::RunInfo info = wish.info;
    info.parameters = robot::RemoteParameters::fetch(client).numbers();
    info.robot_name = "filmed robot";
    runs.push_back(experiment::record_run(client, truth, wish.path, info, {}));
    thin(runs.back().truth);
    names.push_back(wish.name);
    rest();
  }
  return {names, runs, truth.track()};
}

}  // namespace astro::support::film
