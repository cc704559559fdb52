#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/pages/page.hpp"
#include "tests/support/programs/program.hpp"

// The program as a person starts it, a simulated robot behind a pty, and pages on loopback.
namespace astro {
namespace {

using nlohmann::json;
using support::astrolabe;
using support::eventually;
using support::OpenPage;
using support::Outcome;
using support::PatientSimulator;
using support::Program;
using testing::HasSubstr;
using testing::StartsWith;

class ServedPage {
 public:
  ServedPage() { std::ofstream(folder_.path() / "index.html") << "the page"; }
  std::string folder() const { return folder_.path().string(); }

 private:
  test::TemporaryFolder folder_;
};

class RunningDashboard {
 public:
  /// Without a robot unless one is named: those of other tests are left alone.
  explicit RunningDashboard(const std::vector<std::string>& options = {"--port", "/dev/no-robot"})
      : program_(words(options)) {
    if (!eventually([&] { return program_.out().find('\n') != std::string::npos; }))
      throw std::runtime_error("the dashboard does not start: " + program_.err());
  }
  std::string link() const { return program_.out().substr(0, program_.out().find('\n')); }
  std::uint16_t port() const {
    const std::string text = link();
    return static_cast<std::uint16_t>(std::stoi(text.substr(text.rfind(':') + 1)));
  }
  std::string token() const { return link().substr(link().find('=') + 1); }
  OpenPage page() const { return OpenPage(port(), token()); }
  Program& program() { return program_; }

 private:
  std::vector<std::string> words(const std::vector<std::string>& options) const {
    std::vector<std::string> all{ASTROLABE_PROGRAM, "dashboard", "--listen",    "0",
                                 "--no-browser",    "--page",    page_.folder()};
    all.insert(all.end(), options.begin(), options.end());
    return all;
  }
  ServedPage page_;
  Program program_;
};

std::string mode_of(const std::string& port) {
  const Outcome shown = astrolabe({"monitor", "--json", "--count", "1", "--port", port});
  return json::parse(shown.out).at("mode");
}

TEST(Dashboard, PrintsALinkThatOpensThePageAndEndsWithZero) {
  for (const int signal : {SIGINT, SIGTERM}) {
    RunningDashboard dashboard;
    EXPECT_THAT(dashboard.link(), StartsWith("http://127.0.0.1:"));
    EXPECT_THAT(support::answer_of_server(dashboard.port(), support::request("GET /", dashboard.port())),
                HasSubstr("the page"));
    EXPECT_GT(dashboard.page().number(), 0);
    dashboard.program().send(signal);
    EXPECT_EQ(dashboard.program().wait(), 0) << dashboard.program().err();
  }
}

TEST(Dashboard, DrivesTheRobotAtItsPortAndLeavesItAtRestWhenThePageGoes) {
  PatientSimulator robot({});
  RunningDashboard dashboard({"--port", robot.port()});
  {
    OpenPage page = dashboard.page();
    ASSERT_TRUE(page.hears(
        [](const json& event) { return event["event"] == "state" && event["mode"] == "disarmed"; }));
    EXPECT_EQ(page.result("robot/open")["port"], robot.port());
    page.result("robot/arm");
    page.result("robot/path", {{"kind", "line"}, {"size_m", 20}});
    ASSERT_TRUE(
        page.hears([](const json& event) { return event["event"] == "state" && event["moving"] == true; }));
  }
  EXPECT_TRUE(eventually([&] { return mode_of(robot.port()) == "disarmed"; }));
}

TEST(Dashboard, ThatIsEndedLeavesARobotAtRest) {
  PatientSimulator robot({});
  RunningDashboard dashboard({"--port", robot.port()});
  OpenPage page = dashboard.page();
  ASSERT_TRUE(
      page.hears([](const json& event) { return event["event"] == "state" && event["mode"] == "disarmed"; }));
  page.result("robot/arm");
  page.result("robot/path", {{"kind", "line"}, {"size_m", 20}});
  ASSERT_TRUE(
      page.hears([](const json& event) { return event["event"] == "state" && event["moving"] == true; }));
  dashboard.program().send(SIGINT);
  EXPECT_EQ(dashboard.program().wait(), 0) << dashboard.program().err();
  EXPECT_EQ(mode_of(robot.port()), "disarmed");
}

TEST(Dashboard, ThatIsEndedSaysWhereARecordingIs) {
  const test::TemporaryFolder kept;
  RunningDashboard dashboard({"--port", "/dev/no-robot", "--recordings", kept.path().string()});
  OpenPage page = dashboard.page();
  page.result("robot/open", {{"simulated", json::object()}});
  const std::string file = page.result("robot/record", {{"on", true}})["file"];
  dashboard.program().send(SIGINT);
  EXPECT_EQ(dashboard.program().wait(), 0) << dashboard.program().err();
  EXPECT_THAT(dashboard.program().err(), HasSubstr(file));
  EXPECT_EQ(
      astrolabe({"export", (kept.path() / file).string(), "--csv", (kept.path() / "csv").string()}).code, 0);
}

TEST(Dashboard, NamesARobotThatIsNotThereAndStaysForAnother) {
  RunningDashboard dashboard({"--port", "/dev/no-robot"});
  EXPECT_TRUE(
      eventually([&] { return dashboard.program().err().find("/dev/no-robot") != std::string::npos; }));
  EXPECT_TRUE(
      dashboard.page().result("robot/open", {{"simulated", json::object()}})["simulated"].get<bool>());
}

TEST(Dashboard, SaysWhatHelpsIfItCannotServe) {
  const Outcome no_page = astrolabe({"dashboard", "--no-browser", "--listen", "0", "--page", "/nowhere"});
  EXPECT_EQ(no_page.code, 1);
  EXPECT_THAT(
      no_page.err,
      HasSubstr("there is no page in '/nowhere': './dev web' builds it, or --page names another folder"));
  RunningDashboard dashboard;
  const ServedPage page;
  const Outcome taken = astrolabe(
      {"dashboard", "--no-browser", "--listen", std::to_string(dashboard.port()), "--page", page.folder()});
  EXPECT_EQ(taken.code, 1);
  EXPECT_THAT(taken.err, HasSubstr("choose another port with --listen"));
  EXPECT_EQ(astrolabe({"dashboard", "--listen", "evil.com:80"}).code, 2);
}

}  // namespace
}  // namespace astro
