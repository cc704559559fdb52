#include "host/calibration/end_poses/end_pose.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <vector>

#include "host/calibration/end_poses/end_pose_problem.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::calibration {
namespace {

using support::ThrowsTelling;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const std::vector<EndPose> kNear{{3, 4, 0.1}, {3, 4, 0.3}, {6, 1, 0.2}};

TEST(Summary, MeansRmsAndStandardErrorsOfThreeRuns) {
  const ClusterSummary s = summarize(kNear);
  EXPECT_EQ(s.runs, 3);
  EXPECT_DOUBLE_EQ(s.x_cg_m, 4);
  EXPECT_DOUBLE_EQ(s.y_cg_m, 3);
  EXPECT_DOUBLE_EQ(s.r_cg_m, 5);
  EXPECT_DOUBLE_EQ(s.theta_cg_rad, 0.2);
  EXPECT_DOUBLE_EQ(s.rms_x_m, std::sqrt(54.0 / 3));
  EXPECT_DOUBLE_EQ(s.rms_y_m, std::sqrt(33.0 / 3));
  EXPECT_DOUBLE_EQ(s.rms_r_m, std::sqrt(87.0 / 3));
  EXPECT_DOUBLE_EQ(s.rms_theta_rad, std::sqrt(0.14 / 3));
  EXPECT_DOUBLE_EQ(s.se_x_m, 1);  // deviations -1, -1, 2: variance 3, of the mean 1
  EXPECT_DOUBLE_EQ(s.se_y_m, 1);
  EXPECT_DOUBLE_EQ(s.se_r_m, std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(s.se_theta_rad, 0.1 / std::sqrt(3.0));
  EXPECT_TRUE(s.has_theta);
}

TEST(Summary, OneRunHasAMeanAndNoStandardError) {
  const ClusterSummary s = summarize(std::vector<EndPose>{{3, -4, 0.1}});
  EXPECT_DOUBLE_EQ(s.r_cg_m, 5);
  EXPECT_TRUE(std::isnan(s.se_x_m) && std::isnan(s.se_y_m) && std::isnan(s.se_r_m) &&
              std::isnan(s.se_theta_rad));
}

TEST(Summary, RunsWithoutHeadingsKeepTheirPositions) {
  const ClusterSummary s = summarize(std::vector<EndPose>{{1, 0, kNaN}, {3, 0, kNaN}});
  EXPECT_FALSE(s.has_theta);
  EXPECT_TRUE(std::isnan(s.theta_cg_rad) && std::isnan(s.rms_theta_rad) && std::isnan(s.se_theta_rad));
  EXPECT_DOUBLE_EQ(s.x_cg_m, 2);
  EXPECT_DOUBLE_EQ(s.se_x_m, 1);
}

TEST(Summary, MaximumIsTheWorseDirectionWithItsStandardError) {
  const std::vector<EndPose> far{{-8, 6, 0}, {-8, 6, 0}};
  for (const ExperimentSummary& s : {summarize(kNear, far), summarize(far, kNear)}) {
    EXPECT_DOUBLE_EQ(s.E_max_syst_m, 10);
    EXPECT_DOUBLE_EQ(s.se_E_max_syst_m, 0);
  }
  EXPECT_DOUBLE_EQ(summarize(kNear, kNear).se_E_max_syst_m, std::sqrt(2.0));
}

TEST(Summary, RefusesWhatIsNoMeasurement) {
  const Remark of_none = support::told_by([] { summarize(std::vector<EndPose>{}); });
  EXPECT_THAT(of_none, support::Tells(EndPoseProblem::no_run));
  EXPECT_THAT(of_none.values, testing::IsEmpty()) << "no direction";
  for (const EndPose& bad : {EndPose{kNaN, 0, 0}, EndPose{0, INFINITY, 0}, EndPose{0, 0, -INFINITY}})
    EXPECT_THAT(([&] {
                  summarize(std::vector<EndPose>{{0, 0, 0}, bad});
                }),
                ThrowsTelling(EndPoseProblem::not_finite, "run 2"));
}

TEST(Summary, OfHeadingsThatSomeRunsLackIsThatOfTheOthers) {
  const ClusterSummary s = summarize(std::vector<EndPose>{{3, 4, 0.1}, {3, 4, kNaN}, {6, 1, 0.3}});
  EXPECT_TRUE(s.has_theta);
  EXPECT_DOUBLE_EQ(s.x_cg_m, 4) << "no place is lost with its heading";
  EXPECT_DOUBLE_EQ(s.se_x_m, 1);
  EXPECT_DOUBLE_EQ(s.theta_cg_rad, 0.2);
  EXPECT_DOUBLE_EQ(s.rms_theta_rad, std::sqrt(0.05));
  EXPECT_DOUBLE_EQ(s.se_theta_rad, 0.1);
}

TEST(Summary, NamesTheDirectionOfABadRun) {
  const std::vector<EndPose> bad{{0, kNaN, 0}};
  EXPECT_THAT([&] { summarize(kNear, bad); },
              ThrowsTelling(EndPoseProblem::not_finite, "counter-clockwise run 1"));
  EXPECT_THAT([&] { summarize(bad, kNear); }, ThrowsTelling(EndPoseProblem::not_finite, "clockwise run 1"));
  EXPECT_THAT(([&] { summarize({}, kNear); }), ThrowsTelling(EndPoseProblem::no_run, "clockwise"));
}

}  // namespace
}  // namespace astro::calibration
