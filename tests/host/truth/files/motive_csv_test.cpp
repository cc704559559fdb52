#include "host/truth/files/motive_csv.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/truth/files/track_problem.hpp"
#include "host/truth/files/tracker_file.hpp"
#include "tests/host/truth/files/own_recordings.hpp"
#include "tests/host/truth/recorded_files.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::truth {
namespace {

using support::Tells;
using support::ThrowsTelling;
using test::kMotive;
using test::shared_file;
using test::text_of_file;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

Remark refusal_of_take(const std::string& text) {
  return support::told_by([&] { read_motive(text, "take.csv"); });
}

/// Of something that is called: it does not know which body of take.csv is meant, and names all of them.
auto RefusesBody(const std::string& wanted, const std::vector<BodyName>& bodies) {
  return testing::Throws<UnknownBody>(
      testing::AllOf(testing::Property(&Error::remark, Tells(BodyProblem::unknown, "take.csv", wanted)),
                     testing::Property(&UnknownBody::bodies, bodies)));
}

double turn_about_y(const Pose3& p) { return 2 * std::atan2(p.qy, p.qw); }

TEST(MotiveCsv, GivesMetresAndTheTimesOfTheFrameNumbers) {
  const BodyTrack track = read_motive(kMotive, "take.csv");
  EXPECT_EQ(track.name, "astro");
  EXPECT_EQ(track.id, "4CF0");
  ASSERT_EQ(track.samples.size(), 4U);
  EXPECT_EQ(track.samples[0].time_ns, 600'000'000);
  EXPECT_EQ(track.samples[1].time_ns, 608'333'333);
  EXPECT_DOUBLE_EQ(track.samples[0].pose.x_m, 0.1);
  EXPECT_DOUBLE_EQ(track.samples[0].pose.z_m, -0.2);
  EXPECT_NEAR(turn_about_y(track.samples[0].pose), 0.2, 2e-6);  // six digits of sine and cosine of 0.1
  EXPECT_EQ(track.facts.rate_hz, 120);
  EXPECT_EQ(track.facts.length_unit, "Millimeters");
  EXPECT_EQ(track.facts.format, "Motive CSV 1.23");
  EXPECT_EQ(track.facts.start_time, "2026-08-04T15:25:40.230");
  EXPECT_TRUE(track.facts.start_time_sure);
  EXPECT_TRUE(track.facts.remarks.empty());
}

TEST(MotiveCsv, EmptyCellsAreALostBodyAndMissingFramesAreCounted) {
  const BodyTrack track = read_motive(kMotive, "take.csv");
  EXPECT_TRUE(track.samples[1].valid);
  EXPECT_FALSE(track.samples[2].valid);
  EXPECT_TRUE(track.samples[3].valid);  // the row ends early, behind what is needed
  EXPECT_EQ(track.facts.dropped_frames, 2);
}

TEST(MotiveCsv, ASpreadsheetMayHaveSavedItAgain) {
  std::string saved = "\xEF\xBB\xBF" + replaced(replaced(kMotive, ",", ";"), ".", ",");
  saved = replaced(replaced(saved, "1,23", "1.23"), "\r\n", ";;;;\r\n");
  const BodyTrack track = read_motive(saved, "take.csv");
  ASSERT_EQ(track.samples.size(), 4U);
  EXPECT_DOUBLE_EQ(track.samples[1].pose.x_m, 0.1001);
  EXPECT_EQ(track.samples[1].time_ns, 608'333'333);
  EXPECT_EQ(track.facts.rate_hz, 120);
}

TEST(MotiveCsv, EulerAnglesAreThoseOfTheStatedOrder) {
  std::string euler = replaced(kMotive, "Quaternion", "YXZ");
  euler = replaced(euler, ",Rotation,Rotation,Rotation,Rotation,", ",Rotation,Rotation,Rotation,,");
  euler = replaced(euler, "(Seconds),X,Y,Z,W,", "(Seconds),Y,X,Z,,");
  euler = replaced(euler, "0.000000,0.099833,0.000000,0.995004", "90,30,0,");
  const BodyTrack track = read_motive(euler, "take.csv");
  // A quarter turn about y, then 30 degrees about the new x axis, which is -z of the frame.
  const Pose3& p = track.samples[0].pose;
  const double c = std::cos(std::numbers::pi / 12), s = std::sin(std::numbers::pi / 12), h = std::sqrt(0.5);
  EXPECT_NEAR(p.qw, h * c, 1e-12);
  EXPECT_NEAR(p.qx, h * s, 1e-12);
  EXPECT_NEAR(p.qy, h * c, 1e-12);
  EXPECT_NEAR(p.qz, -h * s, 1e-12);
  EXPECT_EQ(track.facts.rotation, "Euler angles YXZ in degrees");
}

TEST(MotiveCsv, HeadingRowsMayLackLabelsOrHaveAParentRow) {
  std::string old = replaced(replaced(replaced(kMotive, ",Type,", ",,"), ",Name,", ",,"), ",ID,", ",,");
  old = replaced(old, "Time (Seconds)", "Time");
  EXPECT_EQ(read_motive(old, "take.csv").samples.size(), 4U);
  const std::string parent = replaced(kMotive, ",,Rotation", ",Parent,,,,,,,,,,,\r\n,,Rotation");
  EXPECT_EQ(read_motive(parent, "take.csv").name, "astro");
}

TEST(MotiveCsv, BodiesOfOneNameAreToldApartByTheirIds) {
  std::string two = replaced(kMotive, "Marker,Marker,Marker\r", "Rigid Body,Rigid Body,Rigid Body\r");
  two = replaced(two, "loose 1", "astro");
  const std::vector<BodyName> both{{"astro", "4CF0"}, {"astro", "5A"}};
  EXPECT_EQ(bodies_in_motive(two, "take.csv"), both);
  EXPECT_THAT([&] { read_motive(two, "take.csv", "astro"); }, RefusesBody("astro", both));
  const BodyTrack loose = read_motive(two, "take.csv", "5A");
  EXPECT_DOUBLE_EQ(loose.samples[0].pose.y_m, 2e-3);
  EXPECT_EQ(loose.facts.rotation_kind, RotationKind::none);
}

TEST(MotiveCsv, ABodyThatIsNotThereGivesTheListAsData) {
  EXPECT_THAT([] { read_motive(kMotive, "take.csv", "asto"); }, RefusesBody("asto", {{"astro", "4CF0"}}));
}

TEST(MotiveCsv, ErrorsNameLineAndColumn) {
  EXPECT_THAT(refusal_of_take(replaced(kMotive, "-200.2", "2oo")),
              Tells(TrackProblem::not_a_number, "take.csv", "9", "9", "2oo"));
  EXPECT_THAT(refusal_of_take(replaced(kMotive, "\r\n73,", "\r\nx,")),
              Tells(TrackProblem::no_frame_number, "take.csv", "9", "1", "x"));
  EXPECT_THAT(refusal_of_take(replaced(kMotive, "\r\n73,", "\r\n71,")),
              Tells(TrackProblem::time_not_increasing, "take.csv", "9"));
  EXPECT_THAT(refusal_of_take(replaced(kMotive, "Millimeters", "Parsecs")),
              Tells(TrackProblem::length_unit_unknown, "take.csv", "7", "Parsecs"));
}

TEST(MotiveCsv, AHeaderThatIsMissingIsNamed) {
  const std::string rows = "0,0.000000,0.1,0.2,0.3,0.9,1,2,3\n1,0.008333,0.1,0.2,0.3,0.9,1,2,3\n";
  EXPECT_THAT([&] { read_track(rows, "bare.csv"); }, ThrowsTelling(TrackProblem::no_header, "bare.csv"));
}

TEST(MotiveCsv, AStartTimeOnATwelveHourClockIsUnsure) {
  bool sure = true;
  EXPECT_EQ(motive_start_time("2020-12-23 01.18.10.123 ", sure), "2020-12-23T01:18:10.123");
  EXPECT_FALSE(sure);
  EXPECT_EQ(motive_start_time("2023-11-28 10.27.58.765 DU.", sure), "2023-11-28T22:27:58.765");
  EXPECT_TRUE(sure);
  EXPECT_EQ(motive_start_time("2023-11-28 12.27.58.765 AM", sure), "2023-11-28T00:27:58.765");
  EXPECT_EQ(motive_start_time("yesterday", sure), "");
}

TEST(MotiveCsv, ReadsTheRealFilesOfVersions121And123) {
  const std::string path = shared_file("samples/motive_csv/v1.23_aolab_240hz_signflip.csv");
  SKIP_WITHOUT(path);
  const BodyTrack track = read_motive(text_of_file(path), path);
  EXPECT_EQ(track.samples.size(), 10460U);
  EXPECT_EQ(track.facts.rate_hz, 240);
  EXPECT_EQ(track.samples.back().time_ns, 43'579'166'667);
  EXPECT_TRUE(track.facts.remarks.empty());
  const std::string old = shared_file("samples/motive_csv/v1.21_hmv_rigidbody_plus_markers.csv");
  const BodyTrack first = read_motive(text_of_file(old), old);
  EXPECT_EQ(first.name, "Rigid Body 1");
  EXPECT_EQ(first.samples.size(), 250U);
  EXPECT_DOUBLE_EQ(first.samples[0].pose.z_m, 0.076611);
  EXPECT_EQ(first.facts.start_time, "2016-01-05T15:49:50.755");
}

TEST(MotiveCsv, ATimeCodeSettlesTheHalfOfTheDayInARealHeader) {
  const std::string path = shared_file("samples/motive_csv/v1.24_SYNTHETIC_timecode_rigidbody.csv");
  SKIP_WITHOUT(path);
  const BodyTrack track = read_motive(text_of_file(path), path);
  EXPECT_EQ(track.facts.start_time, "2026-08-04T15:25:40.230");
  EXPECT_TRUE(track.facts.start_time_sure);
  EXPECT_DOUBLE_EQ(track.samples[0].pose.x_m, 0.1);
  EXPECT_FALSE(track.samples[2].valid);
}

TEST(MotiveCsv, RealFilesWithoutRigidBodiesSayWhatToExport) {
  for (const char* name : {"v1.23_ha5_no_assets_mm_locale_ampm.csv", "v1.23_ha5_markers_only_mm.csv"}) {
    const std::string path = shared_file(std::string("samples/motive_csv/") + name);
    SKIP_WITHOUT(path);
    EXPECT_THAT([&] { read_motive(text_of_file(path), name); },
                ThrowsTelling(TrackProblem::no_rigid_body, name));
  }
}

TEST(MotiveCsv, AFileThatASpreadsheetSavedHasTimesThatDisagree) {
  const std::string path = shared_file("samples/motive_csv/v1.23_aolab_excel_resaved.csv");
  SKIP_WITHOUT(path);
  const BodyTrack track = read_motive(text_of_file(path), path);
  EXPECT_EQ(track.samples.size(), 2U);
  ASSERT_EQ(track.facts.remarks.size(), 1U);
  EXPECT_THAT(track.facts.remarks[0], Tells(TrackRemark::times_disagree, "496"));
}

}  // namespace
}  // namespace astro::truth
