#include "tests/support/film/film_folder.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "host/experiment/drive/record_run.hpp"
#include "host/recording/run_file.hpp"
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

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kDegrees = 180 / std::numbers::pi;

std::ofstream opened(const fs::path& path) {
  fs::create_directories(path.parent_path());
  std::ofstream file(path);
  if (!file) throw std::runtime_error("cannot write " + path.string());
  file.setf(std::ios::fixed);
  file.precision(7);
  return file;
}

void write_frames(const fs::path& path, const std::vector<TrueFrame>& frames) {
  std::ofstream file = opened(path);
  file << "pts_s,robot_time_s_of_first_row_mid_exposure,tag_x_m,tag_y_m,tag_theta_rad,"
          "row_of_tag,robot_time_s_at_row,tag_x_m_at_row,tag_y_m_at_row,tag_theta_rad_at_row\n";
  for (const TrueFrame& frame : frames)
    file << frame.time.pts_s << ',' << frame.time.robot_s << ',' << frame.at_first_row.x_m << ','
         << frame.at_first_row.y_m << ',' << frame.at_first_row.theta_rad << ',' << frame.row << ','
         << frame.row_s << ',' << frame.at_row.x_m << ',' << frame.at_row.y_m << ',' << frame.at_row.theta_rad
         << '\n';
}

void write_poses(const fs::path& path, const FilmedRobot& robot) {
  std::ofstream file = opened(path);
  file << "robot_time_s,body_x_m,body_y_m,body_theta_rad,tag_x_m,tag_y_m,tag_theta_rad\n";
  const double begin_s = robot.track.begin_s();
  const auto count = static_cast<int>((robot.track.end_s() - begin_s) * 100);
  for (int i = 0; i <= count; ++i) {
    const double time_s = begin_s + i * 0.01;
    const FloorPose body = robot.track.at(time_s), tag = robot.tag_at(time_s);
    file << time_s << ',' << body.x_m << ',' << body.y_m << ',' << body.theta_rad << ',' << tag.x_m << ','
         << tag.y_m << ',' << tag.theta_rad << '\n';
  }
}

Json robot_json(const sim::Config& robot) {
  const double E_d = robot.true_ed, S = robot.scale;
  return {{"E_d", E_d},
          {"b_m", robot.true_wheelbase_m},
          {"S", S},
          {"b_over_S_m", robot.true_wheelbase_m / S},
          {"c_R", 2 * S * E_d / (1 + E_d)},
          {"c_L", 2 * S / (1 + E_d)},
          {"K_m", robot.slip_m}};
}

Json camera_json(const FilmSetup& setup) {
  const Lens& lens = setup.lens;
  const Camera camera = setup.camera(0);
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row)
    rows.push_back(
        {camera.world_to_camera(row, 0), camera.world_to_camera(row, 1), camera.world_to_camera(row, 2)});
  return {{"size", {lens.width_px, lens.height_px}},
          {"f_px", lens.f_px},
          {"cx", lens.cx_px},
          {"cy", lens.cy_px},
          {"k1_k2_p1_p2_k3", {lens.k1, lens.k2, lens.p1, lens.p2, lens.k3}},
          {"position_m", {camera.position_m.x(), camera.position_m.y(), camera.position_m.z()}},
          {"R_world_to_camera", rows},
          {"readout_s", setup.shutter.readout_s},
          {"exposure_s", setup.shutter.exposure_s},
          {"fps", setup.clock.fps},
          {"blur_px", setup.blur_px},
          {"mbit_per_s", setup.codec.mbit_per_s}};
}

Json tags_json(const Scene& scene) {
  Json floor = Json::array();
  for (const FloorTag& tag : scene.floor)
    floor.push_back({{"id", tag.paper.id()},
                     {"x_m", tag.pose.x_m},
                     {"y_m", tag.pose.y_m},
                     {"z_m", tag.z_m},
                     {"yaw_deg", tag.pose.theta_rad * kDegrees},
                     {"side_m", tag.paper.side_m()}});
  return floor;
}

Json truth_json(const FilmSetup& setup, const sim::Config& robot, const std::vector<TrueFrame>& frames) {
  const FilmedRobot& filmed = setup.scene.robots.front();
  return {{"robot", robot_json(robot)},
          {"camera", camera_json(setup)},
          {"robot_tag",
           {{"id", filmed.paper.id()},
            {"side_m", filmed.paper.side_m()},
            {"height_m", filmed.height_m},
            {"x_m", filmed.lever.x_m},
            {"y_m", filmed.lever.y_m},
            {"yaw_deg", filmed.lever.theta_rad * kDegrees},
            {"tilt_deg", {filmed.tilt_x_rad * kDegrees, filmed.tilt_y_rad * kDegrees}}}},
          {"floor_tags", tags_json(setup.scene)},
          {"clock",
           {{"phone_skew", setup.clock.skew},
            {"pts_jitter_s", setup.clock.stamp_s},
            {"robot_time_at_pts_zero_s", frames.front().time.robot_s - frames.front().time.pts_s}}}};
}

Json stated_json(const Stated& stated, const Scene& scene) {
  return {{"robot_tag_side_m", stated.robot_tag_m},
          {"robot_tag_height_m", stated.height_m},
          {"floor_tag_side_m", stated.floor_tag_m},
          {"distance_from_tag", scene.floor[stated.from].paper.id()},
          {"distance_to_tag", scene.floor[stated.to].paper.id()},
          {"distance_m", stated.distance_m},
          {"readout_s", stated.readout_s}};
}

}  // namespace

void write_film_folder(const fs::path& folder, const FilmSetup& setup, const FilmedDrives& drives,
                       const sim::Config& robot, const Stated& stated) {
  fs::create_directories(folder);
  const std::vector<TrueFrame> frames = make_film(setup, folder / "film.mp4");
  for (std::size_t run = 0; run < drives.runs.size(); ++run)
    recording::write_run(folder / "runs" / (drives.names[run] + ".mcap"), drives.runs[run]);
  write_frames(folder / "truth" / "truth_frames.csv", frames);
  write_poses(folder / "truth" / "truth_poses.csv", setup.scene.robots.front());
  opened(folder / "truth" / "truth.json") << truth_json(setup, robot, frames).dump(1) << '\n';
  opened(folder / "stated.json") << stated_json(stated, setup.scene).dump(1) << '\n';
}

}  // namespace astro::support::film
