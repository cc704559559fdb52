#include <gmock/gmock.h>

#include <cmath>
#include <optional>

#include "host/calibration/end_poses/end_pose_csv.hpp"
#include "host/calibration/end_poses/odd_run.hpp"
#include "host/calibration/end_poses/umbmark.hpp"
#include "host/calibration/judgement/remarks.hpp"
#include "host/calibration/preparation/preparation.hpp"
#include "host/calibration/preparation/preparation_problem.hpp"
#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/files/folder_sessions.hpp"
#include "host/formats/tables/text_file.hpp"
#include "host/import/drives/import_drives.hpp"
#include "host/truth/files/tracker_file.hpp"
#include "tests/support/base/places.hpp"
#include "tests/support/base/remarks.hpp"

// Files that people had and that were refused or misunderstood. The robot was simulated, so the right answer is known.
namespace astro::importing {
namespace {

namespace fs = std::filesystem;
using support::Tells;
using support::told_by;
using testing::Contains;

using calibration::EndPose;

class Field : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(folder_)) GTEST_SKIP() << "there is no " << folder_;
  }

  /// The drives of a folder: wN.csv with gN.tum.
  std::vector<DriveFiles> drives(const std::string& name, const std::string& end = "") const {
    std::vector<DriveFiles> files;
    for (int i = 1; i <= 4; ++i) {
      const std::string number = std::to_string(i);
      const fs::path wheels = folder_ / name / ("w" + number + end + ".csv");
      if (fs::exists(wheels)) files.push_back({wheels, folder_ / name / ("g" + number + ".tum")});
    }
    return files;
  }

  static ImportChoices robot(std::optional<double> counts_per_turn = {}) {
    ImportChoices choices;
    choices.geometry.wheel_diameter_m = 0.066;
    choices.geometry.wheelbase_m = 0.16;
    choices.geometry.counts_per_turn = counts_per_turn;
    return choices;
  }

  static experiment::Calibration calibrated(const experiment::RunSet& set) {
    return experiment::calibrate(set, {experiment::MethodChoice::Family::ml, {}});
  }

  static void expect_right(const experiment::Calibration& found, double sigmas) {
    const auto off = [](double value, double right, double error) { return std::abs(value - right) / error; };
    EXPECT_LT(off(found.factors.c_r, 1.006, found.se.c_r), sigmas);
    EXPECT_LT(off(found.factors.c_l, 0.995, found.se.c_l), sigmas);
    EXPECT_LT(off(found.factors.b_m, 0.160, found.se.b_m), sigmas);
  }

  const fs::path folder_ = support::shared_data() / "field";
};

constexpr double kThreeSigma = 3;

TEST_F(Field, HalfASecondOfLostCountsIsBridged) {
  const experiment::Calibration found = calibrated(import_drives(drives("gap_half_second"), robot()).set);
  expect_right(found, kThreeSigma);
  EXPECT_THAT(calibration::remarks(found.ml()->estimate, false),
              Contains(Tells(calibration::PreparationProblem::odometry_bridged, "w1", "1", "0.5")));
}

TEST_F(Field, BothEncodersReversedAreNamedAndCanBeStated) {
  const std::vector<DriveFiles> files = drives("both_encoders_reversed");
  const auto kind = [&](bool swapped, bool reversed) {
    ImportChoices choices = robot();
    choices.wheels.exchanged = swapped;
    choices.wheels.reversed = reversed;
    return told_by([&] { import_drives(files, choices); }).kind;
  };
  EXPECT_EQ(kind(false, false), Kind(ImportProblem::encoders_reversed));
  EXPECT_EQ(kind(true, false), Kind(ImportProblem::drives_backward)) << "this would exchange the factors";
  ImportChoices choices = robot();
  choices.wheels.reversed = true;
  expect_right(calibrated(import_drives(files, choices).set), kThreeSigma);
}

TEST_F(Field, TwentyCountsInATurnAreEnoughForTheWheelbase) {
  for (const char* rate : {"", "_10hz"}) {
    const experiment::Calibration found =
        calibrated(import_drives(drives("coarse_counts_20_per_turn", rate), robot(20)).set);
    EXPECT_LT(std::abs(found.factors.b_m - 0.160), 2 * found.se.b_m) << rate;
  }
}

TEST_F(Field, AMotiveFileThatASpreadsheetSavedAgainHasItsQuaternion) {
  const fs::path path = folder_ / "motive_lower_case_w/take.csv";
  const Bytes text = tables::text_of_file(path);
  for (const truth::BodyName& body : truth::bodies_in(as_text(text), path.string()))
    EXPECT_EQ(truth::read_track(as_text(text), path.string(), body.name).facts.rotation_kind,
              truth::RotationKind::quaternion)
        << body.name;
}

TEST_F(Field, ASessionOfOneDriveIsHeldOutWithItsOwnLeverArm) {
  std::vector<DriveFiles> files;
  std::vector<fs::path> wheels;
  for (const auto& [session, number] : {std::pair{"A", "1"}, std::pair{"B", "3"}}) {
    const fs::path folder = folder_ / "last_session_single_drive" / session;
    files.push_back({folder / fmt::format("w{}.csv", number), folder / fmt::format("g{}.tum", number)});
    wheels.push_back(files.back().wheels);
  }
  experiment::RunSet set = import_drives(files, robot()).set;
  set.sessions = experiment::sessions_by_folder(wheels);
  expect_right(calibrated(set), kThreeSigma);
}

// Ends of real squares that scatter by 0.4 m. Nothing in them is mistyped.
TEST_F(Field, EndsThatScatterWidelyAreTakenWithTheErrorThatIsDue) {
  const auto ends = [&](const char* name) {
    const fs::path path = folder_ / "end_poses" / name;
    const Bytes text = tables::text_of_file(path);
    return calibration::read_end_poses(as_text(text), path.string()).poses;
  };
  const std::vector<EndPose> cw = ends("endposes_cw.csv"), ccw = ends("endposes_ccw.csv");
  const auto squares_of = [](const std::vector<EndPose>& errors) {
    std::vector<calibration::SquareEnd> squares;
    for (const EndPose& error : errors) squares.push_back({error});
    return squares;
  };
  for (const double side_m : {1.0, 2.0, 4.0}) {  // which of them it was is not known
    const calibration::WheelFactors loaded{1, 1, 0.16};
    for (const calibration::OddRun& odd :
         calibration::odd_runs(squares_of(cw), squares_of(ccw), {side_m, loaded}))
      EXPECT_FALSE(odd.mistake) << side_m << " m: " << described(odd);
    const calibration::Estimate found =
        calibration::estimate_factors(cw, ccw, side_m, loaded, {.method = calibration::Method::robust});
    std::printf("side %g m: E_d %.4f +- %.4f, E_b %.4f +- %.4f\n", side_m, found.E_d, found.se.E_d, found.E_b,
                found.se.E_b);
    // Five ends a way whose means are known to 0.2 m, over four sides and their spins.
    EXPECT_GT(found.se.E_b, 0.2 / (4 * side_m) / 2);
  }
}

}  // namespace
}  // namespace astro::importing
