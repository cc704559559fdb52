#include "tests/host/calibration/ml_drives.hpp"
#include "tests/host/commands/sentences/sentences.hpp"
#include "tests/host/import/drives/drive_files.hpp"
#include "tests/support/base/gzip.hpp"

// The whole sentences about wheels and ground truth that other programs recorded.
namespace astro {
namespace {

const std::string kSizes = " --wheel-diameter 0.084 --counts-per-turn 4096 --wheelbase 0.29";

class FileSentences : public support::Sentences {
 protected:
  /// A square of 1 m that other programs recorded: wheels w.csv, ground truth t.tum.
  FileSentences() {
    simulation::study::DriveModel model = calibration::quiet_drive();
    model.metres_per_count = test::kMetresPerCount;
    run_ = calibration::squares(model, 1, 1).front();
    test::write_counts("w.csv", run_);
    test::write_tum("t.tum", run_);
  }

  static std::string files(const std::string& wheels, const std::string& truth,
                           const std::string& more = "") {
    return "calibrate files --wheels " + wheels + " --truth " + truth + kSizes + more;
  }

  /// One rigid body of Motive, without rows.
  static std::string motive(const std::string& kind) {
    std::string text = "Format Version,1.23,Take Name,drive,Length Units,Millimeters\n\n";
    for (const std::string& cell : {kind, std::string("ASTRO"), std::string("1")})
      text +=
          ",," + cell + "," + cell + "," + cell + "," + cell + "," + cell + "," + cell + "," + cell + "\n";
    return text +
           ",,Rotation,Rotation,Rotation,Rotation,Position,Position,Position\n"
           "Frame,Time (Seconds),X,Y,Z,W,X,Y,Z\n0,0.0,0,0,0,1,0,0,0\n1,0.1,0,0,0,1,1,0,0\n";
  }

  /// The rows of the ground truth in centimetres.
  std::string hundredfold() const {
    std::string rows;
    for (const calibration::BodySample& at : run_.truth)
      rows +=
          fmt::format("{:.6f},{:.4f},{:.4f},{:.6f}\n", at.time_s, 100 * at.x_m, 100 * at.y_m, at.theta_rad);
    return rows;
  }

