#include <gmock/gmock.h>

#include "host/formats/files/sqlite.hpp"
#include "host/import/drives/file_inspection.hpp"
#include "host/import/drives/import_drives.hpp"
#include "tests/host/import/drives/file_samples.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/temporary_folder.hpp"

// Files that claim, pack or repeat far more than they hold are inspected and imported within the limits of bounded.hpp.
namespace astro::importing {
namespace {

namespace fs = std::filesystem;
using support::filled;
using support::measured;
using support::Taken;
using test::McapBag;
using testing::AnyOf;
using testing::HasSubstr;

constexpr std::size_t kMebibyte = std::size_t{1} << 20;

class BoundedImport : public testing::Test {
 protected:
  fs::path at(const std::string& name) const { return folder_.path() / name; }

  /// Inspects the file and reads wheels and truth from it, each within the bound; returns all complaints.
  std::string bounded(const fs::path& path, std::size_t bytes) const {
    std::string complaints;
    const std::function<void()> uses[] = {[&] { inspect_file(path); }, [&] { read_truth(path); },
                                          [&] { read_wheels(path); }};
    for (const auto& use : uses) {
      const double most_s = 1 + 40e-9 * static_cast<double>(bytes);  // a second, and 25 MB/s
      const Taken taken = measured(use, most_s);
      EXPECT_TRUE(taken.ended);
      if (support::kMeasuresMemory) {
        EXPECT_LE(taken.peak_bytes, 4 * bytes + 64 * kMebibyte);
        EXPECT_LE(taken.cpu_s, most_s);
      }
      EXPECT_THAT(taken.complaint, AnyOf("", HasSubstr(path.filename().string())));
      complaints += taken.complaint + '\n';
    }
    return complaints;
  }
  std::string of(const std::string& name, ByteView bytes) const {
    test::save(at(name), bytes);
    return bounded(at(name), bytes.size());
  }
  std::string of(const std::string& name, const std::string& text) const { return of(name, as_bytes(text)); }

