#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "host/base/pose2.hpp"
#include "host/calibration/end_poses/end_pose.hpp"
#include "host/recording/run.hpp"

/// The before/after report: one HTML file that needs nothing but a browser.
namespace astro::report {

/// A calibrated parameter. Values in `unit`; standard_error belongs to `after` and is NaN where unknown.
struct ParameterRow {
  std::string name, unit;
  double before = 0, after = 0;
  double standard_error = std::numeric_limits<double>::quiet_NaN();
};

/// A factor that was loaded in the robot in a phase. standard_error is NaN where unknown.
struct LoadedValue {
  double value = 0;
  double standard_error = std::numeric_limits<double>::quiet_NaN();
};

/// A line of a two-column description: "Robot", "ASTRO".
struct DescriptionRow {
  std::string name, value;
};

/// The robot driven with one set of parameters.
struct Phase {
  std::string title;                          // "before", "after", "after repeat 1", ...
  std::vector<recording::Run> runs;           // any kinds, any order
  calibration::ExperimentSummary squares;     // of cw and ccw; unused if one of them is empty
  std::vector<calibration::EndPose> cw, ccw;  // end errors of the squares in the order of the runs
  std::vector<LoadedValue> loaded{};          // in the order of ReportInput::parameters; may be empty
};

/// How one set of factors dead-reckons a drive: odometry less ground truth. NaN where nothing was measured.
struct DriveFigures {
  double end_m = 0, heading_rad = 0, path_rms_m = 0;
};

/// A drive with the factors of the first and of the last phase.
struct DriveRow {
  std::string name;
  DriveFigures before, after;
};

/// Drives of any shape, compared one by one.
struct DriveComparison {
  std::string verdict;  // sentences
  std::vector<DriveRow> drives;
  DriveFigures before, after;  // root mean squares over the drives
};

/// What a laser scanner on the robot saw, where dead reckoning with the factors of before and of after puts it.
struct ScanFigures {
  std::string drive;                  // of the maps
  std::vector<Point2> before, after;  // of the walls, seen from the drive's start
  struct Residual {
    double way_m = 0;  // that was driven by then, in all drives
    Pose2 before,
        after;  // by how much further the scans moved than the wheels say, over a stretch of some decimetres
  };
  std::vector<Residual> residuals;
};

struct ReportInput {
  std::string title;
  std::vector<DescriptionRow> description;  // the robot and the set-up
  std::vector<Phase> phases;                // in the order they were driven; the first is the reference
  std::vector<ParameterRow> parameters;
  bool not_loaded = false;                      // `after` of the parameters was found and is not in the robot
  std::string reason;                           // whether to use them, and why
  std::optional<DriveComparison> comparison{};  // for drives that are no squares
  std::optional<ScanFigures> scans{};           // if a laser scanner was the ground truth
  std::string method;              // how the parameters were found; a blank line starts a new paragraph
  std::vector<std::string> notes;  // anything else a reader should know, such as seeds
};

/// The whole page. Equal inputs give equal bytes; every text of the input is escaped.
/// Size: the plotting library (1.2 MB) and at most about 80 kB for each run.
std::string render_html(const ReportInput& input);

/// render_html to a file, as write_page does it.
void write_report(const std::filesystem::path& path, const ReportInput& input);

}  // namespace astro::report
