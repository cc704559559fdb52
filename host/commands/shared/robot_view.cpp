#include "host/commands/shared/robot_view.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "host/base/error.hpp"
#include "host/base/text/degrees.hpp"
#include "host/base/text/numbers.hpp"
#include "host/base/text/plain_text.hpp"
#include "host/console/console.hpp"
#include "host/robot/client/fault_help.hpp"
#include "host/robot/client/refusal.hpp"

namespace astro::commands {

namespace {

void to_stdout(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  flush_output();
}

}  // namespace

void flush_output() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw Error("the output cannot be written: is the disk full?");
}

void write(const std::string& text) { to_stdout(plain_text(text)); }

void print(const std::string& text) { write(text + '\n'); }

void print_path(const std::filesystem::path& path) {
  console::stdout_is_terminal() ? print(path.string()) : to_stdout(path.string() + '\n');
}

std::string hex_id(const protocol::HelloReply& robot) {
  std::string text;
  for (const std::uint8_t byte : robot.unique_id) text += fmt::format("{:02x}", byte);
  return text;
}

std::vector<std::string> fault_list(std::uint32_t mask) {
  std::vector<std::string> list;
  for (unsigned i = 0; i < 32; ++i)
    if (const std::uint32_t one = mask & (1U << i)) list.push_back(robot::fault_names(one));
  return list;
}

std::string faults_in_words(std::uint32_t mask) { return mask == 0 ? "none" : robot::fault_names(mask); }

std::string_view fault_help(Fault fault) {
  switch (fault) {
    case Fault::parameters:
      return "the parameters that were saved last cannot be read, and older ones or the defaults are in "
             "force: "
             "load yours with 'astrolabe params import' or 'upload', or keep these with 'params save'";
    case Fault::runaway:
      return "a wheel turned against its voltage: 'astrolabe check-wiring' finds a wrong motor or encoder "
             "polarity";
    case Fault::stop_timeout:
      return "the wheels still turned a second after their set point became zero: look for a slope or a load "
             "that the motors do not hold; 'astrolabe check-wiring' finds a wrong polarity or gear ratio, "
             "'astrolabe tune' weak gains";
    default:
      return robot::fault_help(fault);
  }
}

std::string duration_in_words(std::uint64_t us) {
  const std::uint64_t seconds = us / 1'000'000;
  if (seconds < 60) return fmt::format("{:.1f} s", static_cast<double>(us) * 1e-6);
  if (seconds < 3600) return fmt::format("{} min {:02} s", seconds / 60, seconds % 60);
  return fmt::format("{} h {:02} min {:02} s", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

Json to_json(const Pose2& pose) {
  return {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"theta_rad", pose.theta_rad}};
}

std::string in_words(const Pose2& pose) {
  return fmt::format("x {:8.4f} m   y {:8.4f} m   heading {:9.3f} deg", without_minus_zero(pose.x_m, 4),
                     without_minus_zero(pose.y_m, 4), without_minus_zero(degrees(pose.theta_rad), 3));
}

std::string in_short_words(const Pose2& pose) {
  return fmt::format("x {:7.3f} m  y {:7.3f} m  {:7.1f} deg", without_minus_zero(pose.x_m, 3),
                     without_minus_zero(pose.y_m, 3), without_minus_zero(degrees(pose.theta_rad), 1));
}

}  // namespace astro::commands
