#include "host/recording/run_file.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "host/base/file_problem.hpp"
#include "host/base/files.hpp"
#include "host/base/text/numbers.hpp"
#include "host/base/text/sense.hpp"
#include "host/formats/files/mcap_reader.hpp"
#include "host/formats/files/mcap_writer.hpp"
#include "host/recording/recording_problem.hpp"
#include "host/recording/run_metadata.hpp"
#include "host/recording/run_writer.hpp"
#include "host/recording/slip_remark.hpp"
#include "tests/host/recording/support.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::recording {
namespace {

using astro::support::Tells;
using astro::support::ThrowsTelling;
using support::TempFolder;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

RunInfo full_info() {
  RunInfo info;
  info.kind = "square";
  info.direction = Sense::ccw;
  info.phase = "after";
  info.index = 4;
  info.size_m = 3.000000000000001;
  info.speed_mps = 0.1;
  info.robot_name = "Astro \"one\" – šđ";
  info.robot_id = "00112233445566778899aabbccddeeff";
  info.board = "sim";
  info.firmware = "0.1.0";
  info.started_at = "2024-06-11T12:00:00Z";
  info.truth_source = "sim";
  info.truth_clock = "robot";
  info.parameters = {{"c_R", 1.0020757156294013}, {"c_L", -0.0}, {"b", 5e-324}, {"odd", kNan}};
  return info;
}

void expect_same_info(const RunInfo& a, const RunInfo& b) {
  EXPECT_EQ(to_map({a, {}, {}}),
            to_map({b, {}, {}}));  // as text, so that NaN equals NaN and -0 differs from 0
}

/// Headings: the reader adds whole turns back, each good to a rounding of the heading itself.
void expect_same_data(const Run& a, const Run& b) {
  ASSERT_EQ(a.odometry.size(), b.odometry.size());
  ASSERT_EQ(a.truth.size(), b.truth.size());
  const auto tolerance_rad = [](double heading_rad) { return 1e-15 * (1 + std::abs(heading_rad)); };
  for (std::size_t i = 0; i < a.odometry.size(); ++i) {
    const OdometrySample &s = a.odometry[i], &t = b.odometry[i];
    EXPECT_EQ(s.time_us, t.time_us);
    EXPECT_EQ(s.x_m, t.x_m);
    EXPECT_EQ(s.y_m, t.y_m);
    EXPECT_EQ(s.v_mps, t.v_mps);
    EXPECT_EQ(s.omega_radps, t.omega_radps);
    EXPECT_EQ(s.left_counts, t.left_counts);
    EXPECT_EQ(s.right_counts, t.right_counts);
    EXPECT_NEAR(s.theta_rad, t.theta_rad, tolerance_rad(s.theta_rad)) << i;
  }
  for (std::size_t i = 0; i < a.truth.size(); ++i) {
    const TruthSample &s = a.truth[i], &t = b.truth[i];
    EXPECT_EQ(s.time_us, t.time_us);
    ASSERT_EQ(s.valid, t.valid) << i;
    if (!s.valid) continue;
    EXPECT_EQ(s.x_m, t.x_m);
    EXPECT_EQ(s.y_m, t.y_m);
    EXPECT_NEAR(s.theta_rad, t.theta_rad, tolerance_rad(s.theta_rad)) << i;
  }
}

Run random_run(unsigned seed, int samples, double first_heading_rad) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> step(-3.14, 3.14);
  std::uniform_real_distribution<double> place(-10, 10);
  std::uniform_int_distribution<std::int32_t> counts(std::numeric_limits<std::int32_t>::min());
  recording::Run run;
  run.info = full_info();
  // Half steps for truth: past a lost sample, two of them must stay below half a turn.
  double odometry_rad = first_heading_rad;
  double truth_rad = -first_heading_rad;
  for (int i = 0; i < samples; ++i) {
    const std::int64_t time_us = 20'000 * i - 100'000;
    run.odometry.push_back({time_us, place(random), place(random), odometry_rad += step(random),
                            place(random), place(random), counts(random), counts(random)});
    run.truth.push_back(
        {time_us + 777, place(random), place(random), truth_rad += step(random) / 2, i % 7 != 3});
  }
  return run;
}