  calibration::Trajectory run_;
};

TEST_F(FileSentences, TellWhatIsWrongWithATableOfWheels) {
  const std::string head = "time_s,left_counts,right_counts\n";
  write("names.csv", "when,a,b\n1,2,3\n");
  write("word.csv", head + "1,2,x\n");
  write("comma.csv", "time_s,left_rad,right_rad\n1,0,2,5,3,5\n1,1,2,5,3,5\n");
  write("back.csv", head + "2,2,3\n1,2,3\n");
  write("short.csv", head + "2,2,3\n");
  write("empty.csv", "");
  write("gap.csv", head + "2,2,3\n3,,4\n");
  std::string lost = head, restart = head;
  for (int i = 0; i < 40; ++i) {
    if (i != 10 && i != 11 && i != 25) lost += fmt::format("{:.1f},10,10\n", 0.1 * i);
    restart += fmt::format("{:.1f},{},{}\n", 0.1 * i, 100 * (i % 20) + (i < 20 ? 50'000 : 0), 90 * i);
  }
  write("lost.csv", lost);
  write("restart.csv", restart);
  expect({
      {"columns without a meaning", files("names.csv", "t.tum"),
       "names.csv: no column is named as a time; the columns are when, a, b: say what they are with "
       "--wheel-columns, such as time_s,left_counts,right_counts (also ..._rad, ..._m, ..._rad_s, ..._rpm, "
       "..._m_s; - for one that is not used)"},
      {"a word for a number", files("word.csv", "t.tum"), "word.csv, line 2, column 3: 'x' is not a number"},
      {"decimal commas", files("comma.csv", "t.tum"),
       "comma.csv, line 2: the row has 6 cells and the header 3: are its numbers written with decimal "
       "commas? Save the table with semicolons or tabs between the cells"},
      {"a time before that above", files("back.csv", "t.tum"),
       "back.csv, line 3: the time falls from 2.000 s to 1.000 s: cut the table there if its clock started "
       "again, or sort "
       "the rows if they are out of order"},
      {"one row", files("short.csv", "t.tum"),
       "short.csv, line 2: the table ends with fewer than two rows of wheels"},
      {"an empty file", files("empty.csv", "t.tum"), "'empty.csv' is empty"},
      {"an empty cell in travel", files("gap.csv", "t.tum", " --per-interval"),
       "gap.csv, line 3: a cell is empty, and travel per interval cannot be left out: give every column a "
       "cell, and write numbers with a decimal point"},
      {"lost rows of travel", files("lost.csv", "t.tum", " --per-interval"),
       "lost.csv has lost rows in 2 places, the first before 1.200 s: after longer steps the wheels have "
       "gone no further than in others, so 7.7 % of the travel is missing: record again with a clock that "
       "nothing sets, and log the "
       "counters themselves, of which a lost row takes nothing away"},
      {"a counter that starts again", files("restart.csv", "t.tum"),
       "restart.csv: the left wheel jumps from 51900 to 0 at 2.000000 s, which is neither motion nor the end "
       "of a counter whose range is known: if a counter starts again there at the end of its range, give it "
       "with "
       "--counter-range, otherwise cut the recording there"},
      {"no file", files("none.csv", "t.tum"), "none.csv does not exist: check the path"},
  });
}

TEST_F(FileSentences, TellWhatIsWrongWithADrive) {
  write("leap.csv", "time_s,left_m,right_m\n0,0,0\n0.1,0.01,0.01\n0.2,4,4\n0.3,4.01,4.01\n");
  write("far.csv", "time_s,left_m,right_m\n0,0,0\n0.1,0.01,0.01\n60,100,100\n60.1,100.01,100.01\n");
  test::write_tum("down.tum", run_, test::z_down);
  test::write_plain_millimetres("flat.csv", run_);
  std::filesystem::copy_file("w.csv", "copy.csv");
  std::string exchanged = text_of("w.csv");
  const std::string names = "left_counts,right_counts";
  write("x.csv", exchanged.replace(exchanged.find(names), names.size(), "right_counts,left_counts"));
  const std::string pair = "calibrate files --wheels w.csv --truth t.tum";
  expect({
      {"a leap", files("leap.csv", "t.tum"),
       "'leap.csv' with 't.tum': 'leap': a wheel leaps by 3.99 m between the samples at 0.100 s and 0.200 s, "
       "as where a counter starts again; cut the recording there, or check the unit of the wheels and "
       "whether their rows are travel --per-interval; a counter that starts again at its end needs "
       "--counter-range"},
      {"a gap of many turns", files("far.csv", "t.tum"),
       "'far.csv' with 't.tum': 'far': a wheel turns more than 100 times between the samples at 0.100 s and "
       "60.000 s: check the unit of the wheels, and whether their rows are travel --per-interval"},
      {"exchanged wheels", files("x.csv", "t.tum"),
       "'x.csv' with 't.tum': the wheels turn the robot the other way than the ground truth, and the body is "
       "0.21 m above the tracker's origin: give --swap-wheels if left and right are exchanged, or --up with "
       "the axis of the tracker that points up"},
      {"exchanged wheels, axis stated", files("x.csv", "t.tum", " --up z"),
       "'x.csv' with 't.tum': the wheels turn the robot the other way than the ground truth: give "
       "--swap-wheels if left and right are exchanged, or another axis to --up"},
      {"wheels that were exchanged in vain", files("w.csv", "t.tum", " --swap-wheels"),
       "'w.csv' with 't.tum': the wheels turn the robot the other way than the ground truth, and the body is "
       "0.21 m above the tracker's origin: leave out --swap-wheels if left and right are not exchanged, or "
       "give --up with the axis of the tracker that points up"},
      {"wheels that were exchanged in vain, axis stated", files("w.csv", "t.tum", " --swap-wheels --up z"),
       "'w.csv' with 't.tum': the wheels turn the robot the other way than the ground truth: leave out "
       "--swap-wheels if left and right are not exchanged, or give --up with the axis of the tracker that "
       "points up"},
      {"wheels that were exchanged in vain and an axis down", files("w.csv", "down.tum", " --swap-wheels"),
       "'w.csv' with 'down.tum': the body is 0.21 m below the tracker's origin, so the axis that seems to "
       "point up may point down and the wheels may not be exchanged: leave out --swap-wheels if left and "
       "right are not exchanged, or give --up with the axis of the tracker that points up"},
      {"exchanged wheels, no height", files("x.csv", "flat.csv"),
       "'x.csv' with 'flat.csv': the wheels turn the robot the other way than the ground truth, and nothing "
       "shows which of the two is a mirror image: give --swap-wheels if left and right are exchanged, or "
       "--up with the axis of the tracker that points up"},
      {"exchanged wheels, axis down", files("x.csv", "down.tum"),
       "'x.csv' with 'down.tum': the body is 0.21 m below the tracker's origin, so the axis that seems to "
       "point up may point down and the wheels may be exchanged: give --swap-wheels if left and right are "
       "exchanged, or --up with the axis of the tracker that points up"},
      {"the same wheels twice", files("w.csv", "t.tum", " --wheels w.csv --truth t.tum"),
       "'w.csv' is given twice, and a drive that counts twice would seem more certain than it is: name "
       "another file"},
      {"a copy of the wheels", files("w.csv", "t.tum", " --wheels copy.csv --truth t.tum"),
       "'copy' is a copy of 'w', and a drive that counts twice would seem more certain than it is: name "
       "another file"},
      {"no wheelbase", pair,
       "'w.csv' with 't.tum': the wheelbase of the robot is not known: give --wheelbase, or a file with "
       "--robot"},
      {"no diameter", pair + " --wheelbase 0.29",
       "'w.csv' with 't.tum': the diameter of the robot's wheels is not known: give --wheel-diameter, or a "
       "file with --robot"},
      {"no counts", pair + " --wheelbase 0.29 --wheel-diameter 0.084",
       "'w.csv' with 't.tum': how many counts make a turn of the wheel is not known: give --counts-per-turn, "
       "or a file with --robot"},
      {"wheels alone", "calibrate files --wheels w.csv" + kSizes,
       "there are 1 --wheels and 0 --truth: each drive needs both"},
  });
}

TEST_F(FileSentences, TellWhatIsWrongWithAFileOfATracker) {
  test::write_motive("take.csv", run_);
  write("marker.csv", motive("Marker"));
  write("numbers.csv", "0,0.0,0,0,0,1,0,0,0\n1,0.1,0,0,0,1,1,0,0\n");
  write("names.csv", "time_s,a,b\n1,2,3\n");
  write("word.csv", "time_s,x_m,y_m,yaw_rad\n1,2,3,0\n2,abc,3,0\n");
  write("back.csv", "time_s,x_m,y_m,yaw_rad\n2,2,3,0\n1,2,3,0\n");
  write("two.csv", "time_s,a.x_m,a.y_m,b.x_m,b.y_m\n1,1,1,1,1\n2,1,1,1,1\n");
  write("units.csv", "time_s,x_m,y_mm\n1,1,1\n2,1,1\n");
  write("empty.csv", "");
  const Bytes packed = support::gzip(motive("Rigid Body"));
  write("cut.csv.gz", std::string(as_text(packed).substr(0, 40)));
  std::string line = "time_s,x_m,y_m,z_m\n";
  for (int i = 0; i < 400; ++i) line += fmt::format("{:.2f},{:.3f},0,0\n", 0.05 * i, 0.01 * i);
  write("line.csv", line);
  write("hundredfold.csv", "time_s,x_m,y_m,yaw_rad\n" + hundredfold());
  expect({
      {"another body", files("w.csv", "take.csv", " --body NONE"),
       "'take.csv' holds no body of the name 'NONE', but 'ASTRO': name one of them with --body"},
      {"several bodies", files("w.csv", "two.csv"),
       "'two.csv' holds several bodies: 'a', 'b': name one of them with --body"},
      {"markers alone", files("w.csv", "marker.csv"),
       "'marker.csv' holds no rigid body with positions, only columns of type 'Marker': solve the assets of "
       "the take, and export it again with rigid bodies switched on"},
      {"no header", files("w.csv", "numbers.csv"),
       "'numbers.csv' begins with numbers: without a header its columns have no meaning: export the "
       "recording again with its header; or say what they are with --truth-columns, such as "
       "time_s,x_m,y_m,theta_rad"},
      {"columns without a meaning", files("w.csv", "names.csv"),
       "'names.csv' has no columns for the time and for x and y, such as time_s, x_m and y_m; its columns "
       "are time_s, a, b: say what they are with --truth-columns"},
      {"an empty file", files("w.csv", "empty.csv"), "'empty.csv' is empty"},
      {"a word for a number", files("w.csv", "word.csv"),
       "word.csv, line 3, column 2: 'abc' is not a number"},
      {"a time before that above", files("w.csv", "back.csv"),
       "back.csv, line 3: the time falls from 2.000 s to 1.000 s: cut the table there if its clock started "
       "again, or sort "
       "the rows if they are out of order"},
      {"packed and cut off", files("w.csv", "cut.csv.gz"),
       "'cut.csv.gz' is packed with gzip and cut off at byte 40; use the original"},
      {"two units", files("w.csv", "units.csv"),
       "units.csv, line 1, column 3: the positions have different units, 'm' and 'mm'"},
      {"one line", files("w.csv", "line.csv"),
       "'w.csv' with 'line.csv': the recording does not show which axis points up: the body neither turned "
       "nor drove a curve: drive both ways round, and lines as well as turns; or give the axis that points "
       "up with --up"},
      {"centimetres for metres", files("w.csv", "hundredfold.csv"),
       "c_R = 101, c_L = 100 and b = 29 m came out, which no robot of 0.29 m wheelbase has: check the unit "
       "of the ground truth, the wheel diameter and the counts of a turn; 'astrolabe check-wiring' finds "
       "wrong "
       "counts of a robot"},
      {"no file", files("w.csv", "none.csv"), "none.csv does not exist: check the path"},
  });
}

TEST_F(FileSentences, SayOnceWhatHoldsForAllDrives) {
  calibration::Trajectory later = run_;
  later.wheels.pop_back();
  test::write_counts("w2.csv", later);
  std::string rows;
  for (const calibration::BodySample& at : run_.truth)
    rows += fmt::format("{:.6f},{:.6f},{:.6f},{:.6f}\n", at.time_s, at.x_m, at.y_m, at.theta_rad);
  write("unitless.csv", "time_s,x,y,yaw\n" + rows);
  EXPECT_EQ(notices_of(files("w.csv", "unitless.csv") + " --wheels w2.csv --truth unitless.csv"),
            "w: 2603 samples of the wheels at 100 Hz over 26.0 s; 1562 poses (CSV) at 60 Hz, 0 lost\n"
            "w2: 2602 samples of the wheels at 100 Hz over 26.0 s; 1562 poses (CSV) at 60 Hz, 0 lost\n"
            "all drives: the unit of length is not stated: metres are assumed\n"
            "all drives: the unit of the heading is not stated: radians are assumed\n");
}

TEST_F(FileSentences, TellWhatLooksOdd) {
  write("unitless.csv", "time,x,y,yaw\n" + hundredfold());
  test::write_tum("down.tum", run_, test::z_down);
  EXPECT_EQ(notices_of(files("w.csv", "unitless.csv")),
            "w: 2603 samples of the wheels at 100 Hz over 26.0 s; 1562 poses (CSV) at 60 Hz, 0 lost\n"
            "w: the unit of the heading is not stated: radians are assumed\n"
            "w: the unit of the time is not stated: s is assumed\n"
            "w: the path is 104.2 times as long as that of the wheels, so one of the two has another unit of "
            "length than it seems; the file states none, and its positions were converted: check the units, "
            "or say that of the ground truth with --truth-unit\n");
  EXPECT_EQ(notices_of(files("w.csv", "unitless.csv", " --truth-unit cm")),
            "w: 2603 samples of the wheels at 100 Hz over 26.0 s; 1562 poses (CSV) at 60 Hz, 0 lost\n"
            "w: the unit of the heading is not stated: radians are assumed\n"
            "w: the unit of the time is not stated: s is assumed\n");
  EXPECT_EQ(
      notices_of(files("w.csv", "down.tum")),
      "w: 2603 samples of the wheels at 100 Hz over 26.0 s; 1562 poses (TUM) at 60 Hz, 0 lost; -z is up\n"
      "w: the wheels show that the tracker's axis that seems to point up points down\n");
}

}  // namespace
}  // namespace astro
