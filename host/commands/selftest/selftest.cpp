#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/interrupted.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/selftest/commands.hpp"
#include "host/commands/selftest/demo_robot.hpp"
#include "host/commands/selftest/machine.hpp"
#include "host/commands/selftest/own_command.hpp"
#include "host/commands/shared/robot_view.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;
using nlohmann::json;

/// A new folder for this test alone, which goes with everything in it.
class TestFolder {
 public:
  TestFolder() {
    std::string name = (fs::temp_directory_path() / "astrolabe-selftest-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw Error(fmt::format("no folder can be made in '{}': name another with TMPDIR",
                              fs::temp_directory_path().string()));
    path_ = name;
  }
  ~TestFolder() {
    std::error_code stays;
    fs::remove_all(path_, stays);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

std::string printed(Words words) { return OwnCommand(words).output(); }

json json_of(Words words) {
  words.emplace_back("--json");
  return json::parse(printed(std::move(words)));
}

/// The checks, each of which returns what it found or throws astro::Error with what is wrong. A check that needs the work of
/// one that failed fails with the same reason.
class SelfTest {
 public:
  /// A simulated robot is calibrated, and the factors are those that it was built with.
  std::string calibration() {
    fast_.emplace(port(), Words{"--fast"});
    driven_ = json_of({"umbmark", "--port", port(), "--truth", "sim", "--runs", "3", "--side", "2",
                       "--no-extras", "--out", folder_ / "experiment", "--yes"});
    const json& found = driven_["parameters"]["new"];
    const json& errors = driven_["parameters"]["standard_errors"];
    const double E_d = found["c_R"].get<double>() / found["c_L"].get<double>(), b_m = found["b_m"];
    // Errors that add up at most; four of them leave one robot in ten thousand.
    constexpr double kMostErrors = 4;
    const double Ed_error = errors["c_R"].get<double>() + errors["c_L"].get<double>(),
                 b_error_m = errors["b_m"];
    const std::string what = fmt::format("E_d {:.5f} (true {:.5f}), b {:.2f} mm (true {:.2f} mm)", E_d,
                                         kTrueEd, 1e3 * b_m, 1e3 * kTrueWheelbase_m);
    if (std::abs(E_d - kTrueEd) > kMostErrors * Ed_error ||
        std::abs(b_m - kTrueWheelbase_m) > kMostErrors * b_error_m)
      throw Error("the factors are off by more than four standard errors: " + what);
    return what;
  }

  /// What the robot holds after the upload is what was found.
  std::string upload() {
    require_driven();
    const double held_m = json_of({"params", "get", "b", "--port", port()})["value"];
    const double found_m = driven_["parameters"]["new"]["b_m"];
    if (std::abs(held_m - found_m) > 1e-9)  // whole nanometres
      throw Error(fmt::format("the robot holds b = {} m and {} m was loaded", held_m, found_m));
    return fmt::format("the robot holds b = {:.2f} mm, read back over a pseudo terminal", 1e3 * held_m);
  }

  std::string report() {
    require_driven();
    const fs::path file = driven_["report"].get<std::string>();
    // Every report carries its plotting library inside itself.
    if (fs::file_size(file) < 1'000'000) throw Error("the report lacks its figures");
    return fmt::format("{:.1f} MB, with its figures inside", 1e-6 * static_cast<double>(fs::file_size(file)));
  }

  /// The same drives give the same factors as recordings, and as bags of ROS 2.
  std::string bags() {
    require_driven();
    const std::string before = folder_ / "experiment/before", bags = folder_ / "bags";
    const json own = json_of({"calibrate", "runs", before});
    printed({"export", before, "--rosbag", bags});
    Words words{"calibrate", "bag"};
    for (const auto& entry : fs::recursive_directory_iterator(bags))
      if (entry.path().filename() == "metadata.yaml") words.push_back(entry.path().parent_path().string());
    const json theirs = json_of(words);
    return agree(own, theirs, fmt::format("{} drives as recordings and as bags", words.size() - 2));
  }

  /// A recording as text, and what is in it.
  std::string tables() {
    require_driven();
    const std::string csv = folder_ / "csv";
    printed({"export", folder_ / "experiment/before/square-cw-1.mcap", "--csv", csv});
    const json wheels = json_of({"inspect", csv + "/odometry.csv"}),
               poses = json_of({"inspect", csv + "/truth.csv"});
    if (poses.empty() || wheels.empty()) throw Error("a table that was written is not understood");
    return "a drive written and understood";
  }

  /// Poses of a simulated tracker arrive over TCP.
  std::string tracker() { return watched(slow().line_with("vrpn://")); }

  /// The same in ROS 2.
  std::string dds() { return watched(slow().line_with("ros2:/")); }

  std::string viewers() {
    slow();
    OwnCommand serve({"serve", "--foxglove", "--listen", "0", "--port", folder_ / "slow.pty"});
    const std::string line = serve.line_with("ws://");
    serve.end();
    return line.substr(line.find("ws://"), line.find_first_of(" )", line.find("ws://")) - line.find("ws://"));
  }

  std::string tags() {
    printed({"tags", "--pdf", folder_ / "tags.pdf"});
    return fmt::format("{} kB of PDF", fs::file_size(folder_ / "tags.pdf") / 1000);
  }

 private:
  std::string port() const { return folder_ / "robot.pty"; }

  void require_driven() const {
    if (driven_.is_null()) throw Error("there are no drives, because the calibration failed");
  }

  /// A simulated robot in real time, which trackers and viewers go by.
  DemoRobot& slow() {
    if (!slow_)
      slow_.emplace(folder_ / "slow.pty",
                    Words{"--vrpn-port", "0", "--ros2-topic", fmt::format("/selftest_{}/pose", getpid())});
    return *slow_;
  }

  /// `line`: what the simulator says of where its pose is.
  static std::string watched(const std::string& line) {
    const std::string url = line.substr(line.rfind(' ') + 1);
    OwnCommand watch({"truth", "watch", url, "--json"});
    const json first = json::parse(watch.first_line());  // it says nothing there until something has come
    watch.end();
    return fmt::format("{} poses in the first second, from {}", first["poses"].get<int>(), url);
  }

  /// A bag has angles of wheels where a recording has counts, so the last digits differ.
  static std::string agree(const json& own, const json& theirs, const std::string& what) {
    constexpr double kShareOfError = 0.25;
    for (const char* key : {"c_R", "c_L", "b_m"})
      if (std::abs(own[key].get<double>() - theirs[key].get<double>()) >
          kShareOfError * own["standard_errors"][key].get<double>())
        throw Error(fmt::format("{} give different factors: {} is {} and {}", what, key, own[key].dump(),
                                theirs[key].dump()));
    return what + " give the same factors";
  }

  TestFolder folder_;
  std::optional<DemoRobot> fast_, slow_;
  json driven_;
};

struct Check {
  const char* name;
  std::string (SelfTest::*run)();
};
constexpr Check kChecks[] = {{"calibration", &SelfTest::calibration},
                             {"upload", &SelfTest::upload},
                             {"report", &SelfTest::report},
                             {"bags", &SelfTest::bags},
                             {"tables", &SelfTest::tables},
                             {"tracker", &SelfTest::tracker},
                             {"ROS 2", &SelfTest::dds},
                             {"viewers", &SelfTest::viewers},
                             {"printed tags", &SelfTest::tags}};

Finding carry_out(SelfTest& test, const Check& check) {
  try {
    return {Finding::Kind::works, check.name, (test.*check.run)()};
  } catch (const Interrupted&) {
    throw;
  } catch (const Error& error) {
    return {Finding::Kind::fails, check.name, in_words(error)};
  } catch (const json::exception& error) {
    return {Finding::Kind::fails, check.name, std::string("an answer is not understood: ") + error.what()};
  }
}

void show(const Finding& finding) {
  const char* word = finding.kind == Finding::Kind::works   ? "PASS"
                     : finding.kind == Finding::Kind::fails ? "FAIL"
                                                            : "----";
  print(fmt::format("{}  {:<17}  {}", word, finding.what, finding.details));
}

void run() {
  const auto begun = std::chrono::steady_clock::now();
  int failed = 0, passed = 0;
  const auto count = [&](const Finding& finding) {
    show(finding);
    failed += finding.kind == Finding::Kind::fails;
    passed += finding.kind == Finding::Kind::works;
  };
  SelfTest test;
  for (const Check& check : kChecks) count(carry_out(test, check));
  for (const Finding& finding : look_at_machine()) count(finding);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun;
  if (failed > 0) throw Error(fmt::format("{} of {} checks failed", failed, failed + passed));
  print(fmt::format("PASS: all {} checks, in {:.0f} s (----: not here, and only needed for what is said)",
                    passed, taken.count()));
}

}  // namespace

void add_selftest(console::Command app) {
  const console::Command command = app.add_subcommand(
      "selftest", "check on this computer, in some seconds, that the program does its work");
  command.footer(
      "A simulated robot is calibrated, loaded and shown over pseudo terminals and loopback; nothing is sent "
      "to\n"
      "other computers, and no port of a real robot is opened. Exit codes: 0 all checks passed; 1 one "
      "failed.\n"
      "Examples:\n  astrolabe selftest");
  command.callback([] { run(); });
}

}  // namespace astro::commands
