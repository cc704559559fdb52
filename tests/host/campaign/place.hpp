#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/programs/program.hpp"
#include "tests/support/programs/traced_program.hpp"

/// Where a command is disturbed, and what must be true of it afterwards.
namespace astro::campaign {

using Words = std::vector<std::string>;
using ParameterSet = std::map<std::string, std::string>;  // name and value, as the robot reports them

/// A folder, and a robot with nothing but its defaults, except that it waits for its host for 2 s: traced programs are slow on a
/// busy machine. Less than the 3 s after which outputs are off.
class Place {
 public:
  Place() { support::forgive_late_hosts(port(), std::chrono::seconds(2)); }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string folder() const { return folder_.path().string(); }
  std::string port() const { return simulator_.port(); }

  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;  // "" if it is not there

  ParameterSet parameters() const;
  /// "disarmed" or "fault" within seconds, whatever had become of the program that drove it: else the test
  /// fails.
  void expect_outputs_off() const;

 private:
  test::TemporaryFolder folder_;
  support::Simulator simulator_;
};

/// Each recording, calibration, page and journal below `folder` is whole; a recording that bears the name of
/// an unfinished one reads up to its last chunk.
void expect_whole_files(const std::string& folder);

/// Runs a program to its end.
support::Outcome run(const Words& command);

/// One command that changes something.
struct Scenario {
  std::string name;
  Words command(const Place& place) const;

  void (*prepare)(const Place&);     // what is there before it: the old state
  Words (*arguments)(const Place&);  // of `astrolabe`, without --port
  bool needs_robot = true;           // gets --port
  const char* replaces = nullptr;    // the file that holds the old content or the new one, both fixed
  enum class Robot { keeps, old_or_new, calibrated, tuned } robot = Robot::keeps;
  bool repeats = true;  // the same command once more does the work
};

/// All of them; in kill_test.cpp's order.
const std::vector<Scenario>& scenarios();
const Scenario& scenario(const std::string& name);

/// What an undisturbed run leaves behind.
struct Reference {
  std::vector<std::string> calls;
  std::string old_file, new_file;
  ParameterSet old_parameters, new_parameters;
};
const Reference& reference(const Scenario& scenario);

/// Nothing is lost and nothing is mixed, whether the command ended well, failed or was killed.
void expect_old_or_new(const Scenario& scenario, const Place& place, bool ended_well);

/// The same command, undisturbed, now does what was asked for.
void expect_repeatable(const Scenario& scenario, const Place& place);

/// `count` of the numbers 1 ... `last`, spread over all of them, each drawn from its own part; all if there
/// are fewer.
std::vector<std::size_t> spread(std::size_t count, std::size_t last, unsigned seed);

}  // namespace astro::campaign
