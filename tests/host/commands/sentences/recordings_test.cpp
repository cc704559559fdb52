#include <utility>

#include "host/recording/run_file.hpp"
#include "tests/host/commands/sentences/sentences.hpp"
#include "tests/host/recording/support.hpp"

// The whole sentences about recordings, tables of end poses and calibrations.
namespace astro {
namespace {

class RecordingSentences : public support::Sentences {
 protected:
  /// A square that ends 22 mm and 3 degrees off.
  static recording::Run square(Sense direction) {
    recording::support::Drive drive;
    drive.odometry_end = {0, 0, direction == Sense::cw ? -6.28 : 6.28};
    drive.truth_end = {0.02, 0.01, drive.odometry_end.theta_rad + 0.05};
    recording::Run run = drive.run();
    if (direction == Sense::ccw)
      for (recording::OdometrySample& sample : run.odometry)
        std::swap(sample.left_counts, sample.right_counts);
    run.info.direction = direction;
    run.info.size_m = 3;
    run.info.parameters = {{"c_R", 1}, {"c_L", 1}, {"b", 0.29}, {"wheel_diameter", 0.084}};
    return run;
  }

  /// Odometry says one metre ahead, and ground truth three.
  static recording::Run line() {
    recording::support::Drive drive;
    drive.odometry_end = {1, 0, 0};
    drive.truth_end = {3, 0, 0};
    recording::Run run = drive.run();
    for (recording::OdometrySample& sample : run.odometry) sample.right_counts = sample.left_counts;
    run.info = square(Sense::cw).info;
    run.info.kind = "line";
    run.info.direction.reset();
    run.info.size_m = 1;
    return run;
  }

  /// As FOLDER/NAME.mcap.
  static void record(const std::string& folder, const std::string& name, const recording::Run& run) {
    std::filesystem::create_directories(folder);
    recording::write_run(folder + "/" + name + ".mcap", run);
  }

