#include <gmock/gmock.h>
#include <stdlib.h>

#include <fstream>

#include "common/base/version.hpp"
#include "tests/support/base/json.hpp"
#include "tests/target/program/emulator.hpp"

// `astrolabe flash` against an emulated robot; a script stands for teensy_loader_cli.
namespace astro::target {
namespace {

using support::astrolabe;
using support::Outcome;
using testing::HasSubstr;

/// An environment variable for as long as the object lives.
class Setting {
 public:
  Setting(const char* name, const std::string& value) : name_(name) {
    const char* old = getenv(name);
    old_ = old != nullptr ? old : "";
    setenv(name, value.c_str(), 1);
  }
  ~Setting() {
    if (old_.empty())
      unsetenv(name_);
    else
      setenv(name_, old_.c_str(), 1);
  }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;

 private:
  const char* name_;
  std::string old_;
};

class Flash : public testing::Test {
 protected:
  Outcome flash(const std::string& image, const std::string& port) const {
    return astrolabe({"flash", image, "--port", port});
  }
  /// A loader of these lines, which come after the way of the real one.
  std::string script(const std::string& lines) const {
    const auto path = emulator_.folder() / "loader.sh";
    std::ofstream(path) << "#!/bin/sh\n" << lines << '\n';
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path.string();
  }
  /// The image with this byte, and the sum of the record that it is in made right.
  std::string patched(std::uint32_t address, std::uint8_t byte) const;
  nlohmann::json ask(std::vector<std::string> words) const {
    words.insert(words.end(), {"--port", emulator_.usb(), "--json"});
    return support::parse_json(astrolabe(words).out);
  }

  EmulatorProgram emulator_;
  Setting loader_{"ASTROLABE_LOADER", ASTROLABE_EMULATED_LOADER};
  Setting robot_{"ASTROLABE_EMULATOR", emulator_.serial()};
};

std::string Flash::patched(std::uint32_t address, std::uint8_t byte) const {
  const auto path = emulator_.folder() / "patched.hex";
  std::ifstream from(kImage);
  std::ofstream to(path);
  char start[16];
  std::snprintf(start, sizeof start, ":10%04X00", address & 0xFFF0U);
  bool done = false;
  for (std::string line; std::getline(from, line);) {
    if (!done && line.starts_with(start)) {
      char digits[3];
      std::snprintf(digits, sizeof digits, "%02X", byte);
      line.replace(9 + 2 * (address & 0xF), 2, digits, 2);
      unsigned sum = 0;
      for (std::size_t i = 1; i + 4 < line.size(); i += 2)
        sum += static_cast<unsigned>(std::stoul(line.substr(i, 2), nullptr, 16));
      std::snprintf(digits, sizeof digits, "%02X", -sum & 0xFF);
      line.replace(9 + 2 * 16, 2, digits, 2);
      done = true;
    }
    to << line << '\n';
  }
  EXPECT_TRUE(done) << "no record at " << address;
  return path.string();
}

constexpr std::uint32_t kVersionInImage = 0x103C;  // patch number is two bytes on

TEST_F(Flash, LoadsTheImageOverUsbAndFindsTheParametersAsTheyWere) {
  ASSERT_EQ(astrolabe({"params", "set", "b=0.2886", "--port", emulator_.usb()}).code, 0);
  ASSERT_EQ(astrolabe({"params", "save", "--port", emulator_.usb()}).code, 0);
  const Outcome outcome = flash(kImage, emulator_.usb());
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("parameters kept"));
  EXPECT_NEAR(ask({"params", "get", "b"})["value"], 0.2886, 1e-9);
}

TEST_F(Flash, LoadsTheImageOfARobotThatIsReachedByItsSerialPort) {
  const Outcome outcome = flash(kImage, emulator_.serial());
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("parameters kept"));
}

TEST_F(Flash, RefusesAnImageWithADamagedRecord) {
  const auto path = (emulator_.folder() / "damaged.hex").string();
  std::ifstream from(kImage);
  std::string text{std::istreambuf_iterator<char>(from), {}};
  text[text.find(":10100000") + 20] ^= 1;
  std::ofstream(path) << text;
  const Outcome outcome = flash(path, emulator_.usb());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("is no Intel HEX record"));
  EXPECT_EQ(ask({"info"})["mode"], "disarmed") << "the robot was left alone";
}

TEST_F(Flash, RefusesAnImageForAnotherBoard) {
  const Outcome outcome = flash(patched(0x1000, 0xD0), emulator_.usb());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("is no image for a Teensy 4.0"));
}

