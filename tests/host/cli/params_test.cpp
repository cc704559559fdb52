#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/json.hpp"
#include "tests/support/program.hpp"

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
  EXPECT_EQ(get("kV_left"), "12.2\n");  // held as 12.1999969482421875
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
  ASSERT_EQ(params({"export", file()}).code, 0);
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
    simulator.program().send(SIGKILL);  // no goodbye: what is committed is in the file by then
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

}  // namespace
}  // namespace astro
