#include <gmock/gmock.h>
#include <sys/stat.h>

#include <algorithm>
#include <ctime>
#include <initializer_list>

#include "host/experiment/analysis/analysis_problem.hpp"
#include "host/experiment/analysis/parameter_file_problem.hpp"
#include "host/experiment/files/curvature_named.hpp"
#include "host/formats/files/bag.hpp"
#include "host/formats/tables/packed_text.hpp"
#include "host/formats/tables/rows.hpp"
#include "host/import/bags/joint_wheels.hpp"
#include "host/import/bags/sample_limit.hpp"
#include "host/import/drives/file_inspection.hpp"
#include "host/import/drives/import_drives.hpp"
#include "host/import/wheels/counter_wraps.hpp"
#include "host/import/wheels/unclear_choice.hpp"
#include "host/recording/recording_problem.hpp"
#include "host/truth/files/body_choice.hpp"
#include "host/truth/files/track_problem.hpp"
#include "tests/host/import/drives/file_samples.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/mutations.hpp"
#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/base/thorough.hpp"

// Damaged files and files of the wrong kind, through all that an import does with them: each is read or refused by its name,
// within the limits of bounded.hpp.
namespace astro::importing {
namespace {

namespace fs = std::filesystem;
using support::measured;
using support::Taken;
using test::FileSample;
using test::Holds;

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

/// "line 3", "byte 17", "row 5", "at 11.100000 s".
bool names_a_place(const std::string& text) {
  for (const std::string_view unit : {"line ", "byte ", "row ", "column ", " at "})
    for (std::size_t at = text.find(unit); at != std::string::npos; at = text.find(unit, at + 1))
      if (at + unit.size() < text.size() &&
          std::isdigit(static_cast<unsigned char>(text[at + unit.size()])) != 0)
        return true;
  return false;
}

/// What is wrong with a file as a whole is at no place in it: what it lacks, or what it is instead.
bool is_about_the_whole_file(Kind kind) {
  using bag::BagProblem, recording::RecordingProblem, truth::TrackProblem;
  using experiment::ParameterFileProblem;
  const std::initializer_list<Kind> whole = {tables::TextProblem::empty,
                                             tables::PackedProblem::too_large,
                                             TrackProblem::unknown_form,
                                             TrackProblem::older_motive,
                                             TrackProblem::no_motive_header,
                                             TrackProblem::no_header,
                                             TrackProblem::no_body,
                                             TrackProblem::no_rigid_body,
                                             TrackProblem::no_columns,
                                             TrackProblem::no_pose,
                                             truth::BodyProblem::unknown,
                                             BagProblem::not_a_bag,
                                             BagProblem::unreadable_database,
                                             BagProblem::no_such_table,
                                             BagProblem::computed_columns,
                                             RecordingProblem::not_mcap,
                                             RecordingProblem::of_no_run,
                                             RecordingProblem::of_newer_version,
                                             RecordingProblem::bad_entry,
                                             RecordingProblem::too_many_samples,
                                             RecordingProblem::poses_without_counts,
                                             WheelProblem::columns_unclear,
                                             WheelProblem::fields_unclear,
                                             WheelProblem::unit_unclear,
                                             WheelProblem::joints_unclear,
                                             WheelProblem::topic_unclear,
                                             WheelProblem::poses_unclear,
                                             WheelProblem::controller_unclear,
                                             WheelProblem::nothing_to_choose,
                                             SampleProblem::too_many,
                                             JointProblem::too_few_messages,
                                             ParameterFileProblem::no_parameters,
                                             ParameterFileProblem::bad_wheel,
                                             CounterProblem::range_unknown,
                                             CounterProblem::beyond_range,
                                             CounterProblem::too_fast,
                                             ImportProblem::no_poses,
                                             ImportProblem::size_not_above_zero};
  return std::ranges::find(whole, kind) != whole.end();
}

/// What only the two files of a drive show together is named by both of them, and by no place.
bool is_about_both_files(Kind kind) {
  const std::initializer_list<Kind> both = {ImportProblem::no_wheelbase,
                                            ImportProblem::no_wheel_diameter,
                                            ImportProblem::no_counts_per_turn,
                                            ImportProblem::below_origin,
                                            ImportProblem::turns_against_wheels,
                                            ImportProblem::wheels_stand,
                                            ImportProblem::wheel_stands,
                                            ImportProblem::wheels_equal,
                                            ImportProblem::per_interval_likely,
                                            ImportProblem::encoders_reversed,
                                            ImportProblem::drives_backward,
                                            truth::FloorProblem::frames_differ,
                                            truth::FloorProblem::no_up_axis,
                                            truth::FloorProblem::no_valid_pose,
                                            experiment::AnalysisProblem::file_lacks_parameter,
                                            experiment::CurvatureProblem::of_no_robot};
  return std::ranges::find(both, kind) != both.end();
}

/// Puts files through the import, and counts what became of them.
class Importer {
 public:
  explicit Importer(const fs::path& folder) : wheels_(folder / "good wheels"), truth_(folder / "good truth") {
    test::write_counts(wheels_, test::short_drive());
    test::write_tum(truth_, test::short_drive());
    choices_.geometry.wheel_diameter_m = test::kDiameter_m;
    choices_.geometry.counts_per_turn = test::kCountsPerTurn;
    choices_.geometry.wheelbase_m = 0.29;
  }

