#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"

namespace astro {
namespace {

using nlohmann::json;
using support::Outcome;
using testing::AllOf;
using testing::HasSubstr;
using Words = std::vector<std::string>;

class Params : public testing::Test {
 protected:
  Outcome params(Words words) const {
    words.insert(words.begin(), "params");
    words.insert(words.end(), {"--port", simulator_.port()});
    return support::astrolabe(words);
  }
  std::string get(const std::string& name) const {
    const Outcome outcome = params({"get", name});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.out;
  }
  std::string file() const { return (simulator_.folder() / "robot.toml").string(); }

  support::Simulator simulator_;
};

TEST_F(Params, AnUnrelatedChangeDoesNotKeepWhatWasOnlyTried) {
  const std::string before = get("kp");
  ASSERT_EQ(params({"set", "kp=44", "--try", "--yes"}).code, 0);
  ASSERT_EQ(params({"set", "b=0.291", "--yes"}).code, 0);
  EXPECT_EQ(get("kp"), "44\n") << "in force until the restart";
  ASSERT_EQ(support::astrolabe({"reboot", "--port", simulator_.port()}).code, 0);
  EXPECT_EQ(get("kp"), before);
  EXPECT_EQ(get("b"), "0.291\n");
  for (const Words& keep : {Words{"save"}, Words{"set", "kp=44", "--yes"}}) {
    ASSERT_EQ(params({"set", "kp=44", "--try", "--yes"}).code, 0);
    ASSERT_EQ(params(keep).code, 0);
    ASSERT_EQ(support::astrolabe({"reboot", "--port", simulator_.port()}).code, 0);
    EXPECT_EQ(get("kp"), "44\n") << keep.front();
    ASSERT_EQ(params({"defaults", "--yes"}).code, 0);
  }
}

TEST_F(Params, ATimeOutOfZeroIsWarnedOf) {
  EXPECT_THAT(params({"set", "command_timeout=0", "--yes"}).err,
              HasSubstr("keeps driving if its host disappears"));
}

TEST_F(Params, ListShowsEveryRowWithUnitLimitsAndMeaning) {
  const Outcome outcome = params({"list"});
  ASSERT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("Wheelbase: distance between the contact points"),
                                 HasSubstr("0.05 to 2"), HasSubstr("robot_name")));
  const json rows = support::parse_json(params({"list", "--json"}).out);
  EXPECT_EQ(rows.size(),
            static_cast<std::size_t>(std::count(outcome.out.begin(), outcome.out.end(), '\n')) - 1);
}

TEST_F(Params, ListMarksWhatIsNotAtItsDefault) {
  ASSERT_EQ(params({"set", "b=0.2886"}).code, 0);
  std::istringstream lines(params({"list"}).out);
  std::string line;
  while (std::getline(lines, line)) {
    EXPECT_EQ(line.starts_with("*"), line.find(" 0.2886 ") != std::string::npos) << line;
  }
}

TEST_F(Params, SetComesInForceAtOnce) {
  ASSERT_EQ(params({"set", "b=0.2886"}).code, 0);
  EXPECT_EQ(get("b"), "0.2886\n");
  ASSERT_EQ(params({"set", "robot_name=Number 5"}).code, 0);
  EXPECT_EQ(get("robot_name"), "Number 5\n");
}

TEST_F(Params, GetPrintsTheFewestDigitsThatGiveTheValueAgain) {
  EXPECT_EQ(get("kV_left"), "12.2\n");  // stored as 12.1999969482421875
  EXPECT_THAT(params({"set", "kV_left=12.2"}).err, HasSubstr("already"));
  EXPECT_EQ(params({"get", "b", "c_R"}).out, "b=0.29\nc_R=1\n");
}

