#include "tests/host/guides/stage.hpp"

#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "tests/host/import/scans/carmen_text.hpp"
#include "tests/host/import/scans/scan_bag.hpp"
#include "tests/support/ros2/domain.hpp"

namespace astro::guides {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

void run(const Words& words) {
  const support::Outcome outcome = support::astrolabe(words);
  if (outcome.code != 0)
    throw std::runtime_error("the stage cannot be set: astrolabe " + words[0] + ": " + outcome.err);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// Columns of an export, which has names of its own, under the names that somebody else's script would give.
void write_columns(const fs::path& from, const fs::path& to, const std::string& head,
                   const std::vector<int>& columns) {
  std::ifstream in(from);
  std::ofstream out(to);
  out << head << '\n';
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    Words cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    for (std::size_t i = 0; i < columns.size(); ++i) out << (i == 0 ? "" : ",") << cells.at(columns[i]);
    out << '\n';
  }
}

}  // namespace

Stage::Stage(const Setting& setting) : instead_(setting.instead) {
  if (!setting.robot.empty()) {
    Words options{"--true-ed", "1.00416", "--true-wheelbase", "0.28861", "--slip", "2.645e-6", "--seed", "1"};
    options.insert(options.end(), setting.robot.begin(), setting.robot.end());
    robot_ = std::make_unique<support::Simulator>(options);
  }
  // No other run of the tests is in this domain.
  setenv("ROS_DOMAIN_ID", std::to_string(support::test_domain()).c_str(), 1);
  if (setting.tracker) tracked_ = std::make_unique<support::Simulator>(Words{"--ros2-topic", "/ASTRO/pose"});
  for (const std::string& file : setting.files) {
    if (file == "drives") drive();
    if (file == "scans") scan();
    if (file == "experiment")
      run({"umbmark", "--port", robot_->port(), "--truth", "sim", "--runs", "2", "--side", "2", "--out",
           (folder() / "my-experiment").string(), "--yes"});
  }
}

void Stage::drive() {
  const support::Simulator other(
      {"--fast", "--true-ed", "1.00416", "--true-wheelbase", "0.28861", "--slip", "2.645e-6"});
  const std::string drives = (folder() / "recorded").string();
  run({"record", "--squares", "4", "--side", "2", "--port", other.port(), "--truth", "sim", "--out", drives});
  run({"export", drives, "--rosbag", (folder() / "bags").string()});
  int number = 0;
  for (const std::string run_name : {"square-cw-1", "square-ccw-1", "square-cw-2", "square-ccw-2"}) {
    const fs::path csv = folder() / "csv" / run_name;
    run({"export", drives + "/" + run_name + ".mcap", "--csv", csv.string()});
    const std::string n = std::to_string(++number);
    write_columns(csv / "odometry.csv", folder() / ("drive" + n + ".csv"), "time_s,left_counts,right_counts",
                  {0, 6, 7});
    write_columns(csv / "truth.csv", folder() / ("take" + n + ".csv"), "time_s,x_m,y_m,theta_rad",
                  {0, 1, 2, 3});
  }
  fs::remove_all(folder() / "recorded");
  fs::remove_all(folder() / "csv");
}

void Stage::scan() {
  lidar::Scanner scanner;
  scanner.beams = 180;
  scanner.view_rad = std::numbers::pi;
  scanner.period_s = 0.4;
  lidar::SyntheticDrive drive(lidar::furnished_room(), {{1.013, 1.007, 0.306}, 2e-6}, scanner, 41);
  lidar::drive_both_ways(drive, 3);
  std::ofstream(folder() / "robot.log") << importing::carmen_text(drive, true);
  importing::write_scan_bag(folder() / "scans.mcap", drive, {"/scan"}, 1'790'000'000'000'000'000);
}

std::string Stage::here(std::string command) const {
  for (const auto& [word, stand_in] : instead_) command = replaced(command, word, stand_in);
  if (robot_) command = replaced(command, "/dev/ttyACM0", robot_->port());
  return replaced(command, "/tmp/", folder().string() + "/");
}

std::string Stage::as_on_page(std::string output) const {
  if (robot_) output = replaced(output, robot_->port(), "/dev/ttyACM0");
  return replaced(output, folder().string() + "/", "/tmp/");
}

}  // namespace astro::guides
