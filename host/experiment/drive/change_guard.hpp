#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/experiment/analysis/calibration_file.hpp"
#include "host/robot/parameters/far_change.hpp"

namespace astro::experiment {

/// Why a calibration should not be uploaded, or cannot be.
enum class UploadProblem {
  of_other_robot,    // values: the ids of the calibration's robot and of this one
  incomplete,        // value: the factor that is missing
  foreign_e,         // value: the e that the robot holds
  of_other_wheel,    // values: the calibration's wheel and the robot's
  of_other_factors,  // values: a factor, what it was when the calibration was driven, and what it is now
  suspicious,        // values: a factor, and by how many percent it would change; or "e", and both values
  e_unknown_to_firmware,  // value: the calibration's e
  e_needed
};

using robot::Change;

/// The factors in force. A firmware that knows no e has e = 0.
calibration::WheelFactors loaded_factors(const robot::RemoteParameters& robot);

/// Throws astro::Error if firmware with these rows has no e, which every fit by maximum likelihood finds.
void require_e(std::span<const robot::ParameterRow> robot);

/// The values that firmware with these rows understands. Firmware without e turns every arc about b; then e = 0 and kappa0
/// are left out, because they change nothing there. Throws astro::Error if it has no e and e is not 0.
ParameterValues understood_by(std::span<const robot::ParameterRow> robot, ParameterValues values);

/// States which wheel factor changes by more than a tenth, if one does, because that is more likely a mistake (units, sides,
/// another robot) than a calibration. Checks the ratio of c_R, c_L and b, and the difference of e.
std::optional<Remark> suspicion(const std::vector<Change>& changes);

/// Why factors that are not absolute would be wrong with what is loaded in the robot now: they are composed with the factors
/// that were loaded when they were measured. Nothing if they are right.
std::optional<Remark> wrong_loaded_factors(const robot::RemoteParameters& robot, const ParameterFile& file);

/// Why factors would be wrong with the robot's nominal wheel (diameter, gear, encoder): they refer to another one, as far
/// as the file tells it. Nothing if they are right.
std::optional<Remark> wrong_wheel(const robot::RemoteParameters& robot, const ParameterFile& file);

/// Why these changes are uploaded only if forced: the file is of another robot than `identity`, it lacks c_R, c_L or b, it
/// lacks the e that the robot has, or one of the three checks above finds something. The verdict of the calibration's own
/// drives is not among them (judgement_sentences.hpp).
std::vector<Remark> objections(const robot::RemoteParameters& robot, const RobotIdentity& identity,
                               const ParameterFile& file, const std::vector<Change>& changes);

/// The sentence that no factor changes by more than twice its standard error, or "". Such an upload is harmless
/// and of little use. `standard_errors` by name; NaN and those that are missing are unknown.
std::string insignificance(const std::vector<Change>& changes,
                           const std::map<std::string, double>& standard_errors);

/// Old and new side by side, for people.
std::vector<std::vector<std::string>> side_by_side(const std::vector<Change>& changes);

}  // namespace astro::experiment
