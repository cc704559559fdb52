#pragma once

#include <filesystem>

#include "host/truth/source/manual_source.hpp"

namespace astro::truth {

/// What is wrong with a file of ground truth. Values: the file; of not_a_number and time_not_increasing the line, and of the
/// former the column and the text there.
enum class TruthFileProblem { no_position, not_a_number, time_not_increasing, too_few_poses };

/// Ground truth that another program recorded: after each run a CSV is read from `folder`; if it is missing,
/// a person is asked to save it. Its name is the run's ("before-square-cw-1.csv"); its header names the
/// columns with units:
///
///   x_m | "x (mm)" ..., y_m ..., theta_rad | yaw_deg ... (optional)
///
/// Without a heading the axes are those of the robot at its start: x forward, y left.
/// The first row is the pose at the start and the last row the pose at the end; the robot stands at both. The
/// rows between are spread over the run, which is only good for plots: by a column of numbers t or time if there is
/// one (in any unit; it must increase), evenly otherwise.
///
/// A file that was written before the run began (recording::RunInfo::started_at) is that of another run, and counts as
/// missing.
///
/// Errors  if a file is missing or cannot be read, `ask` is called with the folder or file, line and column,
///         until the file can be read or `ask` throws. If the end can hardly be that of the run
///         (plausibility.hpp), `ask` is called once; if the file is the same afterwards, it is kept.
class FileSource : public Source {
 public:
  FileSource(std::filesystem::path folder, Ask ask) : folder_(std::move(folder)), ask_(std::move(ask)) {}

  std::vector<recording::TruthSample> poll() override { return {}; }
  bool comes_afterwards() const override { return true; }
  std::optional<std::vector<recording::TruthSample>> complete(const recording::Run& run) override;
  std::string name() const override { return "file"; }
  std::string clock() const override { return "start and end of the run"; }

 private:
  std::filesystem::path folder_;
  Ask ask_;
};

/// "before-square-cw-1.csv"
std::string truth_file_name(const recording::RunInfo& info);

}  // namespace astro::truth
