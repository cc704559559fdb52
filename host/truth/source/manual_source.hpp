#pragma once

#include <functional>
#include <optional>

#include "host/base/error.hpp"
#include "host/truth/source/reading.hpp"
#include "host/truth/source/source.hpp"

namespace astro::truth {

/// How a question is answered: by a value that is typed, or by a sign that something was done. The implementation of Ask
/// chooses the key for that sign.
enum class AnswerKind {
  value,
  right_or_entered_again,  // what was entered looks wrong: "y" if it is right
  file_saved,              // the file that was missing is there
  file_corrected,          // the file that could not be read is corrected
  file_corrected_or_kept,  // the file that looks wrong is corrected, or is right as it is
};

/// What a person is asked. `occasion` says why, and what would help, unless it is empty; it goes before the text.
struct Question {
  std::string text;
  Remark occasion = {};
  AnswerKind answer = AnswerKind::value;
};

/// Puts the question, returns the answer.
using Ask = std::function<std::string(const Question&)>;

/// A person with a tape measure, who is asked after each run for the end pose in the run's start frame: x forward and y left
/// of the start mark, heading counter-clockwise, empty if it was not measured. Numbers are in `units` unless they carry their
/// own (reading.hpp); each question shows what odometry says. In place of a number "back" asks for this run's numbers again,
/// and "redo" has the run driven again. If the end can hardly be that of the run (plausibility.hpp), the person is asked
/// whether it is right.
class ManualSource : public Source {
 public:
  explicit ManualSource(Ask ask, Units units = {}) : ask_(std::move(ask)), units_(units) {}

  std::vector<recording::TruthSample> poll() override { return {}; }
  bool comes_afterwards() const override { return true; }
  /// Returns the start mark for the samples in which the robot stood there, and the measured pose for those
  /// in which it stood at the end.
  std::optional<std::vector<recording::TruthSample>> complete(const recording::Run& run) override;
  std::string name() const override { return "manual"; }
  std::string clock() const override { return "robot"; }

 private:
  bool is_right(const recording::Run& run, const recording::TruthSample& end);

  Ask ask_;
  Units units_;
};

/// A sample for every odometry sample within `stretch_us` of the run's start (pose `start`) and end (pose
/// `end`). This is how a source that knows only both ends is written into a run.
std::vector<recording::TruthSample> at_both_ends(const recording::Run& run,
                                                 const recording::TruthSample& start,
                                                 const recording::TruthSample& end,
                                                 std::int64_t stretch_us = 500'000);

}  // namespace astro::truth
