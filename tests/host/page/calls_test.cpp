#include "host/page/calls/calls.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/base/temporary_folder.hpp"

namespace astro::page {
namespace {

using nlohmann::json;
using testing::HasSubstr;

struct Asked {
  json answer;
  std::vector<json> events;

  std::vector<json> of(const std::string& kind) const {
    std::vector<json> found;
    for (const json& event : events)
      if (event.at("event") == kind) found.push_back(event);
    return found;
  }
};

Asked ask(const std::string& call, const json& question, const std::filesystem::path& folder) {
  Asked asked;
  asked.answer = answer(call, question, folder, [&](const json& event) { asked.events.push_back(event); });
  return asked;
}

json question(int seed, int runs) { return {{"seed", seed}, {"runs", runs}, {"e", 0.02}}; }

TEST(TryOut, FindsTheFactorsThatTheRobotWasBuiltWithinTheirErrors) {
  for (int seed = 1; seed <= 3; ++seed) {
    const test::TemporaryFolder folder;
    const Asked asked = ask("try_out", question(seed, 3), folder.path());
    ASSERT_TRUE(asked.answer.contains("result")) << asked.answer;
    const json& result = asked.answer["result"];
    const json &found = result["results"]["parameters"]["new"],
               &errors = result["results"]["parameters"]["standard_errors"];
    // Four standard errors: one of twelve figures would be beyond them once in a thousand runs of this test.
    for (const char* name : {"c_R", "c_L", "b_m", "e"})
      EXPECT_LT(std::abs(found[name].get<double>() - result["built"][name].get<double>()),
                4 * errors[name].get<double>())
          << name << " of robot " << seed;
    EXPECT_GT(result["results"]["improvement"].get<double>(), 1) << result["verdict"];
    EXPECT_TRUE(std::filesystem::exists(folder.path() / result["report"].get<std::string>()));
  }
}

TEST(TryOut, TellsEachDriveAndBothOfItsWaysFromTheirCommonStart) {
  const test::TemporaryFolder folder;
  const Asked asked = ask("try_out", question(1, 1), folder.path());
  const std::vector<json> runs = asked.of("run");
  ASSERT_EQ(runs.size(), 14U) << "two squares, a line and four circles, before and after";
  EXPECT_EQ(runs.front().at("phase"), "before");
  EXPECT_EQ(runs.back().at("phase"), "after");
  EXPECT_EQ(asked.of("calibrated").size(), 1U);
  double start_m = 0, farthest_m = 0;
  bool starts = false;
  for (const json& event : asked.events) {
    if (event.at("event") == "run") starts = true;
    if (event.at("event") != "way") continue;
    ASSERT_EQ(event["odometry"].size(), event["truth"].size());
    for (const char* way : {"odometry", "truth"}) {
      if (starts) start_m = std::max(start_m, std::abs(event[way][0].get<double>()));
      for (const json& x_or_y_m : event[way])
        farthest_m = std::max(farthest_m, std::abs(x_or_y_m.get<double>()));
    }
    starts = false;
  }
  EXPECT_LT(start_m, 0.001);
  // Headings that are off by 0.1 rad at the last corners, as of this robot, move a corner by 0.3 m.
  EXPECT_NEAR(farthest_m, 3, 0.5) << "the far corner of a square";
}

TEST(TryOut, TheSameQuestionHasTheSameAnswer) {
  const test::TemporaryFolder first, second;
  json answers[] = {ask("try_out", question(7, 1), first.path()).answer,
                    ask("try_out", question(7, 1), second.path()).answer};
  EXPECT_EQ(answers[0]["result"]["results"]["parameters"], answers[1]["result"]["results"]["parameters"]);
}

TEST(TryOut, WritesNothingAmongTheFilesOfAPerson) {
  const test::TemporaryFolder folder;
  for (const char* name : {"try", "try-1", "results"}) std::ofstream(folder.path() / name) << "mine";
  ASSERT_TRUE(ask("try_out", question(1, 1), folder.path()).answer.contains("result"));
  ASSERT_TRUE(ask("try_out", question(2, 1), folder.path()).answer.contains("result"));
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    names.push_back(entry.path().filename().string());
  EXPECT_THAT(names, testing::UnorderedElementsAre("try", "try-1", "results", ".made"));
  const auto runs = std::filesystem::directory_iterator(folder.path() / ".made");
  EXPECT_EQ(std::distance(begin(runs), end(runs)), 1)
      << "a page that tries many robots does not fill its memory";
}

TEST(TryOut, ARobotThatNobodyBuildsIsRefusedInASentence) {
  const test::TemporaryFolder folder;
  const auto sentence = [&](const json& question) {
    return ask("try_out", question, folder.path()).answer.at("error").at("sentence").get<std::string>();
  };
  EXPECT_EQ(sentence({{"E_d", 3}}), "E_d is 3, and must be from 0.9 to 1.1");
  EXPECT_EQ(sentence({{"slip", -1}}), "slip is -1, and must be from 0 to 1000");
  EXPECT_EQ(sentence({{"seed", nullptr}}), "seed is no number");
  EXPECT_EQ(sentence("E_d"), "the question is no object");
}

TEST(Calls, AFolderThatCannotBeWrittenIsToldLikeAnyOtherRefusal) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "file") << "in the way";
  const Asked asked = ask("try_out", question(1, 1), folder.path() / "file");
  EXPECT_THAT(asked.answer.at("error").at("sentence").get<std::string>(), HasSubstr("/try"));
}

TEST(Calls, AnswersAreTextWhateverBytesAFileHolds) {
  const json parsed = json::parse(json_text({{"sentence", "'Weg[\xb0]' is no number"}}));
  EXPECT_EQ(parsed["sentence"], "'Weg[\xEF\xBF\xBD]' is no number");
}

TEST(Calls, AnUnknownOneIsNamed) {
  EXPECT_EQ(ask("fly", json::object(), {}).answer.at("error").at("sentence"), "there is no call 'fly'");
}

}  // namespace
}  // namespace astro::page