TEST_F(Flash, RefusesWhatIsNoFirmwareOfAstrolabe) {
  const Outcome outcome = flash(patched(0x1030, 'a'), emulator_.usb());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("is not firmware of Astrolabe"));
}

constexpr std::uint32_t kBoardInImage = 0x1040;

TEST_F(Flash, AsksBeforeItFlashesAnImageForAnotherBoardOfAstrolabe) {
  const Setting loader("ASTROLABE_LOADER", script("touch \"$0.ran\""));
  const std::string image = patched(kBoardInImage, 'T');
  for (const bool button : {false, true}) {
    std::vector<std::string> words{"flash", image, "--port", emulator_.usb()};
    if (button) words = {"flash", image, "--button"};
    const Outcome outcome = astrolabe(words);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("for the board 'Teensy40'"), HasSubstr("--force")));
  }
  EXPECT_FALSE(std::filesystem::exists(emulator_.folder() / "loader.sh.ran")) << "nothing was erased";
  EXPECT_EQ(ask({"info"})["mode"], "disarmed") << "the robot was left alone";
}

TEST_F(Flash, AsksBeforeItFlashesWhatIsNotAstrolabesByTheButton) {
  const Setting loader("ASTROLABE_LOADER", script("touch \"$0.ran\""));
  const std::string image = patched(0x1030, 'a');
  const Outcome outcome = astrolabe({"flash", image, "--button"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("is not firmware of Astrolabe"), HasSubstr("--force")));
  EXPECT_FALSE(std::filesystem::exists(emulator_.folder() / "loader.sh.ran"));
  EXPECT_EQ(astrolabe({"flash", image, "--button", "--force"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(emulator_.folder() / "loader.sh.ran"));
}

TEST_F(Flash, RefusesAnImageForALargerFlash) {
  const Outcome outcome = flash(patched(0x52, 0x80), emulator_.usb());  // 8 MB: a Teensy 4.1
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("is no image for a Teensy 4.0"));
}

TEST_F(Flash, RefusesARobotOfAnotherBoard) {
  const support::Simulator simulator;
  const Outcome outcome = flash(kImage, simulator.port());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("is a 'sim'"));
}

TEST_F(Flash, SaysWhichVersionRunsIfItIsNotTheOneOfTheImage) {
  // The image claims a version in its header that its program does not report.
  const Outcome outcome = flash(patched(kVersionInImage + 2, kFirmwareVersion.patch + 1), emulator_.usb());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("the robot runs firmware"));
}

TEST_F(Flash, SaysWhichParameterDidNotSurvive) {
  const Setting loader("ASTROLABE_LOADER",
                       script(std::string(ASTROLABE_EMULATED_LOADER) + " \"$@\"\n" + ASTROLABE_PROGRAM +
                              " params set b=0.2885 --port " + emulator_.serial()));
  const Outcome outcome = flash(kImage, emulator_.usb());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("the parameters did not survive: b was"));
}

TEST_F(Flash, SaysWhatALoaderThatFailsSays) {
  const Setting loader("ASTROLABE_LOADER", script("echo 'error writing to Teensy'; exit 1"));
  const Outcome outcome = flash(kImage, emulator_.usb());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("error writing to Teensy"), HasSubstr("--button")));
}

TEST_F(Flash, SaysThatARobotDoesNotComeBack) {
  const Setting loader("ASTROLABE_LOADER", script("exit 0"));
  const Outcome outcome = flash(kImage, emulator_.usb());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("did not come back: "), HasSubstr(emulator_.usb())));
}

TEST_F(Flash, TellsHowToInstallTheLoader) {
  unsetenv("ASTROLABE_LOADER");
  const Setting nowhere("PATH", emulator_.folder().string());
  const Outcome outcome = flash(kImage, emulator_.usb());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("apt install teensy-loader-cli"));
  EXPECT_EQ(ask({"info"})["mode"], "disarmed") << "the robot was left alone";
}

TEST_F(Flash, TellsWhatToDoWithoutARobot) {
  const Outcome outcome = flash(kImage, (emulator_.folder() / "nothing").string());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("flash with --button"));
}

TEST_F(Flash, DoesNotTakeTheFirmwareFromARobotThatDrives) {
  support::forgive_late_hosts(emulator_.serial());  // a robot whose host is late stops, and may be flashed
  support::Program drive({ASTROLABE_PROGRAM, "drive", "line", "5", "--port", emulator_.serial()});
  ASSERT_TRUE(support::eventually([&] { return ask({"info"})["mode"] != "disarmed"; }));
  const Outcome outcome = flash(kImage, emulator_.usb());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("'astrolabe stop' disarms it"));
}

}  // namespace
}  // namespace astro::target
