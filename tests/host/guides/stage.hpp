#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/programs/program.hpp"

/// What stands on the reader's computer while a page is tried.
namespace astro::guides {

/// What a page needs before its first command.
struct Setting {
  std::string page;                             // from the root of the checkout
  std::vector<std::string> robot = {"--fast"};  // options of the simulated robot at /dev/ttyACM0; {}: none
  bool tracker = false;                         // another one in real time publishes /ASTRO/pose in ROS 2
  std::vector<std::string> files = {};          // made beforehand: see Stage
  std::vector<std::string> absent = {};         // files that a page names and this test does not have
  std::vector<std::pair<std::string, std::string>> instead =
      {};  // words of commands and what stands here for them
};

/// A folder with the files, and a robot. Made from the simulator's own drives, except for scans.
///
/// Files  "drives": drive1.csv to drive4.csv, take1.csv to take4.csv and the bags of these drives in bags/.
///        "scans":  scans.mcap and robot.log of a robot with a laser scanner in a furnished room.
///        "experiment": my-experiment, driven with the robot.
class Stage {
 public:
  explicit Stage(const Setting& setting);

  std::filesystem::path folder() const { return folder_.path(); }
  /// The command as it is run here: names of ports and of trackers of the page are replaced.
  std::string here(std::string command) const;
  /// Output as the page has it.
  std::string as_on_page(std::string output) const;

 private:
  void drive();
  void scan();

  test::TemporaryFolder folder_;
  std::unique_ptr<support::Simulator> robot_, tracked_;
  std::vector<std::pair<std::string, std::string>> instead_;
};

}  // namespace astro::guides
