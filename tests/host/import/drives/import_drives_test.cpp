#include "host/import/drives/import_drives.hpp"
#include "host/import/wheels/counter_wraps.hpp"

#include <gmock/gmock.h>

#include "host/base/sample_times.hpp"
#include "host/calibration/judgement/remarks.hpp"
#include "host/experiment/analysis/analysis_problem.hpp"
#include "host/experiment/analysis/calibration.hpp"
#include "host/formats/tables/table.hpp"
#include "host/import/drives/file_inspection.hpp"
#include "host/recording/rosbag_export.hpp"
#include "host/recording/run_file.hpp"
#include "tests/host/calibration/ml_drives.hpp"
#include "tests/host/import/drives/drive_files.hpp"
#include "tests/host/import/drives/file_samples.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::importing {
namespace {

namespace fs = std::filesystem;
using calibration::Trajectory;
using calibration::WheelFactors;
using support::Tells;
using support::told_by;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class Import : public testing::Test {
 protected:
  /// Six squares of a robot with known factors. Its counts are whole.
  static const std::vector<Trajectory>& drives() {
    static const std::vector<Trajectory> runs = [] {
      simulation::study::DriveModel model = calibration::astro_drive();
      model.metres_per_count = test::kMetresPerCount;
      model.clock_offset_s = 0.031;
      return calibration::squares(model, 6, 2);
    }();
    return runs;
  }

  static ImportChoices choices() {
    ImportChoices choices;
    choices.geometry.wheel_diameter_m = test::kDiameter_m;
    choices.geometry.counts_per_turn = test::kCountsPerTurn;
    choices.geometry.wheelbase_m = 0.29;
    return choices;
  }

  fs::path at(const std::string& name) const { return folder_.path() / name; }

  /// Each drive by these two writers.
  std::vector<DriveFiles> files(const auto& wheels, const auto& truth) const {
    std::vector<DriveFiles> list;
    for (std::size_t i = 0; i < drives().size(); ++i)
      list.push_back(
          {wheels(at(fmt::format("w{}", i)), drives()[i]), truth(at(fmt::format("t{}", i)), drives()[i])});
    return list;
  }

  static experiment::Calibration calibrated(const std::vector<DriveFiles>& files,
                                            const ImportChoices& choices) {
    return experiment::calibrate(import_drives(files, choices).set,
                                 {experiment::MethodChoice::Family::ml, {}});
  }

  static void expect_like(const WheelFactors& found, const WheelFactors& expected, double tolerance) {
    EXPECT_NEAR(found.c_r, expected.c_r, tolerance);
    EXPECT_NEAR(found.c_l, expected.c_l, tolerance);
    EXPECT_NEAR(found.b_m / expected.b_m, 1, tolerance);
  }

  WheelFactors by_counts_and_tum() const {
    return calibrated(files([](auto path, auto& run) { return test::write_counts(path, run); },
                            [](auto path, auto& run) { return test::write_tum(path, run); }),
                      choices())
        .factors;
  }

  test::TemporaryFolder folder_;
};

/// Times are rounded to a microsecond, in which the robot goes 0.3 um; the files have at least as many digits.
constexpr double kRounding = 1e-6;

TEST_F(Import, FindsTheFactorsOfARobotThatHasNeverHeardOfThisProgram) {
  const experiment::Calibration found =
      calibrated(files([](auto path, auto& run) { return test::write_counts(path, run); },
                       [](auto path, auto& run) { return test::write_tum(path, run); }),
                 choices());
  const WheelFactors actual = calibration::astro_drive().actual;
  EXPECT_NEAR(found.factors.c_r, actual.c_r, 4 * found.se.c_r);
  EXPECT_NEAR(found.factors.c_l, actual.c_l, 4 * found.se.c_l);
  EXPECT_NEAR(found.factors.b_m, actual.b_m, 4 * found.se.b_m);
  EXPECT_EQ(found.judgement.verdict, calibration::Verdict::better);
}

TEST_F(Import, ADriveOnALineTakesTheUpAxisOfTheOthers) {
  const auto write = [&](const std::string& name, const Trajectory& run) {
    return DriveFiles{test::write_counts(at("w" + name), run),
                      test::write_tum(at("t" + name), run, test::y_up)};
  };
  const Trajectory line = simulation::study::synthetic_drive(simulation::study::line_course(2),
                                                             calibration::astro_drive(), "line", 7);
  std::vector<DriveFiles> files{write("line", line)};
  EXPECT_THAT(told_by([&] { import_drives(files, choices()); }).kind, Kind(truth::FloorProblem::no_up_axis));
  for (int i = 0; i < 3; ++i)
    files.push_back(write(std::to_string(i), drives()[static_cast<std::size_t>(i)]));
  const ImportedDrives imported = import_drives(files, choices());
  EXPECT_EQ(imported.set.names, (std::vector<std::string>{"wline", "w0", "w1", "w2"}));
  EXPECT_EQ(truth::axis_text(imported.reports[0].floor.up), "y");
  EXPECT_THAT(imported.reports[0].remarks,
              Contains(Tells(ImportProblem::up_axis_of_other, "wline", "y", "w0")));
  EXPECT_NEAR(experiment::calibrate(imported.set, {experiment::MethodChoice::Family::ml, {}}).factors.b_m,
              calibration::astro_drive().actual.b_m, 1e-3);
}

/// The wheels of a drive after a fault of wiring.
template <class Fault>
Trajectory with_wheels(Trajectory run, Fault fault) {
  for (calibration::WheelSample& sample : run.wheels) fault(sample);
  return run;
}

TEST_F(Import, EncodersThatCountBackwardAreToldFromExchangedOnes) {
  const auto swapped = [](calibration::WheelSample& s) { std::swap(s.left_m, s.right_m); };
  const auto reversed = [](calibration::WheelSample& s) { s.left_m = -s.left_m, s.right_m = -s.right_m; };
  const auto both = [&](calibration::WheelSample& s) { swapped(s), reversed(s); };
  const auto imported = [&](const auto& fault, bool swap, bool reverse) {
    ImportChoices stated = choices();
    stated.wheels.exchanged = swap;
    stated.wheels.reversed = reverse;
    const DriveFiles pair{test::write_counts(at("w"), with_wheels(drives()[0], fault)),
                          test::write_tum(at("t"), drives()[0])};
    return import_drives(std::vector{pair}, stated);
  };
  const auto kind = [&](const auto& fault, bool swap, bool reverse) {
    return told_by([&] { imported(fault, swap, reverse); }).kind;
  };
  EXPECT_EQ(kind(swapped, false, false), Kind(ImportProblem::turns_against_wheels));
  EXPECT_EQ(kind(swapped, false, true), Kind(ImportProblem::drives_backward));
  EXPECT_NO_THROW(imported(swapped, true, false));
  EXPECT_EQ(kind(reversed, false, false), Kind(ImportProblem::encoders_reversed));
  EXPECT_EQ(kind(reversed, true, false), Kind(ImportProblem::drives_backward))
      << "the left factor would go to the right wheel";
  EXPECT_NO_THROW(imported(reversed, false, true));
  EXPECT_EQ(kind(both, false, false), Kind(ImportProblem::drives_backward));
  EXPECT_NO_THROW(imported(both, true, true));
}

TEST_F(Import, WheelsThatCannotBeWhatTheyAreSaidToBeAreTold) {
  const auto kind = [&](const auto& fault) {
    const DriveFiles pair{test::write_counts(at("w"), with_wheels(drives()[0], fault)),
                          test::write_tum(at("t"), drives()[0])};
    return told_by([&] { import_drives(std::vector{pair}, choices()); }).kind;
  };
  EXPECT_EQ(kind([](auto& s) { s.left_m = s.right_m = 1; }), Kind(ImportProblem::wheels_stand));
  EXPECT_EQ(kind([](auto& s) { s.left_m = 1; }), Kind(ImportProblem::wheel_stands));
  EXPECT_EQ(kind([](auto& s) { s.left_m = s.right_m; }), Kind(ImportProblem::wheels_equal));
  double left = 0, right = 0;
  EXPECT_EQ(kind([&](auto& s) {
              const calibration::WheelSample now = s;
              s.left_m -= std::exchange(left, now.left_m);
              s.right_m -= std::exchange(right, now.right_m);
            }),
            Kind(ImportProblem::per_interval_likely));
}

TEST_F(Import, WheelsThatWereCutBeforeTheFirstTurnAreNotSaidToTurn) {
  Trajectory run = drives()[0];
  std::erase_if(run.wheels, [](const auto& at) { return at.time_s > 6; });  // the first side takes 7.7 s
  for (calibration::WheelSample& at : run.wheels) at.right_m = at.left_m;
  const DriveFiles pair{test::write_counts(at("w"), run), test::write_tum(at("t"), run)};
  EXPECT_NO_THROW(import_drives(std::vector{pair}, choices()));
}

TEST_F(Import, ATrackerThatWentOnForSeveralDrivesIsNoReasonToDoubtTheUnitOfTheTimes) {
  simulation::study::Course course;
  for (int i = 0; i < 6; ++i)
    for (const simulation::study::Leg& leg : simulation::study::square_course(1, Sense::ccw))
      course.push_back(leg);
  Trajectory run = simulation::study::synthetic_drive(course, calibration::astro_drive(), "d", 6);
  std::erase_if(run.wheels, [](const auto& at) { return at.time_s < 60 || at.time_s > 87; });
  test::write_lines(at("w"), "time,left_ticks,right_ticks\n", run.wheels, [](const auto& sample) {
    return fmt::format("{:.6f},{},{}", sample.time_s, std::llround(sample.left_m / test::kMetresPerCount),
                       std::llround(sample.right_m / test::kMetresPerCount));
  });
  const DriveFiles pair{at("w"), test::write_tum(at("t"), run)};
  EXPECT_NO_THROW(import_drives(std::vector{pair}, choices()));
}

TEST_F(Import, FindsTheSameWhateverTheFormatsOfTheWheels) {
  const WheelFactors expected = by_counts_and_tum();
  const auto tum = [](auto path, auto& run) { return test::write_tum(path, run); };
  expect_like(calibrated(files([](auto p, auto& run) { return test::write_degrees(p, run); }, tum), choices())
                  .factors,
              expected, kRounding);
  expect_like(
      calibrated(files([](auto p, auto& run) { return test::write_metres(p, run); }, tum), choices()).factors,
      expected, kRounding);
  ImportChoices per_interval = choices();
  per_interval.wheels.table = {"time_s,right_counts,left_counts", true};
  expect_like(
      calibrated(files([](auto p, auto& run) { return test::write_counts_per_interval(p, run); }, tum),
                 per_interval)
          .factors,
      expected, kRounding);
}

TEST_F(Import, FindsTheSameWhateverTheFormatsOfTheTruth) {
  const WheelFactors expected = by_counts_and_tum();
  const auto counts = [](auto path, auto& run) { return test::write_counts(path, run); };
  expect_like(
      calibrated(files(counts, [](auto p, auto& run) { return test::write_motive(p, run); }), choices())
          .factors,
      expected, kRounding);
  expect_like(
      calibrated(files(counts, [](auto p, auto& run) { return test::write_plain_millimetres(p, run); }),
                 choices())
          .factors,
      expected, kRounding);
}

TEST_F(Import, FindsTheSameInABagThatHoldsBoth) {
  std::vector<DriveFiles> bags;
  for (std::size_t i = 0; i < drives().size(); ++i) {
    const fs::path bag = test::write_bag(at(fmt::format("bag{}", i)), drives()[i], test::y_up);
    bags.push_back({bag, bag});
  }
  ImportChoices joints = choices();
  joints.geometry.counts_per_turn.reset();  // joints are angles
  expect_like(calibrated(bags, joints).factors, by_counts_and_tum(), kRounding);
  EXPECT_THAT(import_drives(bags, joints).reports[0].summary,
              HasSubstr("of '/tracker/pose' (ROS 2 bag, /tracker/pose of geometry_msgs/msg/PoseStamped)"));
}

TEST_F(Import, FindsTheSameInABagWhoseWheelsHaveAClockThatIsSet) {
  std::vector<DriveFiles> list;
  for (const Trajectory& run : drives()) {
    const double by_s = run.name == drives()[1].name ? 3600 : run.name == drives()[2].name ? -40 : 0.4;
    const fs::path path = test::write_bag(at(run.name), run, test::z_up, {},
                                          [=](double time_s) { return time_s + (time_s > 15 ? by_s : 0); });
    list.push_back({path, path});
  }
  ImportChoices joints = choices();
  joints.geometry.counts_per_turn.reset();  // joints are angles
  const ImportedDrives imported = import_drives(list, joints);
  for (const DriveReport& report : imported.reports)
    EXPECT_EQ(std::ranges::count_if(report.remarks,
                                    [](const Remark& remark) {
                                      return remark.kind == TimesRemark::clock_set_on ||
                                             remark.kind == TimesRemark::clock_set_back;
                                    }),
              1);
  expect_like(experiment::calibrate(imported.set, {experiment::MethodChoice::Family::ml, {}}).factors,
              by_counts_and_tum(), kRounding);
}

TEST_F(Import, FindsTheSameInBagsOfRos1) {
  const WheelFactors expected = by_counts_and_tum();
  std::vector<DriveFiles> joints, counts, odometry;
  const auto add = [&](std::vector<DriveFiles>& list, const std::string& name, const Bytes& bag) {
    const fs::path path = at(name + std::to_string(list.size()) + ".bag");
    test::save(path, bag);
    list.push_back({path, path});
  };
  for (const Trajectory& drive : drives()) {
    add(joints, "joints", test::ros1_bag(drive, "lz4"));
    add(counts, "counts", test::ros1_bag_of_counts(drive));
    add(odometry, "odometry", test::ros1_bag_of_odometry(drive, {1, 1, 0.29}));
  }
  for (const auto& list : {joints, counts})
    expect_like(calibrated(list, choices()).factors, expected, kRounding);
  ImportChoices sizes = choices();
  sizes.wheels.bag.odometry = sizes.geometry.factors();
  expect_like(calibrated(odometry, sizes).factors, expected, kRounding);
  sizes.truth.poses.topic = "/odom";
  EXPECT_THAT(told_by([&] { import_drives(odometry, sizes); }),
              Tells(ImportProblem::odometry_is_truth, "/odom"));
}

TEST_F(Import, FindsTheSameWhereTheClocksHaveNothingInCommon) {
  const WheelFactors expected = by_counts_and_tum();
  const auto since_1970 = [](auto path, auto& run) { return test::write_tum(path, run, test::z_up, 1.7e9); };
  const auto since_boot = [](auto path, auto& run) { return test::write_counts(path, run, 86'400); };
  // An epoch time in a double has 0.24 us.
  expect_like(calibrated(files(since_boot, since_1970), choices()).factors, expected, 3 * kRounding);
}

TEST_F(Import, ClocksThatRunApartAreSaidAndOfASingleDriveRefused) {
  const auto calibrated_at = [&](double skew, int count, experiment::MlChoice::Clock clock) {
    simulation::study::DriveModel model = calibration::astro_drive();
    model.clock_skew = skew;
    std::vector<DriveFiles> list;
    for (const Trajectory& run : calibration::squares(model, count, 3))
      list.push_back({test::write_counts(at("w" + run.name), run), test::write_tum(at("t" + run.name), run)});
    return experiment::calibrate(import_drives(list, choices()).set,
                                 {experiment::MethodChoice::Family::ml, {}}, {clock, {}});
  };
  const auto said = [](const experiment::Calibration& found) {
    return std::ranges::count(calibration::remarks(found.ml()->estimate),
                              Kind(calibration::JudgementProblem::clocks_run_apart), &Remark::kind);
  };
  using Clock = experiment::MlChoice::Clock;
  EXPECT_EQ(said(calibrated_at(2e-4, 4, Clock::automatic)), 0);
  EXPECT_EQ(said(calibrated_at(-2e-3, 4, Clock::automatic)), 1);
  EXPECT_EQ(said(calibrated_at(0.01, 4, Clock::automatic)), 1);
  EXPECT_EQ(told_by([&] { calibrated_at(0.01, 1, Clock::automatic); }).kind,
            Kind(experiment::AnalysisProblem::clocks_run_apart));
  EXPECT_EQ(said(calibrated_at(0.01, 1, Clock::estimated)), 1);
}

TEST_F(Import, NamesTheDrivesAfterTheirFiles) {
  fs::create_directories(at("a"));
  fs::create_directories(at("b"));
  const fs::path truth = test::write_tum(at("truth.tum"), drives()[0]);
  const fs::path truth2 = test::write_tum(at("truth2.tum"), drives()[1]);
  const std::vector<DriveFiles> pairs{{test::write_counts(at("a/ticks.csv"), drives()[0]), truth},
                                      {test::write_counts(at("b/ticks.csv"), drives()[1]), truth2}};
  EXPECT_THAT(import_drives(pairs, choices()).set.names, testing::ElementsAre("a/ticks", "b/ticks"));
  EXPECT_THAT(import_drives(std::vector{pairs[0]}, choices()).set.names, testing::ElementsAre("ticks"));
}

TEST_F(Import, RefusesADriveThatIsGivenTwice) {
  const fs::path wheels = test::write_counts(at("w.csv"), drives()[0]);
  const fs::path truth = test::write_tum(at("t.tum"), drives()[0]);
  const std::vector<DriveFiles> twice{{wheels, truth}, {at("./w.csv"), truth}};
  EXPECT_THAT(told_by([&] { import_drives(twice, choices()); }),
              Tells(ImportProblem::given_twice, at("./w.csv").string()));
}

class Directions : public Import {
 protected:
  ImportedDrives imported(const test::Frame& frame, const ImportChoices& choices,
                          double height_m = test::kHeight_m) {
    return import_drives(
        std::vector<DriveFiles>{{test::write_counts(at("w.csv"), drives()[0]),
                                 test::write_tum(at("t.tum"), drives()[0], frame, 0, height_m)}},
        choices);
  }

  /// Of files in which left and right are exchanged.
  static ImportChoices of_exchanged_files() {
    ImportChoices exchanged = choices();
    exchanged.wheels.table.columns = "time_s,right_counts,left_counts";
    return exchanged;
  }
};

TEST_F(Directions, AnAxisThatPointsDownIsRecognisedByTheHeightOfTheBody) {
  const ImportedDrives found = imported(test::z_down, choices());
  EXPECT_NEAR(found.reports[0].floor.up[2], -1, 1e-6);
  EXPECT_THAT(found.reports[0].summary, HasSubstr("-z is up"));
  EXPECT_NEAR(found.reports[0].floor.height_m, test::kHeight_m, 1e-3);
}

TEST_F(Directions, ExchangedWheelsUnderABodyAboveTheFloorAreRefusedAndNotTakenForAMirrorImage) {
  EXPECT_THAT(told_by([&] { imported(test::z_up, of_exchanged_files()); }),
              Tells(ImportProblem::turns_against_wheels, "w", "0.21"));
}

TEST_F(Directions, ExchangedWheelsUnderAnAxisThatPointsDownDoNotHideEachOther) {
  EXPECT_THAT(told_by([&] { imported(test::z_down, of_exchanged_files()); }),
              Tells(ImportProblem::below_origin, "w", "0.21"));
  ImportChoices below = choices();
  below.floor.up = truth::Direction3{0, 0, 1};
  EXPECT_NO_THROW(imported(test::z_up, below, -test::kHeight_m))
      << "a tracker whose origin is not on the floor";
  EXPECT_THAT(told_by([&] { imported(test::z_up, choices(), -test::kHeight_m); }),
              Tells(ImportProblem::below_origin, "w", "0.21"));
}

TEST_F(Directions, WhereNothingShowsWhatIsMirroredNothingIsGuessed) {
  EXPECT_THAT(told_by([&] { imported(test::z_up, of_exchanged_files(), 0); }),
              Tells(ImportProblem::turns_against_wheels, "w"));
}

TEST_F(Directions, WheelsThatWereExchangedInVainAreNotSaidToBeExchanged) {
  ImportChoices exchanged = choices();
  exchanged.wheels.exchanged = true;
  constexpr ImportProblem kInVain = ImportProblem::turns_against_exchanged;
  EXPECT_THAT(told_by([&] { imported(test::z_up, exchanged); }), Tells(kInVain, "w", "0.21"));
  EXPECT_THAT(told_by([&] { imported(test::z_up, exchanged, 0); }), Tells(kInVain, "w"));
  EXPECT_THAT(told_by([&] { imported(test::z_down, exchanged); }), Tells(kInVain, "w", "0.21"));
  exchanged.floor.up = truth::Direction3{0, 0, 1};
  EXPECT_THAT(told_by([&] { imported(test::z_up, exchanged); }), Tells(kInVain, "w"));
}

TEST_F(Directions, AGivenAxisAgainstTheWheelsIsRefused) {
  ImportChoices down = choices();
  down.floor.up = truth::Direction3{0, 0, -1};
  EXPECT_THAT(told_by([&] { imported(test::z_up, down); }),
              Tells(ImportProblem::turns_against_stated_up, "w"));
}

TEST_F(Import, SquaresOfPositionsAloneTurnAsTheWheelsDo) {
  for (const double side_m : {1.5, 2.23, 2.55, 2.86})
    for (const double rate_hz : {60.0, 97.0, 112.0})
      for (const Sense sense : {Sense::cw, Sense::ccw}) {
        simulation::study::DriveModel model = calibration::astro_drive();
        model.truth_rate_hz = rate_hz;
        model.headings = false;
        const Trajectory run = simulation::study::synthetic_drive(
            simulation::study::square_course(side_m, sense), model, "square", 3);
        test::write_lines(at("t"), "time_s,x_m,y_m\n", run.truth, [](const auto& sample) {
          return fmt::format("{:.6f},{:.5f},{:.5f}", sample.time_s, sample.x_m, sample.y_m);
        });
        const DriveFiles pair{test::write_counts(at("w"), run), at("t")};
        EXPECT_NO_THROW(import_drives(std::vector{pair}, choices())) << side_m << " m, " << rate_hz << " Hz";
      }
}

TEST_F(Import, SaysWhichSizeIsMissing) {
  const std::vector<DriveFiles> pair{
      {test::write_counts(at("w.csv"), drives()[0]), test::write_tum(at("t.tum"), drives()[0])}};
  const auto without = [&](std::optional<double> RobotGeometry::*size) {
    ImportChoices some = choices();
    (some.geometry.*size).reset();
    return told_by([&] { import_drives(pair, some); });
  };
  EXPECT_THAT(without(&RobotGeometry::wheel_diameter_m), Tells(ImportProblem::no_wheel_diameter));
  EXPECT_THAT(without(&RobotGeometry::counts_per_turn), Tells(ImportProblem::no_counts_per_turn));
  EXPECT_THAT(without(&RobotGeometry::wheelbase_m), Tells(ImportProblem::no_wheelbase));
}

TEST_F(Import, RefusesACopyOfADriveUnderAnotherName) {
  const std::vector<DriveFiles> pairs{
      {test::write_counts(at("w1.csv"), drives()[0]), test::write_tum(at("t1.tum"), drives()[0])},
      {test::write_counts(at("w2.csv"), drives()[0]), test::write_tum(at("t2.tum"), drives()[0])}};
  EXPECT_THAT(told_by([&] { import_drives(pairs, choices()); }),
              Tells(ImportProblem::copy_of_other, "w2", "w1"));
}

TEST_F(Import, KnowsTheRobotOfARecordingOfOurs) {
  const std::vector<DriveFiles> pair{
      {test::write_counts(at("w.csv"), drives()[0]), test::write_tum(at("t.tum"), drives()[0])}};
  const recording::Run run = import_drives(pair, choices()).set.runs[0];
  recording::write_run(at("own.mcap"), run);
  const std::vector<DriveFiles> own{{at("own.mcap"), at("t.tum")}};
  const recording::Run back = import_drives(own, {}).set.runs[0];  // no sizes are given
  EXPECT_EQ(back.info.parameters, run.info.parameters);
  ASSERT_EQ(back.odometry.size(), run.odometry.size());
  EXPECT_EQ(back.odometry.back().left_counts - back.odometry.front().left_counts,
            run.odometry.back().left_counts - run.odometry.front().left_counts);
}

TEST_F(Import, SaysThatSizesGivenBesideARecordingOfOursAreNotUsed) {
  const std::vector<DriveFiles> pair{
      {test::write_counts(at("w.csv"), drives()[0]), test::write_tum(at("t.tum"), drives()[0])}};
  recording::write_run(at("own.mcap"), import_drives(pair, choices()).set.runs[0]);
  const std::vector<DriveFiles> own{{at("own.mcap"), at("t.tum")}};
  const auto remarks = [&](const ImportChoices& given) {
    return import_drives(own, given).reports[0].remarks;
  };
  EXPECT_THAT(remarks(choices()), Not(Contains(Tells(ImportProblem::sizes_not_used)))) << "they are the same";
  ImportChoices other = choices();
  other.geometry.wheelbase_m = 0.5;
  EXPECT_THAT(remarks(other), Contains(Tells(ImportProblem::sizes_not_used)));
}

TEST_F(Import, RefusesWheelsThatLeap) {
  std::ofstream(at("w.csv")) << "time_s,left_rad,right_rad\n0,0,0\n0.01,1e6,1e6\n0.02,1e6,1e6\n";
  const std::vector<DriveFiles> pair{{at("w.csv"), test::write_tum(at("t.tum"), drives()[0])}};
  EXPECT_THAT(told_by([&] { import_drives(pair, choices()); }),
              Tells(ImportProblem::turns_too_far, "w", "0.000", "0.010"));
}

TEST_F(Import, RefusesACounterThatStartsAgain) {
  std::string rows = "time_s,left_counts,right_counts\n";
  for (int i = 0; i < 100; ++i) rows += fmt::format("{},{},{}\n", 0.02 * i, 20437 + 60 * i, 60 * i);
  std::ofstream(at("w.csv")) << rows << "2.0,0,6000\n2.02,60,6060\n";
  const std::vector<DriveFiles> pair{{at("w.csv"), test::write_tum(at("t.tum"), drives()[0])}};
  EXPECT_THAT(told_by([&] { import_drives(pair, choices()); }),
              Tells(CounterProblem::range_unknown, at("w.csv").string(), "left", "26436", "26438"));
}

/// Counters of 0 to 8999, of which every n-th row was logged.
fs::path write_counts_to_8999(const fs::path& path, const Trajectory& run, std::size_t n) {
  std::ofstream file(path);
  file << "time_s,left_counts,right_counts\n";
  const auto shown = [](double travel_m) {
    constexpr long kRange = 9'000;
    const long count = std::lround(travel_m / test::kMetresPerCount) % kRange;
    return count < 0 ? count + kRange : count;
  };
  for (std::size_t i = 0; i < run.wheels.size(); i += n)
    file << fmt::format("{:.6f},{},{}\n", run.wheels[i].time_s, shown(run.wheels[i].left_m),
                        shown(run.wheels[i].right_m));
  return path;
}

TEST_F(Import, ASlowLogTakesTheRangeOfItsCounterFromTheOthers) {
  constexpr std::size_t kSlow = 80;  // a row in 0.8 s
  const std::vector<DriveFiles> slow{
      {write_counts_to_8999(at("slow"), drives()[0], kSlow), test::write_tum(at("t0"), drives()[0])}};
  EXPECT_EQ(told_by([&] { import_drives(slow, choices()); }).kind, Kind(CounterProblem::starts_again));
  std::vector<DriveFiles> files = slow;
  for (int i = 1; i < 3; ++i) {
    const Trajectory& run = drives()[static_cast<std::size_t>(i)];
    files.push_back({write_counts_to_8999(at(fmt::format("w{}", i)), run, 1),
                     test::write_tum(at(fmt::format("t{}", i)), run)});
  }
  std::vector<fs::path> wheels;
  for (const DriveFiles& pair : files) wheels.push_back(pair.wheels);
  for (const ImportedDrives& all : {import_drives(files, choices()), import_wheels(wheels, choices())}) {
    const std::vector<recording::OdometrySample>& odometry = all.set.runs[0].odometry;
    const calibration::WheelSample last = drives()[0].wheels[kSlow * (odometry.size() - 1)];
    EXPECT_EQ(odometry.back().left_counts - odometry.front().left_counts,
              std::lround(last.left_m / test::kMetresPerCount));
    EXPECT_EQ(odometry.back().right_counts - odometry.front().right_counts,
              std::lround(last.right_m / test::kMetresPerCount));
  }
}

/// In a range of 9000, 5000 to 0 is neither motion nor the end, but a controller that was reset goes from anywhere to 0.
TEST_F(Import, ADriveThatCanBeReadIsKeptWhereTheRangeOfTheOthersDoesNotFitIt) {
  constexpr double kRadius_m = 0.3, kAngle_rad = 1.8, kReset_m = 5'000 * test::kMetresPerCount;
  const Trajectory arc = simulation::study::synthetic_drive(
      simulation::study::circle_course(kRadius_m, kAngle_rad), calibration::astro_drive(), "arc", 7);
  Trajectory reset = arc;
  std::optional<calibration::WheelSample> at_reset;
  for (calibration::WheelSample& sample : reset.wheels) {
    if (!at_reset && sample.right_m > kReset_m) at_reset = sample;
    if (!at_reset) continue;
    sample.left_m -= at_reset->left_m;
    sample.right_m -= at_reset->right_m;
  }
  const std::vector<DriveFiles> files{
      {test::write_counts(at("reset"), reset), test::write_tum(at("t0"), arc)},
      {write_counts_to_8999(at("w1"), drives()[1], 1), test::write_tum(at("t1"), drives()[1])}};
  EXPECT_THAT(import_drives(files, choices()).reports[0].remarks,
              Contains(testing::Field(&Remark::kind, Kind(WheelRemark::restart_joined))));
}

TEST_F(Import, ATableThatIsNotUnderstoodIsToldAsOneOfWheels) {
  std::ofstream(at("log.csv")) << "stamp;enc a;enc b\n0,01;5;6\n0,02;7;8\n0,03;9;10\n";
  EXPECT_THAT(told_by([&] { inspect_file(at("log.csv")); }),
              Tells(WheelProblem::columns_unclear, "stamp", "enc a", "enc b"));
  std::ofstream(at("ends.csv")) << "ex [mm];ey [mm]\n-1,5;2,25\n3,5;4\n";
  EXPECT_EQ(inspect_file(at("ends.csv")).end_poses->poses.size(), 2U);
}

TEST_F(Import, ATableOfEndPosesWithAMistakeIsToldAsOneOfEndPoses) {
  using calibration::EndPoseTableProblem;
  std::ofstream(at("cell.csv")) << "ex_mm,ey_mm,etheta_deg\n1,2,3\nx,2,3\n";
  EXPECT_THAT(told_by([&] { inspect_file(at("cell.csv")); }),
              Tells(EndPoseTableProblem::not_a_number, at("cell.csv").string(), "3", "ex_mm", "x"));
  std::ofstream(at("commas.csv")) << "run,ex_mm,ey_mm,etheta_deg\n1,1,5,2,5,3\n2,1,5,2,5,3\n";
  EXPECT_THAT(told_by([&] { inspect_file(at("commas.csv")); }),
              Tells(tables::TableProblem::rows_of_other_length, at("commas.csv").string(), "2", "6", "4"));
  std::ofstream(at("unit.csv")) << "ex_mm,ey_mm,etheta_mrad\n1,2,3\n";
  EXPECT_THAT(told_by([&] { inspect_file(at("unit.csv")); }),
              Tells(EndPoseTableProblem::no_unit, at("unit.csv").string(), "1", "etheta_mrad"));
}

TEST_F(Import, AnotherUnitIsTakenInPlaceOfTheFilesOwn) {
  ImportChoices wrong = choices();
  wrong.truth.length_unit = "cm";
  const std::vector<DriveFiles> pair{
      {test::write_counts(at("w.csv"), drives()[0]), test::write_tum(at("t.tum"), drives()[0])}};
  EXPECT_NEAR(import_drives(pair, wrong).reports[0].floor.length_ratio, 0.01, 1e-3);
}

TEST_F(Import, TakesOurRecordingsThatWereExportedOrPackedAsBagsOfOthers) {
  const recording::Run run = test::own_run(test::short_drive());
  recording::export_rosbag(run, at("exported"));
  recording::write_run(at("own.mcap"), run);
  test::save(at("own.mcap.zstd"), bag::compress_zstd(load_file(at("own.mcap"))));
  for (const char* name : {"exported", "exported/exported_0.db3", "own.mcap.zstd"}) {
    const FileInspection found = inspect_file(at(name));
    EXPECT_FALSE(found.bag->run) << name;
    EXPECT_EQ(read_wheels(at(name)).track.samples.size(), run.odometry.size()) << name;
  }
  EXPECT_EQ(inspect_file(at("own.mcap")).bag->run->kind, "free");
}

}  // namespace
}  // namespace astro::importing