  const test::TemporaryFolder folder_;
};

/// A message of TF with so many transforms of zeros between frames without names.
Bytes transforms(std::uint32_t count) {
  ros2::CdrWriter out;
  out.number(count);
  Bytes message = out.bytes();
  message.resize(message.size() + std::size_t{72} * count);
  return message;
}

Bytes transform(const std::string& child) {
  return ros2::encode_tf({{1, "map", child, 0, 0, 0, 0, 0, 0, 1}});
}

Bytes joints(const std::vector<std::string>& names) {
  return ros2::encode_joint_state({1, names, std::vector<double>(names.size()), {}, {}});
}

TEST_F(BoundedImport, AMessageOfHalfAMillionTransforms) {
  for (const std::string compression : {"zstd", "lz4"}) {
    McapBag bag(compression);
    bag.topic(1, "/mocap/tf", test::kTfType);
    bag.message(1, 1, transforms(440'000));  // 31 MB
    of("x.mcap", bag.closed());
  }
}

TEST_F(BoundedImport, FramesWithNamesOfMegabytes) {
  McapBag bag("zstd");
  bag.topic(1, "/mocap/tf", test::kTfType);
  for (int i = 0; i < 250; ++i) {
    bag.message(1, i, transform(std::string(kMebibyte, 'a') + std::to_string(i)));
    if (bag.open_bytes() > 8 * kMebibyte) bag.end_chunk();
  }
  of("x.mcap", bag.closed());
}

TEST_F(BoundedImport, JointsWithNamesOfMegabytes) {
  McapBag bag("zstd");
  bag.topic(1, "/joint_states", test::kJointType);
  for (int i = 0; i < 250; ++i) {
    bag.message(1, i, joints({std::string(kMebibyte, 'a') + std::to_string(i), "left", "right"}));
    if (bag.open_bytes() > 8 * kMebibyte) bag.end_chunk();
  }
  of("x.mcap", bag.closed());
}

TEST_F(BoundedImport, AChannelThatIsAnotherTopicWithEachMessage) {
  McapBag bag("zstd");
  for (int i = 0; i < 250; ++i) {
    bag.topic(1, "/mocap/tf" + std::string(kMebibyte, 'a') + std::to_string(i), test::kTfType);
    bag.message(1, i, transform("robot"));
    if (bag.open_bytes() > 8 * kMebibyte) bag.end_chunk();
  }
  EXPECT_THAT(of("x.mcap", bag.closed()), HasSubstr("x.mcap"));
}

TEST_F(BoundedImport, MillionsOfTheSameStateOfTheJoints) {
  McapBag bag("zstd");
  bag.topic(1, "/joint_states", test::kJointType);
  const Bytes message = joints({"left", "right"});
  for (int i = 0; i < 4'000'000; ++i) {
    bag.message(1, 1, message);
    if (bag.open_bytes() > 30 * kMebibyte) bag.end_chunk();
  }
  of("x.mcap", bag.closed());
}

TEST_F(BoundedImport, ChunksThatClaimGigabytes) {
  for (const std::string compression : {"zstd", "lz4", ""})
    for (const std::uint64_t claimed : {std::uint64_t{31} << 20, std::uint64_t{4} << 30, ~std::uint64_t{0}}) {
      McapBag bag(compression);
      for (int i = 0; i < 20; ++i) bag.add_chunk(Bytes(100'000, 7), claimed);
      of("x.mcap", bag.closed());
    }
}

/// The messages of a bag whose rows are as large as that.
Bytes database_of(const fs::path& path, ByteView message, int rows) {
  {
    bag::Db3Writer bag(path);
    const int topic = bag.add_topic("/mocap/tf", test::kTfType, "");
    for (int i = 0; i < rows; ++i) bag.write(topic, i, message);
    bag.close();
  }
  const fs::path file = path / (path.filename().string() + "_0.db3");
  Bytes bytes = load_file(file);
  fs::remove_all(path);
  return bytes;
}

TEST_F(BoundedImport, MessagesOfADatabaseThatExpandToMegabytes) {
  const Bytes packed = bag::compress_zstd(transforms(440'000));
  of("x.db3", database_of(at("bag"), packed, 20));
}

TEST_F(BoundedImport, PackedFilesWhoseRecordsAreAsLargeAsTheyExpand) {
  McapBag stored("");
  stored.topic(1, "/mocap/tf", test::kTfType);
  while (stored.open_bytes() < 60 * kMebibyte) stored.message(1, 1, transforms(10'000));
  of("x.mcap.zstd", bag::compress_zstd(stored.closed()));
  of("x.db3.zstd", bag::compress_zstd(database_of(at("bag"), Bytes(60 * kMebibyte), 1)));
}

TEST_F(BoundedImport, AHeaderOfADatabaseWithNumbersWithoutEnd) {
  const Bytes whole = database_of(at("bag"), transform("robot"), 500);
  for (const std::size_t at : {16U, 28U, 32U, 36U, 48U, 52U, 56U, 100U, 101U, 103U, 105U}) {
    Bytes bad = whole;
    std::fill_n(bad.begin() + static_cast<std::ptrdiff_t>(at), 4, std::uint8_t{0xFF});
    of("x.db3", bad);
  }
}

TEST_F(BoundedImport, ABagWhoseMetadataNameItsFileAThousandTimes) {
  const fs::path bag = test::write_bag(at("bag"), test::short_drive());
  std::string text = "rosbag2_bagfile_information:\n  relative_file_paths:\n";
  for (int i = 0; i < 60'000; ++i) text += "    - bag_0.db3\n";
  test::save(bag / "metadata.yaml", text);
  EXPECT_EQ(bounded(bag, text.size()), "\n\n\n");
  std::string absent = "rosbag2_bagfile_information:\n  relative_file_paths:\n";
  for (int i = 0; absent.size() < kMebibyte - 100; ++i) absent += "    - " + std::to_string(i) + "\n";
  test::save(bag / "metadata.yaml", absent);
  bounded(bag, absent.size());
}

TEST_F(BoundedImport, TextThatPacksAThousandTimes) {
  const std::string motive = "Format Version,1.23\n,Type,Rigid Body\n";
  EXPECT_THAT(of("x.csv.gz", support::gzip(std::string(200 * kMebibyte, '0'))), HasSubstr("unpacks to more"));
  for (const std::string& text :
       {filled("\n", 60 * kMebibyte), "t,x,y\n" + filled("1,2,3\n", 30 * kMebibyte),
        filled(",", 60 * kMebibyte), "time_s,left_m,right_m\n" + filled("1,2,3\n", 30 * kMebibyte),
        motive + filled(",", 60 * kMebibyte)})
    of("x.csv.gz", support::gzip(text));
  std::string rising = "1 0 0 0 0 0 0 1\n";
  for (int i = 2; rising.size() < 30 * kMebibyte; ++i) rising += std::to_string(i) + " 0 0 0 0 0 0 1\n";
  of("x.tum.gz", support::gzip(rising));
}

TEST_F(BoundedImport, LinesOfAHundredMegabytesAndHeadersOfAMillionColumns) {
  for (const std::string& text :
       {std::string(100 * kMebibyte, '1'), "time_s,x_m,y_m\n" + std::string(100 * kMebibyte, '1'),
        "time_s,left_m,right_m\n0,0,0\n" + std::string(100 * kMebibyte, '1')})
    of("x.csv", text);
  for (const std::string head :
       {"t,x,y,", "time_s,left_m,right_m,", "Format Version,1.23,", "Objects\n100\n,,", "0,"})
    of("x.csv", head + filled("x,", 2'000'000) + "\n1,2,3\n");
}

TEST_F(BoundedImport, TablesOfManyShortRows) {
  std::string wheels = "time_s,left_counts,right_counts\n", truth;
  for (int i = 0; wheels.size() < 48 * kMebibyte; ++i) wheels += std::to_string(i) + ",0,0\n";
  for (int i = 0; truth.size() < 48 * kMebibyte; ++i) truth += std::to_string(i) + " 0 0 0 0 0 0 1\n";
  of("wheels.csv", wheels);
  of("x.tum", truth);
}

TEST_F(BoundedImport, DrivesOfManyShortRows) {
  std::string wheels = "time_s,left_counts,right_counts\n", truth = "time_s,x_m,y_m,yaw_rad\n";
  for (int i = 0; wheels.size() < 16 * kMebibyte; ++i) wheels += std::to_string(i) + ",0,0\n";
  for (int i = 0; truth.size() < 6 * kMebibyte; ++i)
    truth += fmt::format("{},{},{},{}\n", i, i % 7, i % 5, i % 3);
  const fs::path good_wheels = test::write_counts(at("good wheels"), test::short_drive()),
                 good_truth = test::write_tum(at("good truth"), test::short_drive());
  test::save(at("wheels.csv"), wheels);
  test::save(at("truth.csv"), truth);
  ImportChoices choices;
  choices.geometry.wheel_diameter_m = test::kDiameter_m;
  choices.geometry.counts_per_turn = test::kCountsPerTurn;
  choices.geometry.wheelbase_m = 0.29;
  for (const DriveFiles& files :
       {DriveFiles{at("wheels.csv"), good_truth}, DriveFiles{good_wheels, at("truth.csv")},
        DriveFiles{at("wheels.csv"), at("truth.csv")}}) {
    const std::size_t bytes = fs::file_size(files.wheels) + fs::file_size(files.truth);
    const double most_s = 1 + 40e-9 * static_cast<double>(bytes);  // a second, and 25 MB/s
    const Taken taken = measured([&] { import_drives(std::span(&files, 1), choices); }, most_s);
    EXPECT_TRUE(taken.ended);
    if (support::kMeasuresMemory) {
      const std::size_t large_files = bytes > 17 * kMebibyte ? 2 : 1;
      EXPECT_LE(taken.peak_bytes, 4 * bytes + large_files * 64 * kMebibyte) << "each file may take as much";
      EXPECT_LE(taken.cpu_s, most_s);
    }
  }
}

TEST_F(BoundedImport, TimesAtTheEndsOfTheirRange) {
  std::string wheels =
      "time_ns,left_counts,right_counts\n-9100000000000000000,0,0\n9100000000000000000,5,5\n";
  of("wheels.csv", wheels);
  constexpr std::int64_t kEnd = std::numeric_limits<std::int64_t>::max();
  bag::Db3Writer bag(at("bag"));
  const int poses = bag.add_topic("/mocap/tf", test::kTfType, "");
  const int states = bag.add_topic("/joint_states", test::kJointType, "");
  for (const std::int64_t time_ns : {-kEnd, std::int64_t{0}, kEnd}) {
    bag.write(poses, time_ns, ros2::encode_tf({{0, "map", "robot", 1, 2, 0, 0, 0, 0, 1}}));
    bag.write(states, time_ns, ros2::encode_joint_state({0, {"left", "right"}, {}, {1, 2}, {}}));
  }
  bag.close();
  bounded(at("bag"), 10'000);
}

TEST_F(BoundedImport, SizesOfRobotsThatNestRepeatAndReferToThemselves) {
  std::string laughs = "a0: &a0 [1, 1]\n";
  for (int i = 1; i < 40; ++i)
    laughs += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" +
              filled("*a" + std::to_string(i - 1) + ", ", 400) + "1]\n";
  for (const std::string& text :
       {laughs, filled("[", 1'000'000), filled("a: ", 1'000'000), filled("- ", 1'000'000),
        filled("? ", 1'000'000), filled("{", 1'000'000), filled("&a ", 1'000'000), filled("'", 1'000'000),
        filled("a: 1\n", 1'000'000), std::string(2'000'000, ' ')})
    for (const std::string name : {"x.yaml", "x.toml"}) {
      test::save(at(name), text);
      const Taken taken = measured([&] { read_robot_file(at(name)); });
      EXPECT_BOUNDED(taken, text.size());
      EXPECT_THAT(taken.complaint, HasSubstr(name));
    }
}

}  // namespace
}  // namespace astro::importing
