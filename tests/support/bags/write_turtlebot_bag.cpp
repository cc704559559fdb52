#include <cstdlib>
#include <iostream>
#include <string>

#include "host/base/error.hpp"
#include "tests/support/bags/turtlebot_bag.hpp"

/// Writes a bag of a TurtleBot-like robot with known errors, for whoever wants to try a calibration on it.
int main(int count, char** words) {
  using namespace astro;
  if (count < 2 || count > 3) {
    std::cerr << "turtlebot_bag OUT [SEED]: OUT is a file that ends in .mcap, or a folder\n";
    return 2;
  }
  support::BagDrive drive;
  drive.seed = drive.robot.seed = drive.scanner.seed = count == 3 ? std::strtoull(words[2], nullptr, 10) : 1;
  drive.robot.true_ed = 1.00416;
  drive.robot.true_wheelbase_m = 0.99521 * drive.robot.nominal_wheelbase_m;
  drive.scanner.mount = {-0.04, 0.01, 0.02};
  drive.stated_mount = {-0.04, 0, 0};
  drive.gyro.scale = 0.01;
  drive.gyro.bias_radps = 0.004;
  drive.room = simulation::rectangular_room({-2, -3.5}, {4.5, 4});
  drive.room.walls.push_back(
      {{-2, 1.5}, {-1.2, 1.5}});  // a cupboard, so that no half of the room looks like the other
  drive.room.walls.push_back({{-1.2, 1.5}, {-1.2, 4}});
  drive.path = support::calibration_drive(1.8, 3);
  try {
    support::record_bag(drive, words[1]);
  } catch (const Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