TEST_F(Params, SeveralValuesNeedAnAnswer) {
  const Outcome asked = params({"set", "c_R=1.001", "c_L=0.999"});
  EXPECT_EQ(asked.code, 1);
  EXPECT_THAT(asked.err, AllOf(HasSubstr("c_R"), HasSubstr("1.001"), HasSubstr("--yes")));
  EXPECT_EQ(get("c_R"), "1\n");
  EXPECT_EQ(params({"set", "c_R=1.001", "c_L=0.999", "--yes"}).code, 0);
  EXPECT_EQ(get("c_R"), "1.001\n");
  EXPECT_EQ(get("c_L"), "0.999\n");
}

TEST_F(Params, ABadOneOfSeveralChangesNothing) {
  struct Assignment {
    std::string bad, named;
  };
  for (const Assignment& c :
       {Assignment{"c_L=1.7", "c_L = 1.7 is out of range: 0.5 to 1.5"}, Assignment{"c_L=much", "'much'"},
        Assignment{"c_L=nan", "c_L"}, Assignment{"c_X=1", "c_X"}, Assignment{"c_L=", "c_L"},
        Assignment{"robot_name=", "robot_name"}, Assignment{"gear_numerator=1.5", "gear_numerator"}}) {
    const Outcome outcome = params({"set", "c_R=1.001", c.bad, "--yes"});
    EXPECT_EQ(outcome.code, 1) << c.bad;
    EXPECT_THAT(outcome.err, HasSubstr(c.named));
    EXPECT_EQ(get("c_R"), "1\n") << c.bad;
  }
}

TEST_F(Params, WordsThatAssignNothingAreWrongUsage) {
  EXPECT_EQ(params({"set", "b"}).code, 2);
  EXPECT_EQ(params({"set", "=1"}).code, 2);
  EXPECT_EQ(params({"set", "b=0.28", "b=0.29"}).code, 2);
}

TEST_F(Params, TriedValuesAreKeptBySave) {
  ASSERT_EQ(params({"set", "b=0.28", "--try"}).code, 0);
  EXPECT_EQ(get("b"), "0.28\n");
  EXPECT_THAT(params({"save"}).err, HasSubstr("tried ones too"));
  EXPECT_EQ(get("b"), "0.28\n");
}

TEST_F(Params, ExportAndImportBringEveryValueBack) {
  ASSERT_EQ(params({"set", "c_R=1.00208", "b=0.288611", "kp=37.5", "robot_name=A \"B\"", "--yes"}).code, 0);
  const json before = support::parse_json(params({"list", "--json"}).out);
  const Outcome exported = params({"export", file()});
  ASSERT_EQ(exported.code, 0);
  EXPECT_THAT(exported.err, HasSubstr("tried ones too"));
  ASSERT_EQ(params({"defaults", "--yes"}).code, 0);
  EXPECT_EQ(get("b"), "0.29\n");
  EXPECT_EQ(get("robot_name"), "ASTRO\n");
  const Outcome loaded = params({"import", file(), "--yes", "--json"});
  ASSERT_EQ(loaded.code, 0) << loaded.err;
  EXPECT_EQ(support::parse_json(loaded.out)["changed"].size(), 4U);
  EXPECT_EQ(support::parse_json(params({"list", "--json"}).out), before);
}

TEST_F(Params, ImportOfWhatIsNoParameterFileNamesTheFile) {
  EXPECT_THAT(params({"import", "/no/such.toml"}).err, HasSubstr("/no/such.toml"));
  std::ofstream(file()) << "[parameters]\nb = \n";
  const Outcome outcome = params({"import", file()});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr(file()), HasSubstr("line 2")));
}

