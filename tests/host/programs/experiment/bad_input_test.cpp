#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"

// Bad input of any kind: one clear sentence that names the thing, a non-zero exit, nothing on stdout. What the libraries say of
// files and folders is pinned in tests/host/commands/sentences.
namespace astro {
namespace {

using testing::HasSubstr;

class BadInput : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = folder_.path() / name;
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
  }

  static void refuses(const std::vector<std::string>& arguments, const std::vector<std::string>& words) {
    const support::Outcome outcome = support::astrolabe(arguments);
    EXPECT_TRUE(outcome.code == 1 || outcome.code == 2) << outcome.code;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("astrolabe: ")) << outcome.err;
    for (const std::string& word : words) EXPECT_THAT(outcome.err, HasSubstr(word));
  }

  void refuses_end_poses(const std::string& cw, const std::vector<std::string>& words) {
    refuses({"calibrate", "end-poses", "--cw", file("cw.csv", cw), "--ccw", file("ccw.csv", kGood), "--side",
             "3", "--wheelbase", "0.29"},
            words);
  }

  static constexpr const char* kGood = "ex_mm,ey_mm,etheta_rad\n300,-250,0.17\n310,-260,0.18\n";
  test::TemporaryFolder folder_;
};

TEST_F(BadInput, UnknownCommand) { refuses({"calibrat"}, {"calibrat", "--help"}); }
TEST_F(BadInput, UnknownOption) { refuses({"info", "--colour"}, {"--colour"}); }
TEST_F(BadInput, MissingOption) { refuses({"calibrate", "end-poses"}, {"--cw"}); }
TEST_F(BadInput, NoCommand) { refuses({}, {"--help"}); }

TEST_F(BadInput, CalibrationOverWhatWasMeasured) {
  const std::string good = "ex_mm,ey_mm,etheta_rad\n-230,-260,0.15\n-240,-250,0.155\n",
                    cw = file("cw.csv", good);
  refuses({"calibrate", "end-poses", "--cw", cw, "--ccw", file("ccw.csv", kGood), "--side", "3",
           "--wheelbase", "0.29", "--out", cw},
          {"cw.csv", "is no calibration or parameter file"});
  std::ifstream kept(cw);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(kept), {}), good);
}
TEST_F(BadInput, SizesInMillimetres) {
  const auto end_poses = [&](const std::string& side, const std::string& wheelbase) {
    return std::vector<std::string>{"calibrate",   "end-poses",
                                    "--cw",        file("cw.csv", kGood),
                                    "--ccw",       file("ccw.csv", kGood),
                                    "--side",      side,
                                    "--wheelbase", wheelbase};
  };
  refuses(end_poses("3000", "290"), {"--side", "'3000'", "0.1 to 100 m"});
  refuses(end_poses("3", "290"), {"--wheelbase", "'290'", "0.05 to 2 m"});
  refuses({"study", "--trials", "2", "--wheelbase", "290"}, {"--wheelbase", "'290'"});
  refuses({"plan", "--squares", "5", "--side", "3000"}, {"--side", "'3000'"});
  refuses({"umbmark", "--truth", "sim", "--out", "x", "--side", "3000"}, {"side 3000 m"});
  refuses({"drive", "square", "3000"}, {"a side of 3000 m", "100 m", "in metres"});
  refuses({"drive", "line", "1200"}, {"1200 m", "1000 m", "in metres"});
}
TEST_F(BadInput, TenfoldTypoInOneOfFiveRuns) {
  refuses_end_poses(
      "ex_mm,ey_mm\n-230,-250\n-240,-260\n-2350,-255\n-225,-248\n-235,-252\n",
      {"cw.csv", "run 3", "x = -2350 mm", "x = -235 mm would fit", "decimal point", "--keep-odd"});
  const std::string typed =
      file("typed.csv", "ex_mm,ey_mm\n-230,-250\n-240,-260\n-2350,-255\n-225,-248\n-235,-252\n");
  const support::Outcome kept =
      support::astrolabe({"calibrate", "end-poses", "--cw", typed, "--ccw", typed, "--side", "3",
                          "--wheelbase", "0.29", "--keep-odd", "--json"});
  EXPECT_EQ(support::parse_json(kept.out)["runs_cw"], 5) << kept.err;
  refuses_end_poses("ex_mm,ey_mm\n-230,-250\n-240,-26\n-235,-255\n-225,-248\n-235,-252\n",
                    {"cw.csv", "run 2", "y = -26 mm"});
}
TEST_F(BadInput, FolderOfGroundTruthThatIsNotThere) {
  refuses({"umbmark", "--port", "/nowhere", "--truth", "file", "--truth-folder", "/no/truth", "--out",
           (folder_.path() / "x").string()},
          {"--truth-folder", "there is no folder '/no/truth'"});
}
TEST_F(BadInput, ExportOfFactorsThatARobotWouldRefuse) {
  for (const char* to : {"x.yaml", "x.json", "x.toml"})
    refuses({"calibrate", "export",
             file("calib.toml",
                  "[parameters]\nc_R = 1.7\nc_L = 1\nb = 0.29\n[carried]\nb "
                  "= 0.29\n[nominal]\nwheel_diameter = "
                  "0.072\ncounts_per_wheel_turn = 2803.2\n"),
             "--to", (folder_.path() / to).string()},
            {"calib.toml", "c_R = 1.7", "0.5 to 1.5"});
  refuses({"calibrate", "export",
           file("b.toml", "[parameters]\nc_R = 1\nc_L = 1\nb = 2.9\n[carried]\nb = 0.29\n"), "--to",
           (folder_.path() / "x.json").string()},
          {"b.toml", "b = 2.9 m", "0.05 m to 2 m"});
}
TEST_F(BadInput, EmptyNameOfAFile) {
  refuses({"record", "--lines", "1", "--out", ""}, {"--out", "needs the name"});
}
TEST_F(BadInput, Nan) { refuses_end_poses("ex_mm,ey_mm\n1,nan\n", {"cw.csv", "line 2"}); }
TEST_F(BadInput, BinaryFile) { refuses_end_poses(std::string("\0\xff\xfe\x01", 4), {"cw.csv"}); }

