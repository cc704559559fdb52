#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "host/base/error.hpp"
#include "host/truth/files/plain_csv.hpp"
#include "host/truth/files/rotations.hpp"
#include "host/truth/files/track_problem.hpp"
#include "host/truth/files/tracker_file.hpp"
#include "host/truth/files/tum.hpp"
#include "host/truth/files/vicon_csv.hpp"
#include "tests/host/truth/files/own_recordings.hpp"
#include "tests/host/truth/recorded_files.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::truth {
namespace {

using namespace test;
using support::Tells;

double turn_about_z(const Pose3& p) { return 2 * std::atan2(p.qz, p.qw); }

Remark refusal(const std::string& text, const std::string& body = "") {
  return support::told_by([&] { read_track(text, "file", body); });
}

/// Of something that is called: no body is named, and the file holds these.
template <class... Names>
auto HoldsSeveralBodies(const Names&... names) {
  const auto named = [](const auto& name) { return testing::Field(&BodyName::name, name); };
  return testing::Throws<UnknownBody>(
      testing::AllOf(testing::Property(&Error::remark, Tells(BodyProblem::unknown, "file", "")),
                     testing::Property(&UnknownBody::bodies, testing::ElementsAre(named(names)...))));
}

TEST(ViconCsv, RotationVectorsRunOnBeyondHalfATurn) {
  const BodyTrack track = read_vicon(kVicon, "v.csv", "astro");
  ASSERT_EQ(track.samples.size(), 4U);
  EXPECT_NEAR(turn_about_z(track.samples[0].pose), 3.0, 1e-12);
  EXPECT_NEAR(std::remainder(turn_about_z(track.samples[3].pose) - 6.1, 2 * std::numbers::pi), 0, 1e-12);
  EXPECT_EQ(track.facts.rotation, "rotation vector in rad");
  EXPECT_DOUBLE_EQ(track.samples[1].pose.x_m, 1.001);
}

TEST(ViconCsv, FramesAreTimesFromTheFirstAndEmptyCellsALostBody) {
  const BodyTrack track = read_vicon(kVicon, "v.csv", "astro:astro");
  EXPECT_EQ(track.samples[0].time_ns, 0);
  EXPECT_EQ(track.samples[3].time_ns, 40'000'000);
  EXPECT_FALSE(track.samples[2].valid);
  EXPECT_EQ(track.facts.dropped_frames, 1);
}

TEST(ViconCsv, EachBodyHasItsOwnUnits) {
  const BodyTrack wand = read_vicon(kVicon, "v.csv", "wand");
  EXPECT_NEAR(turn_about_z(wand.samples[1].pose), 20 * std::numbers::pi / 180, 1e-12);
  EXPECT_FALSE(wand.samples[3].valid);  // the row ends before
  EXPECT_THAT([] { read_track(kVicon, "file"); }, HoldsSeveralBodies("astro", "wand"));
}

TEST(ViconCsv, AnglesWhoseVectorsWouldTiltAreEulerAngles) {
  // About a body that stands on its side, a turn about z is a constant angle about x and a running one about z: as
  // rotation vectors, these would tumble.
  std::string text =
      "Segments\n100\n,,cart:base,,,,,\nFrame,Sub Frame,RX,RY,RZ,TX,TY,TZ\n,,deg,deg,deg,mm,mm,mm\n";
  for (int i = 0; i <= 180; i += 5) {
    const Quaternion q = from_euler("Z", {0, 0, i * std::numbers::pi / 180}) * from_euler("X", {1.2, 0, 0});
    const double ry = std::asin(2 * (q.x * q.z + q.w * q.y));
    const double rx = std::atan2(-2 * (q.y * q.z - q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y));
    const double rz = std::atan2(-2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.y * q.y + q.z * q.z));
    const auto deg = [](double r) { return std::to_string(r * 180 / std::numbers::pi); };
    text += std::to_string(i) + ",0," + deg(rx) + "," + deg(ry) + "," + deg(rz) + ",1,2,3\n";
  }
  const BodyTrack track = read_vicon(text, "v.csv");
  EXPECT_EQ(track.facts.rotation, "Euler angles XYZ in deg");
  EXPECT_EQ(track.name, "cart:base");
  const Quaternion turn = rotation_of(track.samples[9].pose) * conjugate(rotation_of(track.samples[0].pose));
  EXPECT_NEAR(2 * std::atan2(turn.z, turn.w), std::numbers::pi / 4, 1e-6);
  EXPECT_NEAR(tilt_rad(turn, 2), 0, 1e-4);
}