  void take(const fs::path& path, Holds holds) {
    attempt(path, [&] { inspect_file(path); });
    if (holds == Holds::robot) return attempt(path, [&] { read_robot_file(path); });
    const DriveFiles files{holds == Holds::truth ? wheels_ : path, holds == Holds::wheels ? truth_ : path};
    attempt(path, [&] { import_drives(std::span(&files, 1), choices_); });
  }

  int read = 0, refused = 0;
  double slowest_s = 0;

 private:
  template <class Work>
  void attempt(const fs::path& path, Work work) {
    const std::clock_t start = std::clock();
    try {
      work();
      ++read;
    } catch (const Error& error) {
      ++refused;
      const std::string fact = error.what();
      if (!contains(fact, path.filename().string()))
        throw std::runtime_error("the file is not named: " + fact);
      if (!names_a_place(fact) && !is_about_the_whole_file(error.kind()) &&
          !is_about_both_files(error.kind()))
        throw std::runtime_error("no place is named: " + fact);
    }
    slowest_s = std::max(slowest_s, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }

  fs::path wheels_, truth_;
  ImportChoices choices_;
};

class HostileFiles : public testing::Test {
 protected:
  fs::path at(const std::string& name) const { return folder_.path() / name; }

  void expect_fast(const Importer& importer) const {
    // A few milliseconds are usual, and half a second where the clocks are searched over decades because a stamp is wrong.
    // More would be a loop that the file can make as long as it likes.
    if (support::kMeasuresMemory) {
      EXPECT_LE(importer.slowest_s, 2.0);
    }
  }

