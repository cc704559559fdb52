#include <fcntl.h>
#include <gmock/gmock.h>
#include <termios.h>
#include <unistd.h>

#include <fstream>

#include "tests/support/base/json.hpp"
#include "tests/support/base/temporary_folder.hpp"
#include "tests/target/program/emulator.hpp"

// What a person without a Teensy does with the image: the ordinary commands, at either port.
namespace astro::target {
namespace {

using nlohmann::json;
using support::astrolabe;
using support::Outcome;
using testing::HasSubstr;

class EmulatedRobotAt : public testing::TestWithParam<const char*> {
 protected:
  std::string port() const { return GetParam() == std::string("Usb") ? emulator_.usb() : emulator_.serial(); }
  /// Runs a command that must succeed.
  Outcome run(std::vector<std::string> words) const {
    words.insert(words.end(), {"--port", port()});
    Outcome outcome = astrolabe(words);
    EXPECT_EQ(outcome.code, 0) << words[0] << ": " << outcome.err;
    return outcome;
  }
  json ask(std::vector<std::string> words) const {
    words.emplace_back("--json");
    return support::parse_json(run(words).out);
  }

  EmulatorProgram emulator_;
};

INSTANTIATE_TEST_SUITE_P(Port, EmulatedRobotAt, testing::Values("Usb", "Serial"),
                         [](const auto& at) { return std::string(at.param); });

TEST_P(EmulatedRobotAt, TellsWhoItIs) {
  const json info = ask({"info"});
  EXPECT_EQ(info["board"], "teensy40");
  EXPECT_EQ(info["mode"], "disarmed");
  EXPECT_EQ(info["faults"], json::array());
  EXPECT_EQ(info["tick_overruns"], 0);
}

TEST_P(EmulatedRobotAt, SetsAndKeepsAParameter) {
  run({"params", "set", "b=0.2886"});
  run({"params", "save"});
  run({"reboot"});
  EXPECT_NEAR(ask({"params", "get", "b"})["value"], 0.2886, 1e-9);  // b is kept in nanometres
}

TEST_P(EmulatedRobotAt, DrivesALine) {
  const json moved = ask({"drive", "line", "0.5"});
  EXPECT_NEAR(moved["moved"]["x_m"], 0.5,
              0.003);  // the true wheels differ by 0.4 %, which odometry cannot see
  EXPECT_EQ(ask({"info"})["mode"], "disarmed");
}

TEST_P(EmulatedRobotAt, TakesAnUploadAndReadsItBack) {
  const std::string file = (emulator_.folder() / "calib.toml").string();
  std::ofstream(file) << "[parameters]\nc_R = 1.002\nc_L = 0.998\nb = 0.289\n";
  const json uploaded = ask({"upload", file, "--yes"});
  EXPECT_EQ(uploaded["active"], "new");
  EXPECT_NEAR(ask({"params", "get", "c_R"})["value"], 1.002, 1e-9);  // in steps of 2^-30
}

TEST(EmulatorProgram, ShowsOneRobotAtBothPorts) {
  const EmulatorProgram emulator;
  EXPECT_EQ(astrolabe({"params", "set", "b=0.2886", "--port", emulator.usb()}).code, 0);
  const Outcome other = astrolabe({"params", "get", "b", "--port", emulator.serial(), "--json"});
  EXPECT_NEAR(support::parse_json(other.out)["value"], 0.2886, 1e-9);
}

TEST(EmulatorProgram, IsLeftAloneByASecondOneThatIsRefused) {
  const EmulatorProgram emulator;
  for (const std::string& taken : {emulator.serial(), emulator.usb()}) {
    support::Program second({ASTROLABE_EMULATOR_PROGRAM, kImage, "--pty", taken});
    EXPECT_EQ(second.wait(), 1);
    EXPECT_THAT(second.err(), HasSubstr("in use by another simulator"));
    EXPECT_TRUE(std::filesystem::exists(taken + ".mocap")) << "its cameras, too";
  }
  EXPECT_EQ(astrolabe({"info", "--port", emulator.usb()}).code, 0);
}

TEST(EmulatorProgram, DrivesForOneProgramAtATime) {
  const EmulatorProgram emulator;
  // Not about a host that falls silent, which the first would do where the machine is busy; nor about a drive that is over before
  // the second has asked: with --fast an idle machine drives ten seconds in one.
  ASSERT_EQ(astrolabe({"params", "set", "command_timeout=0", "--yes", "--port", emulator.usb()}).code, 0);
  support::Program first({ASTROLABE_PROGRAM, "drive", "line", "900", "--port", emulator.serial()});
  const auto mode = [&] {
    const Outcome info = astrolabe({"info", "--port", emulator.usb(), "--json"});
    return info.code == 0 ? support::parse_json(info.out)["mode"].get<std::string>() : info.err;
  };
  ASSERT_TRUE(support::eventually([&] { return mode() == "segment"; }));
  const Outcome second = astrolabe({"drive", "line", "0.3", "--port", emulator.usb()});
  EXPECT_EQ(second.code, 1);
  EXPECT_THAT(second.err, HasSubstr("is driving for another program"));
  EXPECT_EQ(mode(), "segment") << "and goes on driving for the first";
}

/// `astrolabe stop` at one port while `astrolabe drive` at another, or the same, repeats its velocity.
void expect_that_a_stop_ends_a_velocity(const std::string& driver, const std::string& stopper) {
  const EmulatorProgram emulator;
  const auto port = [&](const std::string& name) {
    return name == "usb" ? emulator.usb() : emulator.serial();
  };
  // Not about a host that falls silent, which the driver would do where the machine is busy.
  ASSERT_EQ(astrolabe({"params", "set", "command_timeout=0", "--yes", "--port", emulator.usb()}).code, 0);
  support::Program drive(
      {ASTROLABE_PROGRAM, "drive", "velocity", "0.5", "0", "--for", "80000", "--port", port(driver)});
  const auto mode = [&] {
    const Outcome info = astrolabe({"info", "--port", emulator.usb(), "--json"});
    return info.code == 0 ? support::parse_json(info.out)["mode"].get<std::string>() : info.err;
  };
  ASSERT_TRUE(support::eventually([&] { return mode() == "velocity"; }));
  const Outcome stop = astrolabe({"stop", "--port", port(stopper)});
  EXPECT_EQ(stop.code, 0) << stop.err;
  EXPECT_THAT(stop.err, HasSubstr("the robot is at rest and disarmed"));
  EXPECT_EQ(drive.wait(), 1);
  EXPECT_THAT(drive.err(), HasSubstr("stopped the robot"));
  EXPECT_EQ(mode(), "disarmed");
}

TEST(EmulatorProgram, AStopThroughTheOtherCableEndsADriveByVelocity) {
  expect_that_a_stop_ends_a_velocity("serial", "usb");
  expect_that_a_stop_ends_a_velocity("usb", "serial");
}

TEST(EmulatorProgram, AStopThroughTheSameCableEndsADriveByVelocity) {
  expect_that_a_stop_ends_a_velocity("usb", "usb");
}

// Whoever has to stop a robot does not look up the names of its ports.
TEST(EmulatorProgram, AStopWithoutAPortFindsTheOneRobotAtItsTwoCables) {
  namespace fs = std::filesystem;
  const EmulatorProgram emulator;
  const fs::path here = emulator.folder() / "here", folder = here / ("astrolabe-" + std::to_string(getuid()));
  fs::create_directories(folder);
  fs::permissions(folder, fs::perms::owner_all);
  fs::create_symlink(emulator.usb(), folder / "usb.pty");
  fs::create_symlink(emulator.serial(), folder / "serial.pty");
  ASSERT_EQ(astrolabe({"params", "set", "command_timeout=0", "--yes", "--port", emulator.usb()}).code, 0);
  support::Program drive(
      {ASTROLABE_PROGRAM, "drive", "velocity", "0.5", "0", "--for", "80000", "--port", emulator.serial()});
  const auto mode = [&] {
    const Outcome info = astrolabe({"info", "--port", emulator.usb(), "--json"});
    return info.code == 0 ? support::parse_json(info.out)["mode"].get<std::string>() : info.err;
  };
  ASSERT_TRUE(support::eventually([&] { return mode() == "velocity"; }));
  support::Program stop({"/usr/bin/env", "XDG_RUNTIME_DIR=" + here.string(), ASTROLABE_PROGRAM, "stop"});
  EXPECT_EQ(stop.wait(), 0) << stop.err();
  EXPECT_THAT(stop.err(), HasSubstr("the robot is at rest and disarmed"));
  EXPECT_EQ(drive.wait(), 1);
  EXPECT_EQ(mode(), "disarmed");
}

TEST(EmulatorProgram, PausedAndResumedFromTheOtherPortADriveEndsWhereItShould) {
  const EmulatorProgram emulator;
  // Longer than a busy machine lets the driver wait, shorter than what is left of the drive after the pause.
  ASSERT_EQ(astrolabe({"params", "set", "command_timeout=3000", "--yes", "--port", emulator.usb()}).code, 0);
  support::Program drive(
      {ASTROLABE_PROGRAM, "drive", "line", "8", "--speed", "0.2", "--port", emulator.serial(), "--json"});
  const auto mode = [&] {
    const Outcome info = astrolabe({"info", "--port", emulator.usb(), "--json"});
    return info.code == 0 ? support::parse_json(info.out)["mode"].get<std::string>() : info.err;
  };
  ASSERT_TRUE(support::eventually([&] { return mode() == "segment"; }));
  const Outcome pause = astrolabe({"pause", "--port", emulator.usb()});
  EXPECT_EQ(pause.code, 0) << pause.err;
  EXPECT_EQ(mode(), "paused");
  const Outcome resume = astrolabe({"resume", "--port", emulator.usb()});
  EXPECT_EQ(resume.code, 0) << resume.err;
  EXPECT_EQ(drive.wait(), 0) << drive.err();
  const json moved = support::parse_json(drive.out());
  EXPECT_NEAR(moved["moved"]["x_m"], 8, 0.05);  // the true wheels differ by 0.4 %
}

TEST(EmulatorProgram, EntersTheBootLoaderAt134BaudAndTheUsbPortGoes) {
  EmulatorProgram emulator;
  const int port = open(emulator.usb().c_str(), O_RDWR | O_NOCTTY);
  ASSERT_GE(port, 0);
  termios settings{};
  tcgetattr(port, &settings);
  cfsetspeed(&settings, B134);
  tcsetattr(port, TCSANOW, &settings);
  EXPECT_TRUE(support::eventually([&] { return std::filesystem::is_fifo(emulator.halfkay()); }));
  EXPECT_TRUE(support::eventually([&] { return !std::filesystem::exists(emulator.usb()); }));
  close(port);
}

TEST(EmulatorProgram, LeavesNothingBehind) {
  EmulatorProgram emulator;
  emulator.program().send(SIGINT);
  EXPECT_EQ(emulator.program().wait(), 0);
  EXPECT_TRUE(std::filesystem::is_empty(emulator.folder()));
}

TEST(EmulatorProgram, SaysWhatIsWrongInOneSentence) {
  const auto complaint = [](const std::vector<std::string>& words) {
    std::vector<std::string> command{ASTROLABE_EMULATOR_PROGRAM};
    command.insert(command.end(), words.begin(), words.end());
    support::Program program(command);
    EXPECT_NE(program.wait(), 0);
    const std::string text = program.err();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
    EXPECT_TRUE(text.starts_with("astrolabe-emulator: ")) << "it complains under its own name: " << text;
    return text;
  };
  EXPECT_THAT(complaint({}), HasSubstr("firmware"));
  EXPECT_THAT(complaint({"/nonexistent.hex"}),
              HasSubstr("cannot read '/nonexistent.hex': build one with './dev firmware'"));
  const test::TemporaryFolder folder;
  const std::string text = folder.path() / "notes.txt";
  std::ofstream(text) << "no image\n";
  EXPECT_THAT(complaint({text}), HasSubstr("no Intel HEX record"));
  EXPECT_THAT(complaint({kImage, "--usb-pyt", "x"}), HasSubstr("astrolabe-emulator"));
  EXPECT_THAT(complaint({kImage, "--pty", "/nonexistent/x"}),
              HasSubstr("--pty: there is no folder '/nonexistent' for '/nonexistent/x'"));
  EXPECT_THAT(complaint({kImage, "--pty", "/tmp/x", "--usb-pty", "/tmp/../tmp/x"}),
              HasSubstr("--usb-pty must be another path than --pty"));
}

}  // namespace
}  // namespace astro::target