TEST(ViconCsv, AQuaternionHasFourColumnsWithoutUnits) {
  const BodyTrack track = read_vicon(
      "Objects\n250\n,,Global Angle (Quaternion) my robot:my robot,,,,,,\nFrame,Sub "
      "Frame,RX,RY,RZ,RW,TX,TY,TZ\n"
      ",,,,,,mm,mm,mm\n1,0,0,0,0.6,0.8,1,2,3\n",
      "v.csv");
  EXPECT_EQ(track.name, "my robot");
  EXPECT_NEAR(track.samples[0].pose.qz, 0.6, 1e-15);
  EXPECT_EQ(track.facts.rotation_kind, RotationKind::quaternion);
}

TEST(ViconCsv, ErrorsNameLineAndColumn) {
  std::string bad = kVicon;
  bad.replace(bad.find("1001"), 4, "10x1");
  EXPECT_THAT(refusal(bad, "astro"), Tells(TrackProblem::not_a_number, "file", "7", "6", "10x1"));
  bad = kVicon;
  bad.replace(bad.find("rad,rad,rad"), 11, "rad,rad,gon");
  EXPECT_THAT(refusal(bad, "astro"), Tells(TrackProblem::angle_unit_unknown, "file", "5", "5", "gon"));
}

TEST(ViconCsv, ReadsTheRealStadiumRun) {
  const std::string path = shared_file("samples/vicon_csv/QBii_Stadium_1m_ccw.csv");
  SKIP_WITHOUT(path);
  const BodyTrack track = read_vicon(text_of_file(path), path);
  EXPECT_EQ(track.name, "QBii");
  EXPECT_EQ(track.samples.size(), 2932U);
  EXPECT_DOUBLE_EQ(track.samples[0].pose.x_m, 0.843523804);
  // As a rotation vector the robot tilts by less than 1.7 degrees, although RX reaches 6 rad.
  for (const TrackedPose& sample : track.samples)
    ASSERT_LT(tilt_rad(rotation_of(sample.pose), 2), 1.7 * std::numbers::pi / 180);
}

TEST(Tum, TimesKeepEveryNanosecond) {
  const BodyTrack track = read_tum(kTum, "t.txt");
  ASSERT_EQ(track.samples.size(), 3U);
  EXPECT_EQ(track.samples[0].time_ns, 1'700'000'000'123'456'789);
  EXPECT_EQ(track.samples[1].time_ns, 1'700'000'000'223'456'789);
  EXPECT_DOUBLE_EQ(track.samples[0].pose.qz, std::sqrt(0.5));  // four digits in the file
  EXPECT_FALSE(track.samples[2].valid);                        // a quaternion of zeros
}

