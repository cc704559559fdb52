#include "host/commands/selftest/demo_robot.hpp"

#include <fmt/format.h>

#include "host/base/error.hpp"

namespace astro::commands {
namespace {

std::vector<std::string> command(const std::filesystem::path& port, const std::vector<std::string>& options) {
  std::vector<std::string> words{"sim",
                                 "--pty",
                                 port.string(),
                                 "--true-ed",
                                 fmt::format("{}", kTrueEd),
                                 "--true-wheelbase",
                                 fmt::format("{}", kTrueWheelbase_m),
                                 "--slip",
                                 "2.645e-6"};
  words.insert(words.end(), options.begin(), options.end());
  return words;
}

}  // namespace

DemoRobot::DemoRobot(const std::filesystem::path& port, const std::vector<std::string>& options)
    : process_(command(port, options)) {
  process_.line_with("next: ");  // its last line before it serves
}

DemoRobot::~DemoRobot() {
  try {
    process_.end();         // it takes its port away
  } catch (const Error&) {  // it is killed
  }
}

}  // namespace astro::commands
