#include "host/commands/drive/drive_teleop_view.hpp"
#include "tests/support/base/columns.hpp"

#include <gmock/gmock.h>

#include <numbers>

namespace astro::commands {
namespace {

using console::Key;
using console::SteeringWheel;
using testing::HasSubstr;
using testing::Not;

// What a person needs for steering: every key, what is requested of the robot, what it does, and where it is.
void expect_all_that_steers(const std::string& picture) {
  for (const char* const word :
       {"faster", "slower, backwards", "turn left", "turn right", "stop", "quit", "-9.00 m/s", "-9.00 rad/s",
        "is -9.999", "x -999.999 m", "y -999.999 m", "heading -9999.9 deg"})
    EXPECT_THAT(picture, HasSubstr(word));
}

TEST(TeleopPicture, SaysTheSameAt40ColumnsAsAt80) {
  SteeringWheel wheel(9, 9);
  for (int i = 0; i < 5; ++i) {
    wheel.press(Key::backward);
    wheel.press(Key::right);
  }
  recording::OdometrySample at;
  at.v_mps = at.omega_radps = -9.999;
  at.x_m = at.y_m = -999.999;
  at.theta_rad = -9999.9 * std::numbers::pi / 180;
  for (const std::size_t columns : {40U, 41U, 69U, 70U, 80U, 200U}) {
    const std::string picture = teleop_picture("ASTRO", wheel, at, {columns, 24});
    EXPECT_LE(support::widest_line(picture), columns) << picture;
    EXPECT_LE(std::count(picture.begin(), picture.end(), '\n'), 23) << picture;
    expect_all_that_steers(picture);
  }
  EXPECT_THAT(teleop_picture("ASTRO", wheel, at, {80, 24}), HasSubstr("███████████████┃"));
}

TEST(TeleopPicture, GivesUpTheKeysBeforeTheFiguresWhereRowsAreFew) {
  for (const std::size_t columns : {40U, 80U}) {
    const std::string picture = teleop_picture("ASTRO", {0.4, 1}, {}, {columns, 10});
    EXPECT_LE(std::count(picture.begin(), picture.end(), '\n'), 9) << picture;
    EXPECT_THAT(picture, testing::AllOf(HasSubstr("odometry"), HasSubstr("heading 0.0 deg"),
                                        Not(HasSubstr("faster"))));
  }
}

}  // namespace
}  // namespace astro::commands