TEST(Tum, CommasSeparateAsWellAsBlanks) {
  const BodyTrack track = read_track("1.5, 1, 2, 3, 0, 0, 0, 1\n2.5, 1, 2, 3, 0, 0, 0, -1\n", "t.txt");
  EXPECT_EQ(track.facts.format, "TUM");
  EXPECT_EQ(track.samples[1].time_ns, 2'500'000'000);
}

TEST(Tum, EurocHasNanosecondsAndTheScalarFirst) {
  const BodyTrack track = read_track(kEuroc, "e.csv");
  EXPECT_EQ(track.facts.format, "EuRoC");
  EXPECT_EQ(track.samples[1].time_ns, 1'403'715'529'117'143'517);
  EXPECT_NEAR(track.samples[0].pose.qw, 0.9 / std::sqrt(0.95), 1e-15);
}

TEST(Tum, RepeatedTimesAreLeftOutAndSaid) {
  const BodyTrack track = read_track("1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n", "t.txt");
  EXPECT_EQ(track.samples.size(), 2U);
  EXPECT_THAT(track.facts.remarks.at(0), Tells(TrackRemark::times_repeated, "1"));
  EXPECT_THAT(refusal("2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n"),
              Tells(TrackProblem::time_not_increasing, "file", "2"));
}

TEST(PlainCsv, PosesOfTimesWithTooFewDigitsAreSpreadEvenlyOrRefused) {
  std::string even = "time_s,x_m,y_m\n", uneven = even;
  for (int row = 0; row < 600; ++row) {
    even += std::to_string(row / 60) + ',' + std::to_string(row) + ",0\n";
    uneven += std::to_string(row < 300 ? row / 60 : row / 10) + ',' + std::to_string(row) + ",0\n";
  }
  const BodyTrack track = read_track(even, "x.csv");
  ASSERT_EQ(track.samples.size(), 600U);
  EXPECT_NEAR(1e-9 * static_cast<double>(track.samples[90].time_ns), 1.5, 0.02);
  EXPECT_THAT(track.facts.remarks, testing::Contains(Tells(TrackRemark::times_spread, "60", "1")));
  EXPECT_THAT(support::told_by([&] { read_track(uneven, "x.csv"); }),
              Tells(TrackProblem::times_too_coarse, "x.csv", testing::_));
}

TEST(Tum, ReadsTheBenchmarksFile) {
  const std::string path = shared_file("samples/tum/freiburg1_xyz-groundtruth.txt");
  SKIP_WITHOUT(path);
  const BodyTrack track = read_track(text_of_file(path), path);
  EXPECT_EQ(track.facts.kind, FileKind::tum);
  EXPECT_EQ(track.samples.size(), 3000U);
  EXPECT_EQ(track.samples[0].time_ns, 1'305'031'098'665'900'000);
}

TEST(PlainCsv, TakesUnitsFromTheHeader) {
  const BodyTrack track = read_track(kPlain, "p.csv");
  ASSERT_EQ(track.samples.size(), 3U);
  EXPECT_EQ(track.samples[1].time_ns, 1'010'500'000);
  EXPECT_DOUBLE_EQ(track.samples[1].pose.x_m, 0.11);
  EXPECT_NEAR(turn_about_z(track.samples[0].pose), std::numbers::pi / 2, 1e-12);
  EXPECT_FALSE(track.samples[2].valid);
  EXPECT_EQ(track.facts.length_unit, "mm");
  EXPECT_TRUE(track.facts.remarks.empty());
}

TEST(PlainCsv, NamesOfOtherProgramsAreUnderstood) {
  const BodyTrack plot = read_track(
      "__time,/mocap/pose/position/x,/mocap/pose/position/y,/mocap/pose/position/z,/mocap/pose/orientation/x,"
      "/mocap/pose/orientation/y,/mocap/pose/orientation/z,/mocap/pose/orientation/"
      "w\n1700000000.5,1,2,3,0,0,1,0\n",
      "p.csv");
  EXPECT_EQ(plot.facts.rotation_kind, RotationKind::quaternion);
  EXPECT_EQ(plot.samples.at(0).pose, (Pose3{1, 2, 3, 0, 0, 1, 0}));
  EXPECT_THAT(plot.facts.remarks, testing::ElementsAre(Tells(TrackRemark::length_unit_assumed),
                                                       Tells(TrackRemark::time_unit_assumed, "s")));
  const BodyTrack german = read_track("stamp;x (cm);y (cm)\n1700000000123456789;1,5;2\n", "p.csv");
  EXPECT_EQ(german.samples.at(0).time_ns, 1'700'000'000'123'456'789);
  EXPECT_DOUBLE_EQ(german.samples[0].pose.x_m, 0.015);
  EXPECT_EQ(german.facts.rotation_kind, RotationKind::none);
}

TEST(PlainCsv, SeveralBodiesAreToldApartByWhatTheirNamesBeginWith) {
  const std::string text =
      "__time,/odom/pose/x,/odom/pose/y,/mocap/pose/position/x,/mocap/pose/position/y,/odom/twist/linear/x,"
      "/mocap/stamp\n"
      "1,10,20,30,40,50,7\n";
  EXPECT_EQ(bodies_in(text, "p.csv"), (std::vector<BodyName>{{"/odom", ""}, {"/mocap", ""}}));
  EXPECT_THAT([&] { read_track(text, "file"); }, HoldsSeveralBodies("/odom", "/mocap"));
  EXPECT_EQ(read_track(text, "p.csv", "/odom").samples.at(0).pose.x_m, 10);
  EXPECT_EQ(read_track(text, "p.csv", "/odom").samples.at(0).time_ns, 1'000'000'000);
  EXPECT_EQ(read_track(text, "p.csv", "/mocap").samples.at(0).pose.y_m, 40);
  EXPECT_EQ(read_track(text, "p.csv", "/mocap").samples.at(0).time_ns, 7'000'000'000) << "its own stamp";
  const BodyTrack own =
      read_track("t,ref_x_m,ref_y_m,x_mm,y_mm,q_x,q_y,q_z,q_w\n1,1,2,3,4,0,0,0,1\n", "p.csv");
  EXPECT_DOUBLE_EQ(own.samples.at(0).pose.x_m, 0.003) << "the one without a name";
  EXPECT_EQ(own.facts.rotation_kind, RotationKind::quaternion);
}

TEST(ViconCsv, ASpreadsheetMayHaveSavedItAgain) {
  std::string saved = kVicon;
  for (char& c : saved) c = c == ',' ? ';' : c == '.' ? ',' : c;
  saved.replace(saved.find("Objects"), 7, "Objects;;;");
  EXPECT_EQ(recognise(saved), FileKind::vicon);
  EXPECT_NEAR(turn_about_z(read_track(saved, "v.csv", "astro").samples.at(1).pose), 3.3, 1e-12);
}

TEST(PlainCsv, UnitsThatDoNotFitAreRefused) {
  EXPECT_THAT(refusal("time_s,x_deg,y_m\n"),
              Tells(TrackProblem::unit_of_other_quantity, "file", "1", "2", "deg"));
  EXPECT_THAT(refusal("time_s,x_m,y_mm\n"), Tells(TrackProblem::units_differ, "file", "1", "3", "m", "mm"));
  EXPECT_THAT(refusal("time_s,x_m,y_m\n1,2,3\nsoon,2,3\n"),
              Tells(TrackProblem::no_time, "file", "3", "1", "soon"));
}

TEST(TrackerFile, RecognisesEachFormatByItsContent) {
  EXPECT_EQ(recognise(kMotive), FileKind::motive);
  EXPECT_EQ(recognise(kVicon), FileKind::vicon);
  EXPECT_EQ(recognise("\r\n\r\nSegments\r\n100\r\n"), FileKind::vicon);
  EXPECT_EQ(recognise(kTum), FileKind::tum);
  EXPECT_EQ(recognise(kEuroc), FileKind::euroc);
  EXPECT_EQ(recognise(kPlain), FileKind::plain);
  EXPECT_EQ(recognise("comment,\"OptiTrack Export Data\"\r\n"), FileKind::motive_rows);
  for (const char* other : {"", "\n\n", "{}", "a,b,c\n1,2,3\n", "Objects of desire\n"})
    EXPECT_EQ(recognise(other), FileKind::unknown) << other;
  EXPECT_EQ(recognise(std::string_view("t\0x", 3)), FileKind::unknown);
}

TEST(TrackerFile, EveryRealRecordingIsRecognised) {
  if (!std::filesystem::exists(shared_file("samples"))) GTEST_SKIP() << "there are no samples";
  const std::map<std::string, FileKind> kinds = {
      {"motive_csv/v1.21_hmv_rigidbody_plus_markers.csv", FileKind::motive},
      {"motive_csv/v1.23_aolab_excel_resaved.csv", FileKind::motive},
      {"motive_csv/v1.0_olin_trackable_first300.csv", FileKind::motive_rows},
      {"motive_csv/v1.1_olin_row_tagged.csv", FileKind::motive_rows},
      {"vicon_csv/QBii_Stadium_1m_ccw.csv", FileKind::vicon},
      {"vicon_csv/QBii_Stadium_1m_ccw.odometry.csv", FileKind::plain},
      {"tum/freiburg1_xyz-groundtruth.txt", FileKind::tum},
      {"tum/freiburg1_xyz-rgbdslam.txt", FileKind::tum}};
  for (const auto& [name, kind] : kinds)
    EXPECT_EQ(recognise(text_of_file(shared_file("samples/" + name))), kind) << name;
}

TEST(PlainCsv, NamesInAnyStyleAreUnderstood) {
  for (const char* text : {"timeMs,posX,posY,yaw\n0,1,2,0.5\n10,1.1,2,0.5\n",
                           "Time (ms);X pos (m);Y pos (m);Heading (rad)\n0;1;2;0,5\n10;1,1;2;0,5\n",
                           "t [ms]\tx_position\ty_position\ttheta\n0\t1\t2\t0.5\n10\t1.1\t2\t0.5\n",
                           "# time x y heading\n# ms m m rad\n0 1 2 0.5\n10 1.1 2 0.5\n"}) {
    const BodyTrack track = read_track(text, "p.csv");
    ASSERT_EQ(track.samples.size(), 2U) << text;
    EXPECT_EQ(track.samples[1].time_ns, 10'000'000) << text;
    EXPECT_DOUBLE_EQ(track.samples[1].pose.x_m, 1.1) << text;
    EXPECT_NEAR(turn_about_z(track.samples[1].pose), 0.5, 1e-12) << text;
  }
}

TEST(PlainCsv, RollPitchAndYawAreTurnsAboutZThenYThenX) {
  const BodyTrack track =
      read_track("time_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg\n0,0,0,0,10,20,30\n", "p.csv");
  const Quaternion expected = from_euler("Z", {0, 0, std::numbers::pi / 6}) *
                              from_euler("Y", {0, std::numbers::pi / 9, 0}) *
                              from_euler("X", {std::numbers::pi / 18, 0, 0});
  const Quaternion apart = conjugate(expected) * rotation_of(track.samples.at(0).pose);
  EXPECT_NEAR(std::abs(apart.w), 1, 1e-12);
}

/// A circle of two metres, driven once, with its heading in this unit and perhaps wrapped.
std::string circle(double unit, bool wrapped) {
  std::string text = "time_s,x_m,y_m,heading\n";
  for (int i = 0; i < 200; ++i) {
    const double angle = 0.035 * i;
    const double heading = wrapped ? std::remainder(angle, 2 * std::numbers::pi) : angle;
    text += std::to_string(0.1 * i) + "," + std::to_string(std::sin(angle)) + "," +
            std::to_string(1 - std::cos(angle)) + "," + std::to_string(heading * unit) + "\n";
  }
  return text;
}

TEST(PlainCsv, TheDirectionOfMotionShowsTheUnitOfTheHeading) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  for (const bool wrapped : {false, true})
    for (const double unit : {1.0, kDegrees}) {
      const BodyTrack track = read_track(circle(unit, wrapped), "p.csv");
      EXPECT_NEAR(std::remainder(turn_about_z(track.samples.at(150).pose) - 5.25, 2 * std::numbers::pi), 0,
                  1e-4);
      EXPECT_THAT(track.facts.remarks, testing::ElementsAre(Tells(TrackRemark::heading_unit_assumed,
                                                                  unit == 1 ? "radians" : "degrees")));
    }
}

TEST(PlainCsv, HeadingsOfACompassAreTurnedRound) {
  for (const int sense : {1, -1}) {
    std::string text = "time_s,x_m,y_m,heading_deg\n";
    for (int i = 0; i < 300; ++i) {
      const double turn = 0.02 * i;  // a circle, driven to the left
      text += fmt::format("{},{:.4f},{:.4f},{:.3f}\n", 0.05 * i, std::sin(turn), 1 - std::cos(turn),
                          sense > 0 ? 180 / std::numbers::pi * turn : 90 - 180 / std::numbers::pi * turn);
    }
    const BodyTrack track = read_track(text, "x.csv");
    EXPECT_NEAR(std::remainder(turn_about_z(track.samples[50].pose) - turn_about_z(track.samples[0].pose),
                               2 * std::numbers::pi),
                1, 1e-3)
        << sense;
    EXPECT_EQ(
        testing::Matches(testing::Contains(Tells(TrackRemark::headings_clockwise)))(track.facts.remarks),
        sense < 0);
  }
}

TEST(PlainCsv, AWordInPlaceOfATimeIsNoQuestionOfUnits) {
  EXPECT_THAT([] { read_track("time,x_m,y_m\nabc,1,2\ndef,1,2\n", "p.csv"); },
              ThrowsTelling(TrackProblem::no_time, "p.csv", "2", "1", "abc"));
}

TEST(PlainCsv, WithoutHeightsIsFlat) {
  EXPECT_TRUE(read_track("time_s,x_m,y_m\n0,1,2\n1,1,2\n", "p.csv").facts.flat);
  EXPECT_FALSE(read_track("time_s,x_m,y_m,z_m\n0,1,2,3\n1,1,2,3\n", "p.csv").facts.flat);
}

TEST(PlainCsv, UnitsOfTwoSpellingsAreOne) {
  EXPECT_EQ(read_track("time_s,x_m,y [meters]\n0,1,2\n", "x.csv").samples[0].pose.y_m, 2);
  EXPECT_EQ(refusal("time_s,x_m,y_m,roll_deg,pitch_rad,yaw_rad\n0,1,2,0,0,0\n").kind,
            Kind(TrackProblem::units_differ));
}

TEST(PlainCsv, TagsThatDifferOnlyAtTheirEndAreToldApart) {
  const std::string tag(50, 'a');
  const std::string text = "time_s,tag_id,x_m,y_m\n0," + tag + "1,1,0\n0," + tag + "2,2,0\n1," + tag +
                           "1,3,0\n1," + tag + "2,4,0\n";
  EXPECT_EQ(read_track(text, "x.csv", tag + "2").samples.at(1).pose.x_m, 4);
}

TEST(PlainCsv, RowsOfSeveralTagsAreBodies) {
  const std::string text =
      "timestamp,tag_id,x,y\n1700000000.0,5,1,2\n1700000000.0,6,3,4\n1700000000.1,5,1.5,2\n";
  EXPECT_THAT([&] { read_track(text, "file"); }, HoldsSeveralBodies("5", "6"));
  EXPECT_EQ(read_track(text, "p.csv", "5").samples.size(), 2U);
  EXPECT_EQ(read_track(text, "p.csv", "6").samples.at(0).pose.x_m, 3);
  EXPECT_EQ(read_track("t_s,id,x_m,y_m\n0,5,1,2\n1,5,1,2\n", "p.csv").samples.size(), 2U)
      << "one tag needs no choice";
}

TEST(PlainCsv, ColumnsCanBeStatedFromOutside) {
  const BodyTrack track = read_track("0.5 1 2\n0.6 1.1 2\n", "p.csv", "", "time_s,x_m,y_m");
  EXPECT_EQ(track.samples.at(1).time_ns, 600'000'000);
  EXPECT_EQ(read_track("a,b,c\n1,2,3\n2,2,3\n", "p.csv", "", "a=time_s,b=y_mm,c=x_mm").samples.at(0).pose.y_m,
            0.002);
  EXPECT_THAT(refusal("1 2 3\n4 5 6\n"), Tells(TrackProblem::no_header, "file"));
  EXPECT_THAT(refusal("a,b,c\n1,2,3\n"), Tells(TrackProblem::no_columns, "file", "a", "b", "c"));
}

TEST(QualisysTsv, BodiesHaveTheirMatrixAndLostOnesNone) {
  const auto row = [](const std::string& before, double x, double angle, double residual) {
    const double c = std::cos(angle), s = std::sin(angle);
    std::string text = before + std::to_string(x) + "\t500.0\t80.0\t0\t0\t0\t" + std::to_string(residual);
    for (const double m : {c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0}) text += "\t" + std::to_string(m);
    return text + "\n";
  };
  const std::string head =
      "NO_OF_FRAMES\t3\nNO_OF_CAMERAS\t8\nNO_OF_BODIES\t1\nFREQUENCY\t100\nTIME_STAMP\t2024-05-01, "
      "12:34:56.250\t5.0\n"
      "DATA_INCLUDED\t6D\nBODY_NAMES\tastro\n";
  const std::string rows = row("7\t0.06000\t", 1000, 0.5, 0.4) + row("8\t0.07000\t", 0, 0, -1) +
                           row("10\t0.09000\t", 1010, 0.6, 0.4);
  const BodyTrack track = read_track(head + "Frame\tTime\tastro X\tY\tZ\n" + rows, "q.tsv");
  EXPECT_EQ(track.facts.kind, FileKind::qualisys);
  EXPECT_EQ(track.facts.start_time, "2024-05-01T12:34:56.250");
  ASSERT_EQ(track.samples.size(), 3U);
  EXPECT_EQ(track.samples[2].time_ns, 100'000'000);
  EXPECT_NEAR(track.samples[2].pose.x_m, 1.01, 1e-12);
  EXPECT_NEAR(turn_about_z(track.samples[2].pose), 0.6, 1e-6);
  EXPECT_FALSE(track.samples[1].valid);
  EXPECT_EQ(track.facts.dropped_frames, 1);
}

TEST(QualisysTsv, MarkersHavePositionsOnly) {
  const std::string text =
      "NO_OF_FRAMES\t2\nNO_OF_MARKERS\t2\nFREQUENCY\t50\nDATA_INCLUDED\t3D\nMARKER_NAMES\tfront\tback\n"
      "1\t2\t3\t4\t5\t6\n1\t2\t3\t0\t0\t0\n";
  EXPECT_THAT([&] { read_track(text, "file"); }, HoldsSeveralBodies("front", "back"));
  const BodyTrack track = read_track(text, "q.tsv", "back");
  EXPECT_DOUBLE_EQ(track.samples.at(0).pose.y_m, 0.005);
  EXPECT_FALSE(track.samples.at(1).valid);
  EXPECT_EQ(track.samples[1].time_ns, 20'000'000);
  EXPECT_THAT(refusal("NO_OF_FRAMES\t1\nMARKER_NAMES\ta\nFREQUENCY\t50\nX\tY\tZ\n1\t2\n"),
              Tells(TrackProblem::columns_differ, "file", "5", "2", "3"));
}

TEST(QualisysTsv, ARowOfALostBodyTakesItsFrame) {
  const std::string head =
      "NO_OF_FRAMES\t4\nNO_OF_MARKERS\t1\nFREQUENCY\t50\nDATA_INCLUDED\t3D\nMARKER_NAMES\tfront\n"
      "front X\tfront Y\tfront Z\n";
  for (const std::string lost : {"NaN\tNaN\tNaN\n", "\t\t\n"}) {
    const BodyTrack track = read_track(head + "1\t2\t3\n" + lost + "4\t5\t6\n\n", "q.tsv");
    ASSERT_EQ(track.samples.size(), 3U);
    EXPECT_FALSE(track.samples[1].valid);
    EXPECT_EQ(track.samples[2].time_ns, 40'000'000);
  }
}

TEST(ViconCsv, SingleMarkersCountWhereThereIsNoBody) {
  const BodyTrack track = read_track(
      "Trajectories\n100\n,,robot:top,,,robot:side,,\nFrame,Sub Frame,X,Y,Z,X,Y,Z\n,,mm,mm,mm,mm,mm,mm\n"
      "1,0,1,2,3,4,5,6\n2,0,1,2,3,,,\n",
      "v.csv", "robot:side");
  EXPECT_DOUBLE_EQ(track.samples.at(0).pose.x_m, 0.004);
  EXPECT_FALSE(track.samples.at(1).valid);
  EXPECT_EQ(track.facts.rotation_kind, RotationKind::none);
}

}  // namespace
}  // namespace astro::truth