TEST_F(Params, AValueFarFromThePresentOneNeedsAnAnswer) {
  struct Far {
    std::string assignment, before, said;
  };
  for (const Far& c :
       {Far{"kp=600", "60\n", "kp would go from 60 Vs/m to 600 Vs/m, 10 times as much"},
        Far{"b=0.35", "0.29\n", "b would go from 0.29 m to 0.35 m, +20.7 %"},
        Far{"motor_polarity_left=-1", "1\n", "another sign"},
        Far{"command_timeout=0", "200\n", "command_timeout would go from 200 ms to 0 ms"},
        Far{"speed_limit=0.075", "0.75\n", "speed_limit would go from 0.75 m/s to 0.075 m/s, 1/10 of it"},
        Far{"gear_numerator=4380", "438\n", "10 times as much"}}) {
    const std::string name = c.assignment.substr(0, c.assignment.find('='));
    for (const Words& how : {Words{}, Words{"--try"}}) {
      Words words{"set", c.assignment};
      words.insert(words.end(), how.begin(), how.end());
      const Outcome asked = params(words);
      EXPECT_EQ(asked.code, 1) << c.assignment;
      EXPECT_THAT(asked.err, AllOf(HasSubstr(c.said), HasSubstr("--yes")));
      EXPECT_EQ(get(name), c.before);
    }
  }
  EXPECT_EQ(params({"set", "kp=600", "--yes"}).code, 0);
  EXPECT_EQ(get("kp"), "600\n");
}

TEST_F(Params, AValueNearThePresentOneIsNotAskedAbout) {
  for (const char* assignment : {"kp=100", "b=0.3", "wheel_diameter=0.08", "speed_limit=1", "over_speed=2"})
    EXPECT_EQ(params({"set", assignment}).code, 0) << assignment;
}

TEST_F(Params, ARefusedSetNamesTheRuleTheLimitAndItsUnit) {
  struct Refused {
    Words assignments;
    std::string said;
  };
  for (const Refused& c :
       {Refused{{"over_speed=0.7"},
                "over_speed = 0.7 m/s: it has to be above speed_limit = "
                "0.75 m/s, or full speed would be a fault"},
        Refused{{"speed_limit=1.3"}, "above speed_limit = 1.3 m/s"},
        Refused{{"motor_polarity_right=0"}, "it has to be +1 or -1"},
        Refused{{"battery_high=10000"},
                "it has to be above battery_low = 10500 mV unless one of the two is 0"},
        Refused{{"counts_per_motor_rev=1", "gear_numerator=1", "wheel_diameter=1"},
                "one count moves a wheel by 31.4 m, and that has to be from 1e-09 m to 0.125 m"},
        Refused{{"counts_per_motor_rev=1", "gear_numerator=30", "b=0.05"},
                "one count turns the robot by 86.4 degrees, and has to turn it by less than 22.5 degrees"},
        Refused{
            {"counts_per_motor_rev=1", "gear_numerator=30", "e=-0.2", "b=0.05"},
            "one count turns the robot by 108 degrees, and has to turn it by less than 22.5 degrees; that "
            "follows from b = 0.05 m, e = -0.2"},
        Refused{{"robot_name=caf\xc3\xa9"}, "1 to 24 characters of printable ASCII"},
        Refused{{"speed_limit=20"}, "speed_limit = 20 m/s is out of range: 0.01 m/s to 10 m/s"}}) {
    Words words{"set"};
    words.insert(words.end(), c.assignments.begin(), c.assignments.end());
    words.push_back("--yes");
    const Outcome outcome = params(words);
    EXPECT_EQ(outcome.code, 1) << c.said;
    EXPECT_THAT(outcome.err, HasSubstr(c.said));
  }
}

TEST_F(Params, ImportObeysTheChecksOfUpload) {
  struct Refused {
    std::string text, said;
  };
  const std::string factors = "c_R = 1.001\nc_L = 0.999\nb = 0.2886\n";
  for (const Refused& c :
       {Refused{"[parameters]\nb = 0.33\n", "b would change by +13.8 %"},
        Refused{"[parameters]\nc_R = 1.001\n[calibration]\nmethod = \"umbmark\"\n", "has no c_L"},
        Refused{"[parameters]\n" + factors + "[carried]\nc_R = 1.01\n", "driven with c_R = 1.01"},
        Refused{
            "[parameters]\n" + factors + "[nominal]\nwheel_diameter = 0.08\ncounts_per_wheel_turn = 2803.2\n",
            "refers to a wheel of 0.08 m"}}) {
    std::ofstream(file()) << c.text;
    const Outcome imported = params({"import", file(), "--yes"});
    EXPECT_EQ(imported.code, 1) << c.text;
    EXPECT_THAT(imported.err, AllOf(HasSubstr(c.said), HasSubstr("--force")));
    EXPECT_EQ(params({"get", "c_R", "c_L", "b"}).out, "c_R=1\nc_L=1\nb=0.29\n");
    const Outcome uploaded = support::astrolabe({"upload", file(), "--yes", "--port", simulator_.port()});
    EXPECT_EQ(uploaded.err, imported.err) << "both take the same way";
  }
  std::ofstream(file()) << "[parameters]\nb = 0.33\n[robot]\nname = \"ARES\"\nid = \"12\"\n";
  const Outcome forced = params({"import", file(), "--yes", "--force"});
  EXPECT_EQ(forced.code, 0) << forced.err;
  EXPECT_THAT(forced.err, HasSubstr("warning: the calibration is of robot ARES"));
  EXPECT_EQ(get("b"), "0.33\n");
}

