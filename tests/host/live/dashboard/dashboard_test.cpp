#include "host/live/dashboard/dashboard.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/recording/run_file.hpp"
#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/pages/page.hpp"

// The server on loopback, with a simulated robot. No claim is about how long anything takes.
namespace astro::dashboard {
namespace {

using nlohmann::json;
using support::answer_of_server;
using support::Handshake;
using support::OpenPage;
using support::request;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string sentence(const json& answer) {
  return answer.contains("error") ? answer["error"]["sentence"].get<std::string>() : "";
}

bool is_state(const json& event) { return event.at("event") == "state"; }

class Served : public testing::Test {
 protected:
  Served() {
    std::ofstream(folder_.path() / "index.html") << "the page";
    Settings settings;
    settings.page = folder_.path();
    settings.page_timeout = std::chrono::hours(1);  // these pages answer pings only while they read
    settings.recordings = kept_;
    settings.notice = [this](const Remark& remark) {
      const std::lock_guard lock(noticing_);
      notices_.push_back(remark.sentence);
    };
    dashboard_.emplace(settings);
  }

  std::uint16_t port() const { return dashboard_->port(); }
  std::string token() const {
    const std::string link = dashboard_->path_of_link();
    return link.substr(link.find('=') + 1);
  }
  OpenPage page() const { return OpenPage(port(), token()); }
  std::string said(const std::string& line, const std::string& fields = "",
                   const std::string& body = "") const {
    return answer_of_server(port(), request(line, port(), fields, body));
  }
  std::string bearer() const { return "Authorization: Bearer " + token() + "\r\n"; }
  /// A page whose robot drives 20 m straight ahead.
  OpenPage driving_page() const {
    OpenPage driver = page();
    driver.result("robot/open", {{"simulated", {{"seed", 1}}}});
    driver.result("robot/arm");
    driver.result("robot/path", {{"kind", "line"}, {"size_m", 20}});
    EXPECT_TRUE(driver.hears([](const json& event) { return is_state(event) && event["moving"] == true; }));
    return driver;
  }