TEST(RunFile, WhatIsReadIsWhatWasWritten) {
  constexpr unsigned kSeed = 5;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  const TempFolder folder;
  for (const double first_heading_rad : {0.0, 3.1415, -50.0, 1000.0}) {
    const recording::Run run = random_run(kSeed, 500, first_heading_rad);
    write_run(folder / "run.mcap", run);
    const recording::Run back = read_run(folder / "run.mcap");
    EXPECT_FALSE(back.warning);
    expect_same_info(back.info, run.info);
    expect_same_data(run, back);
  }
}

TEST(RunFile, PosesWithTheGyroComeBackWithTheWholeTurnsThatTheyHaveFromTheWheels) {
  const TempFolder folder;
  recording::Run run = random_run(7, 60, 40);
  double off_rad = 0;
  for (std::size_t i = 10; i < run.odometry.size(); ++i) {
    if (i == 30) continue;  // the gyro was switched off for a moment
    const OdometrySample& sample = run.odometry[i];
    run.gyro.push_back({sample.time_us - 7000, 1.5, -2.25, sample.theta_rad + (off_rad += 0.3), 0.125});
  }
  const OdometrySample last = run.odometry.back();
  for (int i = 1; i <= 3; ++i)  // a file that was cut off may lack the odometry behind them
    run.gyro.push_back({last.time_us + i * 10000, 1.5, -2.25, last.theta_rad + (off_rad += 0.3), 0.125});
  write_run(folder / "run.mcap", run);
  const recording::Run back = read_run(folder / "run.mcap");
  expect_same_data(run, back);
  ASSERT_EQ(back.gyro.size(), run.gyro.size());
  for (std::size_t i = 0; i < run.gyro.size(); ++i) {
    const GyroPose &wrote = run.gyro[i], &read = back.gyro[i];
    EXPECT_EQ(wrote.time_us, read.time_us);
    EXPECT_EQ(wrote.x_m, read.x_m);
    EXPECT_EQ(wrote.y_m, read.y_m);
    EXPECT_EQ(wrote.omega_radps, read.omega_radps);
    EXPECT_NEAR(wrote.theta_rad, read.theta_rad, 1e-13);
  }
}

TEST(RunFile, SlipsThatTheGyroNoticedComeBackAndAreToldByTimeAndTurn) {
  const TempFolder folder;
  recording::Run run = random_run(8, 50, 0);
  EXPECT_FALSE(slip_remark(run, "square cw 1"));
  run.slips = {{-40'000, 0.1}, {700'001, -0.25}, {2'000'000, 3.2767}};
  write_run(folder / "run.mcap", run);
  const recording::Run back = read_run(folder / "run.mcap");
  expect_same_data(run, back);
  ASSERT_EQ(back.slips.size(), run.slips.size());
  for (std::size_t i = 0; i < run.slips.size(); ++i) {
    EXPECT_EQ(back.slips[i].time_us, run.slips[i].time_us);
    EXPECT_EQ(back.slips[i].turn_rad, run.slips[i].turn_rad);
  }
  // The run begins at -0.1 s.
  EXPECT_THAT(slip_remark(back, "square cw 1").value(), Tells(RecordingProblem::turned_unseen, "square cw 1",
                                                              "5.7", "0.1", "-14.3", "0.8", "187.7", "2.1"));
}