TEST_F(Params, JsonAnswersAreTheOnlyThingOnStdout) {
  const Outcome outcome = params({"set", "b=0.2886", "--json"});
  const json answer = support::parse_json(outcome.out);
  EXPECT_TRUE(answer["in_force"]);
  EXPECT_EQ(answer["changed"][0]["name"], "b");
  EXPECT_EQ(answer["changed"][0]["before"], 0.29);
  EXPECT_EQ(answer["changed"][0]["after"], 0.2886);
}

TEST(Flash, KeepsParametersWhenTheSimulatorIsStartedAgain) {
  const test::TemporaryFolder folder;
  const std::string flash = folder.path() / "flash";
  for (const char* expected : {"0.29\n", "0.2886\n"}) {
    support::Simulator simulator({"--fast", "--flash", flash});
    EXPECT_EQ(support::astrolabe({"params", "get", "b", "--port", simulator.port()}).out, expected);
    EXPECT_EQ(support::astrolabe({"params", "set", "b=0.2886", "--port", simulator.port()}).code, 0);
    simulator.program().send(SIGKILL);  // at once: committed values must be in the file already
  }
}

TEST(Flash, KeepsParametersThroughAReboot) {
  support::Simulator simulator;
  ASSERT_EQ(support::astrolabe({"params", "set", "b=0.2886", "--port", simulator.port()}).code, 0);
  const Outcome reboot = support::astrolabe({"reboot", "--port", simulator.port()});
  EXPECT_EQ(reboot.code, 0) << reboot.err;
  EXPECT_EQ(support::parse_json(
                support::astrolabe({"info", "--json", "--port", simulator.port()}).out)["reset_cause"],
            "software");
  EXPECT_EQ(support::astrolabe({"params", "get", "b", "--port", simulator.port()}).out, "0.2886\n");
}

TEST_F(Params, OfRos2sDiffDriveControllerComeBackAsTheyWereExported) {
  const std::string calibration = file(), yaml = (simulator_.folder() / "wheels.yaml").string();
  std::ofstream(calibration)
      << "[parameters]\nc_R = 1.002\nc_L = 0.998\nb = 0.2886\n[nominal]\nwheel_diameter = 0.072\n"
         "[carried]\nc_R = 1.0\nc_L = 1.0\nb = 0.29\n";
  const Outcome exported = support::astrolabe({"calibrate", "export", calibration, "--to", yaml,
                                               "--wheel-radius", "0.0361", "--wheel-separation", "0.3"});
  ASSERT_EQ(exported.code, 0) << exported.err;
  const Outcome imported = params({"import", yaml, "--yes"});
  ASSERT_EQ(imported.code, 0) << imported.err;
  // The same travel for each count: the factor times the diameter. Both are held in steps of 1e-9.
  const double diameter = std::stod(get("wheel_diameter"));
  EXPECT_NEAR(std::stod(get("c_R")) * diameter, 1.002 * 0.072, 2e-9);
  EXPECT_NEAR(std::stod(get("c_L")) * diameter, 0.998 * 0.072, 2e-9);
  EXPECT_NEAR(std::stod(get("b")), 0.2886, 2e-9);
}

}  // namespace
}  // namespace astro