  test::TemporaryFolder folder_;
  const std::filesystem::path kept_ = folder_.path() / "kept";
  std::mutex noticing_;
  std::vector<std::string> notices_;
  std::optional<Dashboard> dashboard_;
};

TEST_F(Served, ThePageComesIsolatedAndUnframed) {
  const std::string answer = said("GET /");
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(answer, HasSubstr("\r\n\r\nthe page"));
  for (const char* field :
       {"X-Frame-Options: DENY", "frame-ancestors 'none'", "Cross-Origin-Opener-Policy: same-origin",
        "Cross-Origin-Embedder-Policy: require-corp", "Cross-Origin-Resource-Policy: same-origin",
        "X-Content-Type-Options: nosniff", "Referrer-Policy: no-referrer"})
    EXPECT_THAT(answer, HasSubstr(field));
  EXPECT_THAT(answer, Not(HasSubstr("Access-Control"))) << "no other page may read anything";
  EXPECT_THAT(answer, Not(HasSubstr(token())));
  EXPECT_THAT(said("GET /nothing"), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(said("GET /nothing"), HasSubstr("X-Frame-Options: DENY"));
}

TEST_F(Served, ARecordingUnderWayIsKeptWhenTheProgramEnds) {
  OpenPage own = page();
  own.result("robot/open", {{"simulated", {{"seed", 1}}}});
  const std::string file = own.result("robot/record", {{"on", true}})["file"];
  EXPECT_TRUE(own.hears([&](const json& event) { return is_state(event) && event["recording"] == file; }));
  dashboard_.reset();
  EXPECT_EQ(recording::read_run(kept_ / file).info.kind, "free");
  ASSERT_EQ(notices_.size(), 1U);
  EXPECT_THAT(notices_.front(), HasSubstr((kept_ / file).string()));
}

TEST_F(Served, ANameThatWasMadeToLeadHereIsRefused) {
  for (const std::string& line :
       {std::string("GET /"), std::string("GET /files/a.csv"), std::string("PUT /files/a.csv")})
    EXPECT_THAT(said(line, "Host: evil.com:" + std::to_string(port()) + "\r\n" + bearer()),
                StartsWith("HTTP/1.1 421"))
        << line;
  EXPECT_THROW(OpenPage(port(), token(), Handshake{"evil.com", ""}), std::exception);
  EXPECT_THROW(OpenPage(port(), token(), Handshake{"evil.com", "http://evil.com"}), std::exception);
}

TEST_F(Served, OtherPagesNeitherSeeNorDriveNorWrite) {
  for (const std::string& origin :
       {std::string("http://evil.com"), std::string("null"), std::string("http://localhost:1"),
        "https://127.0.0.1:" + std::to_string(port())}) {
    EXPECT_THROW(OpenPage(port(), token(), Handshake{"", origin}), std::exception) << origin;
    EXPECT_THAT(said("PUT /files/a.csv", "Origin: " + origin + "\r\n" + bearer(), "1"),
                StartsWith("HTTP/1.1 403"))
        << origin;
  }
  OpenPage own(port(), token(), Handshake{"", "http://127.0.0.1:" + std::to_string(port())});
  EXPECT_GT(own.number(), 0);
}

TEST_F(Served, AFormThatAStrangersPagePostsDoesNothing) {
  const std::string form = "Content-Type: application/x-www-form-urlencoded\r\n";
  EXPECT_THAT(said("POST /files/a.csv", form, "x=1"), StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(said("POST /calls", form, "x=1"), StartsWith("HTTP/1.1 426"));
  EXPECT_THAT(said("POST /", form, "x=1"), StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(said("POST /files/a.csv", "Origin: http://evil.com\r\n" + form, "x=1"),
              StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(said("GET /files/a.csv", "Sec-Fetch-Site: cross-site\r\n" + bearer()),
              StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(said("GET /files/a.csv", bearer()), StartsWith("HTTP/1.1 404")) << "nothing was written";
}

TEST_F(Served, WithoutTheTokenNothingIsAnswered) {
  for (const char* first : {R"({"token": "guess"})", R"({"token": 1})",
                            R"({"id": 1, "call": "robot/ports", "question": {}})", "{", "[]", ""}) {
    OpenPage stranger(port(), "");
    stranger.say(first);
    EXPECT_TRUE(stranger.ends());
    EXPECT_THAT(stranger.why_it_ended(), HasSubstr("token")) << first;
    EXPECT_TRUE(stranger.events().empty());
  }
}

TEST_F(Served, FilesComeAndGoWithTheToken) {
  EXPECT_THAT(said("PUT /files/a%20b.csv", "", "1,2\n"), StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(said("PUT /files/a%20b.csv", bearer(), "1,2\n"), StartsWith("HTTP/1.1 204"));
  EXPECT_THAT(said("GET /files/a%20b.csv", bearer()), HasSubstr("\r\n\r\n1,2\n"));
  EXPECT_THAT(said("GET /files/a%20b.csv"), StartsWith("HTTP/1.1 401"));
  for (const char* name : {"..%2fx", "a%2fb", "%00", "%", ".hidden", ""})
    EXPECT_THAT(said(std::string("PUT /files/") + name, bearer(), "x"), StartsWith("HTTP/1.1 400")) << name;
  EXPECT_THAT(said("GET /files/..%2f..%2fetc%2fpasswd", bearer()), StartsWith("HTTP/1.1 404"));
}

TEST_F(Served, AFileThatIsTooLargeIsAnswered) {
  EXPECT_THAT(said("PUT /files/a.csv", bearer() + "Content-Length: 1000000000000\r\n"),
              StartsWith("HTTP/1.1 507"));
}

TEST_F(Served, CallsReadTheFilesThatWereDropped) {
  ASSERT_THAT(said("PUT /files/wheels.csv", bearer(), "time,left,right\n0,0,0\n0.1,10,10\n0.2,20,20\n"),
              StartsWith("HTTP/1.1 204"));
  OpenPage own = page();
  EXPECT_FALSE(own.ask("inspect", {{"files", {"wheels.csv"}}}).is_null());
  EXPECT_THAT(sentence(own.ask("nothing")), HasSubstr("no call 'nothing'"));
}

TEST_F(Served, WhatIsNoCallIsAnsweredAndThePageStays) {
  OpenPage own = page();
  for (const char* text : {"{", "[1]", R"({"id": 7})", R"({"call": ""})"}) own.say(text);
  EXPECT_THAT(sentence(own.answer_to(7)), HasSubstr("no call"));
  EXPECT_TRUE(own.result("robot/ports")["ports"].empty());
}

TEST_F(Served, AStopIsCarriedOutWhileACalculationIsUnderWay) {
  OpenPage driver = driving_page();
  const std::int64_t calculation = driver.begin("try_out", {{"runs", 1}});
  driver.result("robot/stop");
  EXPECT_TRUE(driver.hears([](const json& event) { return is_state(event) && event["moving"] == false; }));
  EXPECT_EQ(sentence(driver.answer_to(calculation)), "");
}

TEST_F(Served, ASecondPageMayWatchAndStopButNotDrive) {
  OpenPage driver = driving_page(), second = page();
  EXPECT_NE(driver.number(), second.number());
  second.result("robot/open");
  second.result("robot/watch", {{"signals", {"v"}}, {"rate_hz", 50}});
  EXPECT_TRUE(second.hears([](const json& event) { return event.at("event") == "samples"; }));
  EXPECT_THAT(sentence(second.ask("robot/arm")), HasSubstr("another page drives the robot"));
  EXPECT_THAT(sentence(second.ask("robot/drive", {{"v_mps", 0.1}})),
              HasSubstr("another page drives the robot"));
  second.result("robot/stop");
  EXPECT_TRUE(second.hears([](const json& event) { return is_state(event) && event["moving"] == false; }));
}

TEST_F(Served, WhenThePageThatDrivesIsReloadedTheRobotComesToRestAndIsDisarmed) {
  std::optional<OpenPage> driver(driving_page());
  OpenPage witness = page();
  driver.reset();
  EXPECT_TRUE(witness.hears([](const json& event) {
    return is_state(event) && event["mode"] == "disarmed" && event["moving"] == false;
  }));
  OpenPage again = page();
  EXPECT_TRUE(again.result("robot/open")["simulated"].get<bool>()) << "the robot is still open";
  EXPECT_THAT(sentence(again.ask("robot/drive", {{"v_mps", 0.1}})), HasSubstr("not armed"));
}

TEST_F(Served, TheEndOfTheServerLeavesNoPageWithoutAnAnswer) {
  OpenPage driver = driving_page();
  dashboard_.reset();
  EXPECT_TRUE(driver.ends());
}

TEST_F(Served, MorePagesThanThereIsRoomForAreToldSo) {
  std::vector<OpenPage> pages;
  for (int i = 0; i < 16; ++i) pages.push_back(page());
  OpenPage one_too_many = page();
  EXPECT_TRUE(one_too_many.ends());
  EXPECT_THAT(one_too_many.why_it_ended(), HasSubstr("close one"));
  pages.pop_back();
}

TEST(Dashboard, WithoutAPageSaysWhichFolderHasNone) {
  const test::TemporaryFolder folder;
  Settings settings;
  settings.page = folder.path();
  try {
    const Dashboard none(settings);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Kind(DashboardProblem::no_page));
    EXPECT_EQ(error.values().front(), folder.path().string());
  }
}

TEST(Dashboard, EachSessionHasAnotherToken) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "index.html") << "page";
  Settings settings;
  settings.page = folder.path();
  const Dashboard one(settings), other(settings);
  EXPECT_NE(one.path_of_link(), other.path_of_link());
  EXPECT_GE(one.path_of_link().size(), 32U + 1);
  OpenPage stranger(other.port(), "");
  stranger.say(json{{"token", one.path_of_link().substr(one.path_of_link().find('=') + 1)}}.dump());
  EXPECT_TRUE(stranger.ends());
}

}  // namespace
}  // namespace astro::dashboard
