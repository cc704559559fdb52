#include "host/simulation/room/room_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <string>

#include "host/experiment/files/toml_file.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::simulation {
namespace {

using support::Tells;
using support::told_by;

class RoomFiles : public testing::Test {
 protected:
  std::string written(const std::string& text) const {
    const std::string path = (folder_.path() / "room.toml").string();
    std::ofstream(path) << text;
    return path;
  }
  Remark refusal(const std::string& text) const {
    return told_by([&] { read_room(written(text)); });
  }

  test::TemporaryFolder folder_;
};

constexpr const char* kWall = "[[wall]]\ncorners = [[0, 0], [4, 0]]\n";

TEST_F(RoomFiles, HoldWallsPeopleAndThePlaceOfTheScanner) {
  const RoomFile file = read_room(
      written("[[wall]]\ncorners = [[-1, -2], [5, -2], [5, 3]]\n[[wall]]\ncorners = [[0, 1], [0.5, 1]]\n"
              "[[person]]\npath = [[2, -1], [2, 2]]\nspeed = 0.5\nradius = 0.3\n[[person]]\npath = [[1, 1]]\n"
              "[scanner]\nx = 0.05\ny = -0.02\nyaw = 90\nupside_down = true\n"));
  ASSERT_EQ(file.room.walls.size(), 3U);
  EXPECT_EQ(file.room.walls[1].from.x_m, 5);
  EXPECT_EQ(file.room.walls[1].to.y_m, 3);
  EXPECT_EQ(file.room.walls[2].to.x_m, 0.5);
  ASSERT_EQ(file.room.people.size(), 2U);
  EXPECT_EQ(file.room.people[0].path.back().y_m, 2);
  EXPECT_EQ(file.room.people[0].speed_mps, 0.5);
  EXPECT_EQ(file.room.people[0].radius_m, 0.3);
  EXPECT_EQ(file.room.people[1].speed_mps, Walker{}.speed_mps);
  EXPECT_EQ(file.scanner_mount.x_m, 0.05);
  EXPECT_EQ(file.scanner_mount.y_m, -0.02);
  EXPECT_DOUBLE_EQ(file.scanner_mount.theta_rad, std::numbers::pi / 2);
  EXPECT_TRUE(file.scanner_upside_down);
}

TEST_F(RoomFiles, WithoutAScannerHaveOneInTheMiddle) {
  const RoomFile file = read_room(written(kWall));
  EXPECT_EQ(file.scanner_mount.x_m, 0);
  EXPECT_EQ(file.scanner_mount.theta_rad, 0);
  EXPECT_FALSE(file.scanner_upside_down);
}

TEST_F(RoomFiles, WithoutWallsAreRefused) {
  const std::string path = written("[scanner]\nx = 0\n");
  EXPECT_THAT(told_by([&] { read_room(path); }), Tells(RoomProblem::no_walls, path));
  EXPECT_THAT(refusal(""), Tells(RoomProblem::no_walls));
}

TEST_F(RoomFiles, NameTheLineAndTheNameThatIsUnknown) {
  const std::string path = written(std::string(kWall) + "corner = [[0, 0], [1, 1]]\n");
  EXPECT_THAT(told_by([&] { read_room(path); }), Tells(RoomProblem::unknown_name, path, "3", "'corner'"));
  EXPECT_THAT(refusal(std::string(kWall) + "[[people]]\npath = [[0, 0]]\n"),
              Tells(RoomProblem::unknown_name));
  EXPECT_THAT(refusal(std::string(kWall) + "[scanner]\nroll = 180\n"), Tells(RoomProblem::unknown_name));
}

TEST_F(RoomFiles, NameTheLineOfAValueThatIsImpossible) {
  const std::string path = written(std::string(kWall) + "[scanner]\nx = 2\n");
  EXPECT_THAT(told_by([&] { read_room(path); }), Tells(RoomProblem::wrong_value, path, "4", "x"));
  for (const char* text :
       {"[[wall]]\ncorners = [[0, 0]]\n", "[[wall]]\ncorners = [[0, 0], [0, 0]]\n", "[[wall]]\n",
        "[[wall]]\ncorners = 3\n", "[[wall]]\ncorners = [[0, 0], [1]]\n",
        "[[wall]]\ncorners = [[0, 0], [1, nan]]\n", "[[wall]]\ncorners = [[0, 0], [1, 2e6]]\n",
        "[[wall]]\ncorners = [[0, 0], [1, \"2\"]]\n", "[wall]\ncorners = [[0, 0], [1, 0]]\n", "wall = 3\n",
        "wall = [3]\n", "scanner = 3\n[[wall]]\ncorners = [[0, 0], [4, 0]]\n"})
    EXPECT_THAT(refusal(text), Tells(RoomProblem::wrong_value)) << text;
  for (const char* text :
       {"[[person]]\npath = []\n", "[[person]]\nspeed = 1\n", "[[person]]\npath = [[0, 0]]\nspeed = -1\n",
        "[[person]]\npath = [[0, 0]]\nradius = 0\n", "[scanner]\nupside_down = 1\n",
        "[scanner]\nyaw = inf\n"})
    EXPECT_THAT(refusal(kWall + std::string(text)), Tells(RoomProblem::wrong_value)) << text;
}

TEST_F(RoomFiles, ThatAreNoTomlAreRefusedByTheLine) {
  EXPECT_THAT(refusal(std::string(kWall) + "corners\n"), Tells(experiment::TomlProblem::not_toml));
}

TEST_F(RoomFiles, HaveABoundedNumberOfWalls) {
  std::string text = "[[wall]]\ncorners = [[0, 0]";
  for (int i = 1; i <= 501; ++i) text += ", [" + std::to_string(i) + ", " + std::to_string(i % 2) + "]";
  EXPECT_THAT(refusal(text + "]\n"), Tells(RoomProblem::too_many));
}

}  // namespace
}  // namespace astro::simulation
