#include "host/commands/shared/gyro_view.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/base/error.hpp"
#include "host/base/text/columns.hpp"
#include "host/console/console.hpp"

namespace astro::commands {
namespace {

std::string advice(const experiment::GyroResult& gyro) {
  constexpr double kSurely = 2;  // standard errors
  if (gyro.loaded_scale && gyro.scale.scale < 0)
    return " 'astrolabe params set gyro_axis' with the other sign makes it counter-clockwise.";
  const auto parameter = gyro.parameter();
  if (!parameter || std::abs(gyro.scale.scale - 1) <= kSurely * gyro.scale.se) return "";
  return fmt::format(" 'astrolabe params set gyro_scale={:.5f}' lets the robot know.", *parameter);
}

}  // namespace

std::optional<experiment::GyroResult> gyro_of(const experiment::RunSet& set,
                                              const experiment::Calibration& found) {
  if (found.end_poses() != nullptr) return std::nullopt;
  try {
    return experiment::calibrate_gyro(set, found);
  } catch (const Error& error) {
    console::say(error.in("the gyro is not calibrated: ").sentence);
    return std::nullopt;
  }
}

std::string gyro_text(const experiment::GyroResult& gyro) {
  return wrapped(experiment::gyro_sentence(gyro) + advice(gyro));
}

std::string slips_text(const calibration::GyroAgainstWheels& wheels, const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& slip : experiment::slip_sentences(wheels, names))
    text += wrapped("Take care: " + slip + '.');
  return text;
}

}  // namespace astro::commands