TEST(RunFile, OfManySlipsTheFirstFiveAreToldAndHowManyMore) {
  recording::Run run = random_run(8, 50, 0);
  run.slips.assign(5, {700'001, 0.1});
  const Remark five = slip_remark(run, "square cw 1").value();
  EXPECT_EQ(five.sentence.find("more"), std::string::npos);
  run.slips.assign(10'000, {700'001, 0.1});
  const Remark many = slip_remark(run, "square cw 1").value();
  EXPECT_EQ(many.values, five.values);
  EXPECT_EQ(many.sentence, five.sentence + ", and 9995 more");
}

/// A scan whose numbers are floats, as a message holds them.
lidar::Scan scan_at(std::int64_t time_ns, std::size_t beams) {
  lidar::Scan scan{time_ns, 0.5, -0.25, 0.0625, 0.125, 12, {}};
  for (std::size_t i = 0; i < beams; ++i) scan.ranges_m.push_back(0.1F * static_cast<float>(i));
  if (beams > 3) scan.ranges_m[3] = std::numeric_limits<float>::quiet_NaN();
  return scan;
}

TEST(RunFile, ScansComeBackWithTheirNanoseconds) {
  const TempFolder folder;
  recording::Run run = random_run(6, 50, 0);
  run.scans = {scan_at(-3, 360), scan_at(181'818'181, 7), scan_at(2'000'000'001, 0)};
  write_run(folder / "run.mcap", run);
  const recording::Run back = read_run(folder / "run.mcap");
  expect_same_data(run, back);
  ASSERT_EQ(back.scans.size(), run.scans.size());
  for (std::size_t i = 0; i < run.scans.size(); ++i) {
    const lidar::Scan &a = run.scans[i], &b = back.scans[i];
    EXPECT_EQ(a.time_ns, b.time_ns);
    EXPECT_EQ(a.first_angle_rad, b.first_angle_rad);
    EXPECT_EQ(a.angle_step_rad, b.angle_step_rad);
    EXPECT_EQ(a.beam_interval_s, b.beam_interval_s);
    EXPECT_EQ(a.range_min_m, b.range_min_m);
    EXPECT_EQ(a.range_max_m, b.range_max_m);
    ASSERT_EQ(a.ranges_m.size(), b.ranges_m.size());
    for (std::size_t k = 0; k < a.ranges_m.size(); ++k)
      EXPECT_TRUE(a.ranges_m[k] == b.ranges_m[k] || (std::isnan(a.ranges_m[k]) && std::isnan(b.ranges_m[k])));
  }
}

TEST(RunFile, WithoutScansHasNoTopicForThem) {
  const TempFolder folder;
  write_run(folder / "run.mcap", random_run(7, 5, 0));
  const Bytes file = load_file(folder / "run.mcap");
  recording::Run run = random_run(7, 5, 0);
  run.scans = {scan_at(0, 4)};
  write_run(folder / "scanned.mcap", run);
  const auto says_scan = [](const Bytes& bytes) {
    return as_text(bytes).find("/scan") != std::string_view::npos;
  };
  EXPECT_FALSE(says_scan(file));
  EXPECT_TRUE(says_scan(load_file(folder / "scanned.mcap")));  // in the summary, which is not compressed
}

TEST(RunFile, ExtremeNumbersSurvive) {
  const TempFolder folder;
  recording::Run run;
  run.odometry.push_back({-1, -0.0, 5e-324, 0, 1.7976931348623157e308, -0.1, INT32_MIN, INT32_MAX});
  run.truth.push_back({2'147'483'647'999'999, 1e-300, -1e300, -2.5, true});
  write_run(folder / "run.mcap", run);
  const recording::Run back = read_run(folder / "run.mcap");
  expect_same_data(run, back);
  EXPECT_TRUE(std::signbit(back.odometry[0].x_m));
}

TEST(RunFile, ARunWithoutSamplesKeepsItsInfo) {
  const TempFolder folder;
  write_run(folder / "run.mcap", {full_info(), {}, {}});
  const recording::Run back = read_run(folder / "run.mcap");
  expect_same_info(back.info, full_info());
  EXPECT_TRUE(back.odometry.empty() && back.truth.empty() && !back.warning);
}

TEST(RunFile, LostTruthComesBackAsNoPoseAndTheHeadingGoesOnBehindIt) {
  const TempFolder folder;
  recording::Run run;
  run.truth = {{0, 1, 2, 6.0, true}, {1, 1, 2, 0, false}, {2, 1, 2, kNan, true}, {3, 1, 2, 7.0, true}};
  write_run(folder / "run.mcap", run);
  const recording::Run back = read_run(folder / "run.mcap");
  ASSERT_EQ(back.truth.size(), 4U);
  EXPECT_NEAR(back.truth[0].theta_rad, 6.0, 1e-14);
  EXPECT_FALSE(back.truth[1].valid);
  EXPECT_TRUE(std::isnan(back.truth[1].x_m) && std::isnan(back.truth[1].theta_rad));
  EXPECT_TRUE(back.truth[2].valid);
  EXPECT_EQ(back.truth[2].x_m, 1);
  EXPECT_TRUE(std::isnan(back.truth[2].theta_rad));
  EXPECT_NEAR(back.truth[3].theta_rad, 7.0, 1e-14);
}

TEST(RunWriter, CarriesTheFinalNameOnlyAfterClose) {
  const TempFolder folder;
  const auto path = folder / "deep/er/run.mcap";
  write_run(path, random_run(1, 3, 0));
  {
    RunWriter writer(path, full_info());
    writer.add(OdometrySample{});
    EXPECT_EQ(read_run(path).odometry.size(), 3U) << "the old recording stays until the new one is whole";
  }
  EXPECT_EQ(read_run(path).odometry.size(), 3U);
  RunWriter writer(path, {});
  writer.add(OdometrySample{});
  writer.close(full_info());
  EXPECT_EQ(read_run(path).odometry.size(), 1U);
  expect_same_info(read_run(path).info, full_info());
  EXPECT_FALSE(std::filesystem::exists(folder / "deep/er/run.mcap.part"));
}

TEST(RunWriter, WhatWasRecordedMoreThanTwoSecondsBeforeTheEndOutlivesTheRecorder) {
  const TempFolder folder;
  const recording::Run run = random_run(2, 500, 0);  // 10 s
  RunWriter writer(folder / "run.mcap", run.info);
  for (const OdometrySample& sample : run.odometry) writer.add(sample);
  const recording::Run rescued = read_run(folder / "run.mcap.part");  // as if the recorder had been killed
  expect_same_info(rescued.info, run.info);
  EXPECT_THAT(rescued.warning.value_or(Remark{}),
              Tells(RecordingProblem::cut_off, (folder / "run.mcap.part").string()));
  ASSERT_GE(rescued.odometry.size(), 400U);
  EXPECT_EQ(rescued.odometry[399].left_counts, run.odometry[399].left_counts);
  EXPECT_THAT([&] { read_run(folder / "run.mcap"); },
              ThrowsTelling(FileProblem::unfinished, (folder / "run.mcap").string()));
}

/// Of what a run is read back from.
std::vector<std::uint64_t> log_times_ns(const std::filesystem::path& path) {
  std::vector<std::uint64_t> times;
  bag::McapHandlers handlers;
  handlers.message = [&](const bag::mcap::Channel& channel, const bag::mcap::Schema*,
                         const bag::mcap::Message& message) {
    EXPECT_EQ(message.publish_time_ns, message.log_time_ns);
    if (channel.topic == "/odom" || channel.topic == "/wheel_counts" || channel.topic == "/truth")
      times.push_back(message.log_time_ns);
  };
  bag::read_mcap(load_file(path), handlers);
  return times;
}

TEST(RunWriter, LogsWhenItWasDrivenAndStampsByTheRobotsClock) {
  const TempFolder folder;
  RunInfo info = full_info();
  constexpr std::uint64_t kStarted_ns = 1'718'107'200'000'000'000;  // date -u -d 2024-06-11T12:00:00Z +%s%N
  const auto driven = [&](const std::string& name) {
    RunWriter writer(folder / name, info);
    for (const std::int64_t time_us : {500, 1'000'500}) {
      OdometrySample sample;
      sample.time_us = time_us;
      writer.add(sample);
    }
    writer.add(TruthSample{100, 0, 0, 0, true});  // earlier than the first message, by the robot's clock
    writer.close(info);
    return log_times_ns(folder / name);
  };
  EXPECT_THAT(driven("utc.mcap"), testing::ElementsAre(kStarted_ns, kStarted_ns, kStarted_ns + 1'000'000'000,
                                                       kStarted_ns + 1'000'000'000, kStarted_ns - 400'000));
  const recording::Run back = read_run(folder / "utc.mcap");
  EXPECT_EQ(back.odometry[0].time_us, 500);
  EXPECT_EQ(back.odometry[1].time_us, 1'000'500);
  EXPECT_EQ(back.truth[0].time_us, 100);
  for (const char* const unknown : {"", "yesterday", "2024-06-11", "1969-12-31T23:59:59Z"}) {
    info.started_at = unknown;
    EXPECT_THAT(driven("unknown.mcap"),
                testing::ElementsAre(500'000, 500'000, 1'000'500'000, 1'000'500'000, 100'000))
        << unknown;
  }
}

TEST(RunWriter, RefusesTimesThatAStampCannotHold) {
  const TempFolder folder;
  RunWriter writer(folder / "run.mcap", {});
  EXPECT_THAT(([&] {
                writer.add(TruthSample{std::int64_t{1} << 62, 0, 0, 0, true});
              }),
              ThrowsTelling(RecordingProblem::time_out_of_range, (folder / "run.mcap").string(),
                            "4611686018427387904"));
}

TEST(RunFile, ErrorsNameTheFile) {
  const TempFolder folder;
  const auto named = [&](const std::string& name) { return (folder / name).string(); };
  EXPECT_THAT([&] { read_run(folder / "none.mcap"); },
              ThrowsTelling(FileProblem::missing, named("none.mcap")));
  support::spill(folder / "empty.mcap", {});
  EXPECT_THAT([&] { read_run(folder / "empty.mcap"); },
              ThrowsTelling(RecordingProblem::not_mcap, named("empty.mcap")));
  support::spill(folder / "text.mcap", as_bytes("__time,x_m\n0,1\n"));
  EXPECT_THAT([&] { read_run(folder / "text.mcap"); },
              ThrowsTelling(RecordingProblem::not_mcap, named("text.mcap")));
  std::filesystem::create_directory(folder / "folder.mcap");
  EXPECT_THAT([&] { read_run(folder / "folder.mcap"); },
              ThrowsTelling(FileProblem::is_folder, named("folder.mcap")));
  support::spill(folder / "blocker", as_bytes("x"));
  EXPECT_THAT(([&] { write_run(folder / "blocker/run.mcap", {}); }),
              ThrowsTelling(FileProblem::folder_not_made, named("blocker")));
}

TEST(RunFile, AForeignMcapFileIsToldApart) {
  const TempFolder folder;
  Bytes file;
  bag::McapWriter writer([&](ByteView bytes) { append(file, bytes); }, {"ros2", "other"});
  writer.close();
  support::spill(folder / "other.mcap", file);
  EXPECT_THAT([&] { read_run(folder / "other.mcap"); },
              ThrowsTelling(RecordingProblem::of_no_run, (folder / "other.mcap").string()));
}

TEST(RunRecord, NonsenseAndNewerFormatsAreRefusedByName) {
  using bag::mcap::Map;
  EXPECT_NO_THROW(run_record({}, "x.mcap"));
  EXPECT_NO_THROW(run_record(Map{{"a key of the future", "1"}}, "x.mcap"));
  for (const Map& bad : {Map{{"size_m", "3 m"}}, Map{{"parameter.c_R", ""}}, Map{{"index", "1.5"}},
                         Map{{"direction", "left"}}})
    EXPECT_THAT([&] { run_record(bad, "x.mcap"); },
                ThrowsTelling(RecordingProblem::bad_entry, "x.mcap", bad.begin()->first));
  EXPECT_THAT(([] {
                run_record(Map{{"format", "2"}}, "x.mcap");
              }),
              ThrowsTelling(RecordingProblem::of_newer_version, "x.mcap"));
}

TEST(RunRecord, RunsAreNamedByWhatIsKnown) {
  EXPECT_EQ(run_name(full_info()), "run square ccw 4 (after)");
  EXPECT_EQ(run_name({}), "run");
}

TEST(Numbers, SecondsAreExact) {
  EXPECT_EQ(seconds_text(0), "0.000000");
  EXPECT_EQ(seconds_text(1'234'567), "1.234567");
  EXPECT_EQ(seconds_text(-1), "-0.000001");
  EXPECT_EQ(seconds_text(std::numeric_limits<std::int64_t>::min()), "-9223372036854.775808");
}

}  // namespace
}  // namespace astro::recording
