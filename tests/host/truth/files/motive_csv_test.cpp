#include "host/truth/files/motive_csv.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/truth/files/tracker_file.hpp"
#include "tests/host/truth/files/own_recordings.hpp"
#include "tests/host/truth/recorded_files.hpp"

namespace astro::truth {
namespace {

using test::kMotive;
using test::shared_file;
using test::text_of_file;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// Of an error as a sentence; "" if there is none.
std::string refusal(const std::string& text, const std::string& body = "") {
  try {
    read_motive(text, "take.csv", body);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
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
  EXPECT_EQ(bodies_in_motive(two, "take.csv"), (std::vector<BodyName>{{"astro", "4CF0"}, {"astro", "5A"}}));
  EXPECT_EQ(refusal(two, "astro"),
            "'take.csv' holds several bodies of the name 'astro', but 'astro' (id 4CF0), 'astro' (id 5A)");
  const BodyTrack loose = read_motive(two, "take.csv", "5A");
  EXPECT_DOUBLE_EQ(loose.samples[0].pose.y_m, 2e-3);
  EXPECT_EQ(loose.facts.rotation_kind, RotationKind::none);
}

TEST(MotiveCsv, ABodyThatIsNotThereGivesTheListAsData) {
  try {
    read_motive(kMotive, "take.csv", "asto");
    FAIL();
  } catch (const UnknownBody& error) {
    EXPECT_STREQ(error.what(), "'take.csv' holds no body of the name 'asto', but 'astro'");
    EXPECT_EQ(error.bodies(), (std::vector<BodyName>{{"astro", "4CF0"}}));
    EXPECT_EQ(error.remedy().help, Help::name_body);
  }
}

TEST(MotiveCsv, ErrorsNameLineAndColumn) {
  EXPECT_EQ(refusal(replaced(kMotive, "-200.2", "2oo")), "take.csv, line 9, column 9: '2oo' is not a number");
  EXPECT_EQ(refusal(replaced(kMotive, "\r\n73,", "\r\nx,")),
            "take.csv, line 9, column 1: 'x' is no frame number");
  EXPECT_EQ(refusal(replaced(kMotive, "\r\n73,", "\r\n71,")), "take.csv, line 9: the time does not increase");
  EXPECT_THAT(refusal(replaced(kMotive, "Millimeters", "Parsecs")),
              testing::HasSubstr("'Parsecs' is not known"));
}

TEST(MotiveCsv, AHeaderThatIsMissingIsNamed) {
  try {
    read_track("0,0.000000,0.1,0.2,0.3,0.9,1,2,3\n1,0.008333,0.1,0.2,0.3,0.9,1,2,3\n", "bare.csv");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "'bare.csv' begins with numbers: without a header its columns have no meaning");
    EXPECT_EQ(error.remedy().help, Help::export_with_header);
  }
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
    try {
      read_motive(text_of_file(path), name);
      FAIL();
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("holds no rigid body with positions"));
      EXPECT_EQ(error.remedy().help, Help::export_rigid_bodies);
    }
  }
}

TEST(MotiveCsv, AFileThatASpreadsheetSavedHasTimesThatDisagree) {
  const std::string path = shared_file("samples/motive_csv/v1.23_aolab_excel_resaved.csv");
  SKIP_WITHOUT(path);
  const BodyTrack track = read_motive(text_of_file(path), path);
  EXPECT_EQ(track.samples.size(), 2U);
  ASSERT_EQ(track.facts.remarks.size(), 1U);
  EXPECT_EQ(track.facts.remarks[0].sentence,
            "frame numbers and the column of times differ by up to 496 ms; the frame numbers are used");
}

}  // namespace
}  // namespace astro::truth
