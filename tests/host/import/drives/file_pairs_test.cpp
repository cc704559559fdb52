#include "host/import/drives/file_pairs.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

namespace astro::importing {
namespace {

using testing::ElementsAre;

std::vector<std::string> paired(const std::vector<OfferedFile>& files) {
  std::vector<std::string> drives;
  for (const DriveFiles& drive : pair_files(files))
    drives.push_back(drive.wheels.string() + " " + drive.truth.string());
  return drives;
}

OfferedFile wheels(const char* name) { return {name, true, false}; }
OfferedFile truth(const char* name) { return {name, false, true}; }
OfferedFile both(const char* name) { return {name, true, true}; }

TEST(FilePairs, AreThoseWhoseNamesShareTheNumberOfTheDrive) {
  EXPECT_THAT(paired({wheels("231220200029_run-01_odo.csv"), wheels("231220200029_run-02_odo.csv"),
                      truth("231220200029_run-02_opti.csv.gz"), truth("231220200029_run-01_opti.csv.gz")}),
              ElementsAre("231220200029_run-01_odo.csv 231220200029_run-01_opti.csv.gz",
                          "231220200029_run-02_odo.csv 231220200029_run-02_opti.csv.gz"));
}

TEST(FilePairs, NumbersCountByValueAndAreSortedByIt) {
  EXPECT_THAT(paired({wheels("w10.csv"), wheels("w2.csv"), truth("take 002.csv"), truth("take 010.csv")}),
              ElementsAre("w2.csv take 002.csv", "w10.csv take 010.csv"));
}

TEST(FilePairs, AreInTheOrderOfTheirNamesWhereNothingInThemTellsDrivesApart) {
  EXPECT_THAT(paired({wheels("b.csv"), wheels("a.csv"), truth("y.tum"), truth("x.tum")}),
              ElementsAre("a.csv x.tum", "b.csv y.tum"));
}

TEST(FilePairs, AWordInAllNamesTellsNothing) {
  // "monday" is in all; only "kitchen" and "hall" tell the drives apart, against the order of the names.
  EXPECT_THAT(paired({wheels("monday wheels hall.csv"), wheels("monday wheels kitchen.csv"),
                      truth("kitchen Monday.tum"), truth("monday-z-HALL.tum")}),
              ElementsAre("monday wheels hall.csv monday-z-HALL.tum",
                          "monday wheels kitchen.csv kitchen Monday.tum"));
}

TEST(FilePairs, AFileThatHoldsBothIsADriveAndOneThatIsLeftOverLacksTheOther) {
  EXPECT_THAT(paired({both("drive.mcap"), wheels("1.csv"), wheels("2.csv"), truth("take2.csv")}),
              ElementsAre("drive.mcap drive.mcap", "1.csv ", "2.csv take2.csv"));
  EXPECT_THAT(paired({both("a.mcap"), both("b.mcap")}), ElementsAre("a.mcap a.mcap", "b.mcap b.mcap"));
  EXPECT_THAT(paired({truth("take.csv")}), ElementsAre(" take.csv"));
  EXPECT_THAT(paired({}), ElementsAre());
}

TEST(FilePairs, WheelsWithOdometryBesideThemAreNoGroundTruthWhereThereIsOther) {
  EXPECT_THAT(paired({both("log1.csv"), both("log2.csv"), truth("take1.csv"), truth("take2.csv")}),
              ElementsAre("log1.csv take1.csv", "log2.csv take2.csv"));
  EXPECT_THAT(paired({both("all.csv"), wheels("log.csv")}), ElementsAre("log.csv all.csv"));
}

TEST(FilePairs, DoNotDependOnTheOrderInWhichTheFilesAreOffered) {
  std::vector<OfferedFile> files;
  std::vector<std::string> names;
  for (int i = 0; i < 12; ++i) names.push_back("day" + std::to_string(i / 4) + "_" + std::to_string(i));
  for (const std::string& name : names) {
    files.push_back({name + "_wheels.csv", true, false});
    files.push_back({"t_" + name, false, true});
  }
  const std::vector<std::string> expected = paired(files);
  EXPECT_EQ(expected.front(), "day0_0_wheels.csv t_day0_0");
  EXPECT_EQ(expected.back(), "day2_11_wheels.csv t_day2_11");
  constexpr unsigned kSeed = 34;
  std::mt19937 random(kSeed);
  for (int i = 0; i < 20; ++i) {
    std::ranges::shuffle(files, random);
    EXPECT_EQ(paired(files), expected) << "seed " << kSeed << ", shuffle " << i;
  }
}

}  // namespace
}  // namespace astro::importing