  const test::TemporaryFolder folder_;
};

Bytes damaged(support::Mutator& mutator, const FileSample& sample) {
  if (!sample.is_text) return mutator.bytes(sample.bytes);
  const std::string text = mutator.text(std::string(as_text(sample.bytes)));
  return {text.begin(), text.end()};
}

class HostileSamples : public HostileFiles, public testing::WithParamInterface<std::size_t> {
 protected:
  const FileSample sample_ = test::file_samples(folder_.path()).at(GetParam());
};

TEST_P(HostileSamples, AreReadWhole) {
  Importer importer(folder_.path());
  test::save(at(sample_.name), sample_.bytes);
  importer.take(at(sample_.name), sample_.holds);
  EXPECT_EQ(importer.refused, 0) << sample_.format;
}

TEST_P(HostileSamples, OfWhichManyMutationsAreReadOrRefusedByNameAndPlace) {
  constexpr unsigned kSeed = 20'261'123;
  const int mutations = support::how_many_alike(support::how_often(120, 1200));
  SCOPED_TRACE(sample_.format + ", seed " + std::to_string(kSeed));
  const Taken taken = measured([&] {
    support::Mutator mutator(kSeed);
    Importer importer(folder_.path());
    for (int i = 0; i < mutations; ++i) {
      test::save(at(sample_.name), damaged(mutator, sample_));
      importer.take(at(sample_.name), sample_.holds);
    }
    std::cout << "  " << sample_.format << ": " << mutations << " mutations, " << importer.read
              << " times read, " << importer.refused << " times refused, the slowest in "
              << 1000 * importer.slowest_s << " ms\n"
              << std::flush;
    expect_fast(importer);
  });
  EXPECT_TRUE(taken.ended);
  EXPECT_EQ(taken.complaint, "");
  if (support::kMeasuresMemory) {
    EXPECT_LE(taken.peak_bytes, 4 * sample_.bytes.size() + (std::size_t{64} << 20));
  }
}

TEST_P(HostileSamples, CutAtAnyPlaceAreReadOrRefusedByName) {
  SCOPED_TRACE(sample_.format);
  const Taken taken = measured([&] {
    Importer importer(folder_.path());
    const auto cuts = static_cast<std::size_t>(support::how_many_alike(200));
    for (std::size_t i = 0; i < cuts; ++i) {
      test::save(at(sample_.name), ByteView(sample_.bytes).first(i * sample_.bytes.size() / cuts));
      importer.take(at(sample_.name), sample_.holds);
    }
    expect_fast(importer);
  });
  EXPECT_TRUE(taken.ended);
  EXPECT_EQ(taken.complaint, "");
}

INSTANTIATE_TEST_SUITE_P(Formats, HostileSamples, testing::Range(std::size_t{0}, test::kFileSamples));

TEST_F(HostileFiles, OfEveryOtherKindAreRefusedByName) {
  const std::vector<FileSample> samples = test::file_samples(folder_.path());
  std::vector<std::pair<std::string, Bytes>> files{
      {"empty.csv", {}},
      {"picture.csv", {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0, 0, 13, 'I', 'H', 'D', 'R'}},
      {"utf16.csv", {0xFF, 0xFE, 't', 0, ',', 0, 'x', 0}},
      {"noise.db3", Bytes(5000, 0xA5)},
      {"letter.txt", Bytes(as_bytes("Dear reader,\n\nthis is no table.\n").begin(),
                           as_bytes("Dear reader,\n\nthis is no table.\n").end())}};
  for (const FileSample& sample : samples) files.emplace_back("other " + sample.name, sample.bytes);
  const Taken taken = measured([&] {
    Importer importer(folder_.path());
    for (const auto& [name, bytes] : files)
      for (const std::string end : {"", ".toml", ".yaml"}) {
        test::save(at(name + end), bytes);
        for (const Holds holds : {Holds::wheels, Holds::truth, Holds::both, Holds::robot})
          importer.take(at(name + end), holds);
      }
    expect_fast(importer);
  });
  EXPECT_TRUE(taken.ended);
  EXPECT_EQ(taken.complaint, "");
}

TEST_F(HostileFiles, WhatIsNoFileIsRefusedAndNotWaitedFor) {
  ASSERT_EQ(mkfifo(at("pipe.csv").c_str(), 0600), 0);
  fs::create_directory(at("folder.toml"));
  fs::create_symlink("nowhere", at("link.mcap"));
  fs::create_symlink("/dev/zero", at("zeros.yaml"));
  for (const char* name : {"pipe.csv", "folder.toml", "link.mcap", "zeros.yaml", "absent.db3"}) {
    const Taken inspected = measured([&] { inspect_file(at(name)); });
    EXPECT_THAT(inspected.complaint, testing::HasSubstr(name));
    EXPECT_BOUNDED(inspected, 0U);
    const Taken wheels = measured([&] { read_wheels(at(name)); });
    EXPECT_THAT(wheels.complaint, testing::HasSubstr(name));
    const Taken truth = measured([&] { read_truth(at(name)); });
    EXPECT_THAT(truth.complaint, testing::HasSubstr(name));
    const Taken robot = measured([&] { read_robot_file(at(name)); });
    EXPECT_THAT(robot.complaint, testing::HasSubstr(name));
  }
}

}  // namespace
}  // namespace astro::importing