  static std::string ends(const std::string& cw, const std::string& more = "",
                          const std::string& ccw = "ccw.csv") {
    return "calibrate end-poses --cw " + cw + " --ccw " + ccw + " --side 3 --wheelbase 0.29" + more;
  }
};

TEST_F(RecordingSentences, TellWhatIsWrongWithAFolderOfRecordings) {
  std::filesystem::create_directory("nothing");
  std::filesystem::create_directory("text");
  write("text/a.mcap", "nothing that was recorded");
  record("one-way", "cw-1", square(Sense::cw));
  recording::Run blind = square(Sense::cw);
  blind.truth.clear();
  record("blind", "cw-1", blind);
  record("half", "blind-1", blind);
  record("half", "ccw-1", square(Sense::ccw));
  const std::string kNoTruth =
      "none of the recordings has ground truth, so nothing tells where the robot really was: drive again "
      "with 'astrolabe umbmark' or 'astrolabe record --truth SOURCE', or give a film of the drives with "
      "--truth film:FILE";
  record("twice", "cw-1", square(Sense::cw));
  record("twice", "cw-2", square(Sense::cw));
  record("long", "cw-1", square(Sense::cw));
  record("long", "ccw-1", square(Sense::ccw));
  record("long", "line-1", line());
  record("cut", "cw-1", square(Sense::cw));
  std::filesystem::resize_file("cut/cw-1.mcap", std::filesystem::file_size("cut/cw-1.mcap") / 2);
  record("stub", "cw-1", square(Sense::cw));
  std::filesystem::resize_file("stub/cw-1.mcap", 100);
  record("flipped", "cw-1", square(Sense::cw));
  {
    std::fstream file("flipped/cw-1.mcap", std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(std::filesystem::file_size("flipped/cw-1.mcap") / 2));
    file << "XXXXXXXX";
  }
  write("drives.txt", "");
  expect({
      {"no folder", "calibrate runs none", "none does not exist: name a folder that holds recorded runs"},
      {"a file", "calibrate runs drives.txt", "drives.txt is a file: name a folder that holds recorded runs"},
      {"an empty folder", "calibrate runs nothing",
       "no recordings (*.mcap) in nothing: record some with 'astrolabe record' or 'astrolabe umbmark', or "
       "name another folder"},
      {"text with the name of a recording", "calibrate runs text",
       "text/a.mcap is not an MCAP file: name a recording made by Astrolabe"},
      {"one direction", "calibrate runs one-way --method robust",
       "there are no counter-clockwise runs, and one direction alone cannot separate the error of the wheel "
       "diameters from that of the wheelbase: drive the square at least once clockwise and once "
       "counter-clockwise"},
      {"a copy", "calibrate runs twice",
       "cw-1 and cw-2 are the same recording: leave one out with --without cw-2"},
      {"a line of three times its length", "calibrate runs long --method robust",
       "the measured lines give a scale of 3, and a robot has one between 0.5 and 2: check the units"},
      {"no ground truth", "calibrate runs blind", kNoTruth},
      {"no ground truth, by maximum likelihood", "calibrate runs blind --method ml", kNoTruth},
      {"no ground truth in one of two", "calibrate runs half --method robust",
       "'blind-1' has no valid ground truth while it stands at its start: check that the tracker sees the "
       "robot there"},
      {"no ground truth in one of two, by maximum likelihood", "calibrate runs half --method ml",
       "nothing followed the robot while 'blind-1' was recorded, and maximum likelihood needs that: leave it "
       "out with 'astrolabe calibrate runs --without blind-1', or use --method robust, extended or umbmark"},
      {"cut off in the middle", "calibrate runs cut",
       "'cw-1' does not stand still for 0.2 s at its end: record a standstill there"},
      {"cut off at the beginning", "calibrate runs stub",
       "stub/cw-1.mcap is not a recording of a run (it has no record astrolabe.run): name a recording made "
       "by Astrolabe"},
      {"damaged", "calibrate runs flipped",
       "flipped/cw-1.mcap is damaged (the data have a wrong checksum: found at byte 43554): copy it again "
       "from where it was recorded, or record the run again; --damaged uses what can be read of it"},
      {"a name that is left out and not there", "calibrate runs one-way --without cw-7",
       "there is no recording 'cw-7' in one-way to leave out: it holds cw-1"},
      {"all left out", "calibrate runs one-way --without cw-1",
       "every recording in one-way is left out: keep some to calibrate from"},
      {"no experiment to report", "report one-way",
       "'one-way' holds no experiment (no experiment.json): name the --out of 'astrolabe umbmark', or two or "
       "more folders of recordings"},
      {"no experiment to compare", "compare one-way",
       "'one-way' holds no experiment (no experiment.json): name the --out of 'astrolabe umbmark', or two or "
       "more folders of recordings"},
      {"nothing to report", "report none",
       "'none' does not exist: name the --out of 'astrolabe umbmark', or two or more folders of recordings"},
      {"nothing to compare", "compare none",
       "'none' does not exist: name the --out of 'astrolabe umbmark', or two or more folders of recordings"},
      {"one empty folder of two", "compare one-way nothing",
       "there is no counter-clockwise run: record at least one, better five"},
      {"nothing named to report", "report",
       "name either folders of recordings, or --wheels and --truth of each drive"},
      {"nothing to export", "export none --csv x", "none does not exist: check the path"},
      {"no form of export", "export one-way", "name a folder with --csv, --tum or --rosbag"},
      {"text to export", "export text/a.mcap --csv x",
       "text/a.mcap is not an MCAP file: name a recording made by Astrolabe"},
  });
}

TEST_F(RecordingSentences, TellThatARecordingWasCutOff) {
  record("cut", "cw-1", square(Sense::cw));
  std::filesystem::resize_file("cut/cw-1.mcap", std::filesystem::file_size("cut/cw-1.mcap") / 2);
  EXPECT_EQ(notices_of("calibrate runs cut"),
            "warning: cut/cw-1.mcap was cut off while it was recorded: what was driven last is missing\n");
}

TEST_F(RecordingSentences, TellWhatIsWrongWithATableOfEndPoses) {
  write("ccw.csv", "ex_mm,ey_mm,etheta_deg\n-10,20,1\n-11,21,1\n");
  write("unitless.csv", "ex,ey_mm\n1,2\n");
  write("gap.csv", "ex_mm,ey_mm\n1,\n");
  write("double.csv", "ex_mm,ex_m,ey_mm\n1,1,2\n");
  const std::string head = "ex_mm,ey_mm,etheta_rad\n";
  write("was-ccw.csv", head + "300,-250,0.17\n310,-260,0.18\n290,-245,0.165\n");
  write("was-cw.csv", head + "-230,-260,0.15\n-240,-250,0.155\n-220,-255,0.148\n");
  write("long.csv", "ex_mm,ey_mm\n1,2,3\n");
  write("header.csv", "ex_mm,ey_mm\n");
  write("narrow.csv", "ex_mm\n1\n");
  write("word.csv", "ex_mm,ey_mm\n1,b\n");
  write("huge.csv", "ex_mm,ey_mm\n1,1e999\n");
  write("mixed.csv", "direction,ex_mm,ey_mm\ncw,1,2\nccw,1,2\n");
  write("ccw-runs.csv", "direction,ex_mm,ey_mm\nccw,1,2\n");
  write("open.csv", "ex_mm,ey_mm,etheta_deg\n1,2,1\n\n1,2,\n");
  write("left.csv", "direction,ex_mm,ey_mm\nleft,1,2\n");
  write("places.csv", "ex_mm,ey_mm\n1,2\n2,3\n");
  write("metres.csv", "ex_m,ey_m\n100,200\n110,210\n");
  write("far.csv", "ex_m,ey_m,etheta_rad\n2.9,0,0.1\n2.9,0,0.1\n");
  write("near.csv", "ex_m,ey_m,etheta_rad\n-2.9,0,0.1\n-2.9,0,0.1\n");
  write("empty.csv", "");
  expect({
      {"no unit", ends("unitless.csv"),
       "unitless.csv, line 1: column ex is not named by error and unit, as ex_mm or ex_cm or ex_m is"},
      {"an empty cell", ends("gap.csv"),
       "gap.csv, line 2: column ey_mm: the cell is empty: write the number or leave the run out"},
      {"a doubled column", ends("double.csv"),
       "double.csv, line 1: columns ex_mm and ex_m both give ex: keep one of them"},
      {"the same file twice", ends("ccw.csv"),
       "the clockwise and the counter-clockwise runs are the same numbers: name the other file, or keep them "
       "with --keep-odd"},
      {"exchanged files", ends("was-ccw.csv", "", "was-cw.csv"),
       "no wheels and no wheelbase bring the robot to these ends; they would fit if the directions were "
       "exchanged: correct it, or keep the runs as they are with --keep-odd"},
      {"a row of another length", ends("long.csv"),
       "long.csv, line 2: the row has 3 cells and the header 2: write numbers with a decimal point, or "
       "separate "
       "the cells by semicolons"},
      {"no rows", ends("header.csv"),
       "header.csv has a header and no data rows: it needs one per run below it"},
      {"no column", ends("narrow.csv"), "narrow.csv, line 1: there is no column ey_mm or ey_cm or ey_m"},
      {"a word for a number", ends("word.csv"),
       "word.csv, line 2: column ey_mm: 'b' is not a number such as -12.5"},
      {"a number without end", ends("huge.csv"),
       "huge.csv, line 2: column ey_mm: '1e999' is not a number such as -12.5"},
      {"both directions", ends("mixed.csv"),
       "mixed.csv, line 3: column direction: the file mixes cw and ccw runs where one direction is wanted: "
       "split it"},
      {"the table of the other direction", ends("ccw-runs.csv"),
       "ccw-runs.csv, line 2: column direction: 'ccw', and this is the table of the clockwise runs: "
       "exchange the two tables, or correct the direction"},
      {"another direction", ends("left.csv"),
       "left.csv, line 2: column direction: 'left' is not a direction, which is cw or ccw"},
      {"no headings", ends("places.csv", " --method extended"),
       "the clockwise runs have no heading error, which the extended method calibrates from: measure the end "
       "headings (etheta_rad or etheta_deg), or use the method umbmark"},
      {"no heading of one run", ends("open.csv", " --method extended"),
       "open.csv, line 4: clockwise run 2 has no heading error, which the extended method calibrates from: "
       "measure the end headings (etheta_rad or etheta_deg), or use the method umbmark"},
      {"millimetres as metres", ends("metres.csv"),
       "metres.csv, line 2: a run of a square of 3 m has an error of 224 m, more than any robot's: name the "
       "columns by their unit, ex_mm or ex_m"},
      {"ends of no robot", ends("far.csv", "", "near.csv"),
       "no pair of wheel and wheelbase ratios explains these ends of squares: check the units, the side "
       "length and that the clockwise and counter-clockwise runs are not exchanged"},
      {"ends of no robot, by least squares", ends("far.csv", " --method least-squares", "near.csv"),
       "no pair of wheel and wheelbase ratios explains these end positions: check the units, the side length "
       "and that the clockwise and counter-clockwise runs are not exchanged"},
      {"an empty file", ends("empty.csv"), "'empty.csv' is empty"},
      {"no file", ends("none.csv"), "none.csv does not exist: check the path"},
      {"a folder", ends("."), ". is a folder: name a file in it"},
  });
}

TEST_F(RecordingSentences, TellWhatIsWrongWithACalibration) {
  const std::string good = "[parameters]\nc_R = 1.001\nc_L = 0.999\nb = 0.29\n";
  write("good.toml", good);
  write("cut.toml", good + "[calibration]\nmethod = \"ml");
  write("table.csv", "time_s,left_counts\n1,2\n");
  write("other.toml", "c = 1\n");
  write("few.toml", "[parameters]\nc_R = 1.001\n");
  write("negative.toml", "[parameters]\nc_R = 1.001\nc_L = 0.999\nb = -0.29\n");
  std::filesystem::create_directory("drives");
  const auto exported = [](const std::string& file, const std::string& to = "out.yaml") {
    return "calibrate export " + file + " --to " + to;
  };
  expect({
      {"cut off", exported("cut.toml"),
       "'cut.toml' line 6 is not TOML: Error while parsing string: encountered end-of-file"},
      {"not TOML", exported("table.csv"),
       "'table.csv' line 1 is not TOML: Error while parsing key-value pair: expected '=', saw ','"},
      {"no parameters", exported("other.toml"),
       "'other.toml' has no [parameters]: it is no calibration and no export of a robot's parameters"},
      {"a factor is missing", exported("few.toml"),
       "'few.toml': it has no c_L under [parameters]: name a file that 'astrolabe calibrate' wrote"},
      {"a wheelbase below 0", exported("negative.toml"),
       "'negative.toml': b = -0.29 m is out of range: 0.05 m to 2 m, so that a robot would refuse it; "
       "calibrate again"},
      {"no file", exported("none.toml"), "none.toml does not exist: check the path"},
      {"a folder", exported("drives"),
       "'drives' is a folder that holds no calibration: name a file that 'astrolabe calibrate' wrote"},
      {"no loaded wheelbase", exported("good.toml"),
       "'good.toml': it does not tell the wheelbase that was loaded in the robot: give --wheel-separation"},
      {"no nominal wheel", exported("good.toml") + " --wheel-separation 0.3",
       "'good.toml': it does not tell the nominal wheel that c_R and c_L refer to: give --wheel-radius"},
      {"no format", exported("good.toml", "out.txt"),
       "'out.txt' does not show the format by its extension (.yaml, .json, .toml): give --format"},
      {"the file itself", exported("good.toml", "good.toml"),
       "'good.toml' is read, and would be overwritten: name another file"},
      {"something else in the way",
       exported("good.toml --wheel-separation 0.3 --wheel-radius 0.04", "other.toml"),
       "'other.toml' exists and is no export of this program, as what would replace it is: remove it or name "
       "another file"},
  });
}

}  // namespace
}  // namespace astro