TEST_F(BadInput, SideOfZero) {
  refuses({"calibrate", "end-poses", "--cw", file("cw.csv", kGood), "--ccw", file("ccw.csv", kGood), "--side",
           "0", "--wheelbase", "0.29"},
          {"side"});
}
TEST_F(BadInput, NegativeWheelbase) {
  refuses({"calibrate", "end-poses", "--cw", file("cw.csv", kGood), "--ccw", file("ccw.csv", kGood), "--side",
           "3", "--wheelbase", "-0.29"},
          {"-0.29"});
}
TEST_F(BadInput, WhatIsNoExperimentIsToldFromWhatIsNotThere) {
  const std::string folder = folder_.path().string(), some = file("some.toml", "");
  for (const char* command : {"compare", "report"}) {
    refuses({command, some}, {"some.toml' is a file: name"});
    refuses({command, folder, folder}, {"no recordings"});
    refuses({command, folder + "/none", folder},
            {"none does not exist: name a folder that holds recorded runs"});
  }
}
TEST_F(BadInput, FolderInPlaceOfACalibration) {
  const std::string folder = folder_.path().string();
  refuses({"upload", folder, "--port", "/nowhere"}, {"is a folder", "'astrolabe calibrate'"});
  const std::string some = file("some.toml", "");
  refuses({"upload", folder, "--port", "/nowhere"}, {"is a folder", "such as '" + some + "'"});
  refuses({"calibrate", "export", folder, "--to", "x.json"}, {"such as '" + some + "'"});
}
TEST_F(BadInput, UploadOfSomethingElse) {
  refuses({"upload", file("x.toml", "a = 1\n"), "--port", "/nowhere"}, {"x.toml", "[parameters]"});
  refuses({"upload", file("y.toml", "[parameters\n"), "--port", "/nowhere"}, {"y.toml", "line 1"});
}
TEST_F(BadInput, PortThatIsNotThere) {
  refuses({"umbmark", "--port", "/dev/nowhere", "--truth", "sim", "--out", (folder_.path() / "x").string()},
          {"/dev/nowhere"});
}
TEST_F(BadInput, SettingsThatCannotBeDriven) {
  const std::string out = (folder_.path() / "x").string();
  refuses({"umbmark", "--truth", "sim", "--out", out, "--side", "0"}, {"side 0 m"});
  refuses({"umbmark", "--truth", "sim", "--out", out, "--runs", "0"}, {"0 runs"});
  refuses({"umbmark", "--truth", "moon", "--out", out}, {"moon"});
  refuses({"umbmark", "--truth", "sim", "--out", out, "--until", "soon"}, {"soon", "0.05%"});
  refuses({"umbmark", "--truth", "sim", "--out", out, "--until", "0"}, {"'0'", "0.05%"});
  refuses({"umbmark", "--truth", "sim", "--out", out, "--until", "50%"}, {"precision of 50 %"});
  refuses({"umbmark", "--truth", "sim", "--out", out, "--max-runs", "3"}, {"--until"});
  refuses({"umbmark", "--truth", "manual", "--out", out, "--until", "0.1%"}, {"--truth manual"});
  refuses({"umbmark", "--truth", "sim", "--out", out, "--unit", "cm"}, {"--unit is of --truth manual"});
  refuses({"umbmark", "--truth", "sim", "--out", out, "--angle-unit", "rad"},
          {"--angle-unit is of --truth manual"});
}

}  // namespace
}  // namespace astro
