#include "host/live/ros2/parameter_answers.hpp"

#include <gmock/gmock.h>

#include "tests/host/live/ros2/parameters_of.hpp"

namespace astro::live {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

class Answers : public testing::Test {
 protected:
  ros2::msg::ListParametersResult list(std::vector<std::string> prefixes, std::uint64_t depth) {
    return answers_.to(ros2::msg::ListParameters::Request{std::move(prefixes), depth}).result;
  }

  NumbersTable table_{{{"b", 0.2}, {"limits.speed", 1}, {"limits.turn.left", 2}, {"limits.turn.right", 3}}};
  std::vector<std::vector<ros2::msg::Parameter>> changes_;
  ParameterAnswers answers_{table_, [this](std::span<const ros2::msg::Parameter> changed) {
                              changes_.emplace_back(changed.begin(), changed.end());
                            }};
};

TEST_F(Answers, AllValuesThatAreAskedForOrNoneIfOneNameIsUnknown) {
  using Get = ros2::msg::GetParameters::Request;
  EXPECT_THAT(answers_.to(Get{{"limits.speed", "b", "b"}}).values,
              ElementsAre(real(1), real(0.2), real(0.2)));
  EXPECT_THAT(answers_.to(Get{{"b", "c"}}).values, IsEmpty());
  EXPECT_THAT(answers_.to(Get{}).values, IsEmpty());
}

TEST_F(Answers, TypesAndDescriptionsByTheSameRule) {
  EXPECT_THAT(answers_.to(ros2::msg::GetParameterTypes::Request{{"b", "limits.speed"}}).types,
              ElementsAre(3, 3));
  EXPECT_THAT(answers_.to(ros2::msg::GetParameterTypes::Request{{"b", "c"}}).types, IsEmpty());
  const auto described = answers_.to(ros2::msg::DescribeParameters::Request{{"b"}}).descriptors;
  ASSERT_THAT(described, SizeIs(1));
  EXPECT_EQ(described[0].description, "the number b");
  EXPECT_EQ(described[0].floating_point_range->to_value, 1e6);
  EXPECT_THAT(answers_.to(ros2::msg::DescribeParameters::Request{{"c", "b"}}).descriptors, IsEmpty());
}

// Prefixes and depths as rclcpp's test_node_parameters.cpp has them.
TEST_F(Answers, NamesByPrefixAndDepth) {
  EXPECT_THAT(list({}, 0).names, ElementsAre("b", "limits.speed", "limits.turn.left", "limits.turn.right"));
  EXPECT_THAT(list({}, 0).prefixes, ElementsAre("limits", "limits.turn"));
  EXPECT_THAT(list({}, 1).names, ElementsAre("b"));
  EXPECT_THAT(list({}, 1).prefixes, IsEmpty());
  EXPECT_THAT(list({}, 2).names, ElementsAre("b", "limits.speed"));
  EXPECT_THAT(list({"limits"}, 0).names,
              ElementsAre("limits.speed", "limits.turn.left", "limits.turn.right"));
  EXPECT_THAT(list({"limits"}, 1).names, ElementsAre("limits.speed"));
  EXPECT_THAT(list({"limits.turn", "b"}, 1).names, ElementsAre("b", "limits.turn.left", "limits.turn.right"));
  EXPECT_THAT(list({"limits.speed"}, 1).names, ElementsAre("limits.speed")) << "a prefix may be a whole name";
  EXPECT_THAT(list({"limit"}, 0).names, IsEmpty()) << "a prefix is whole words";
  EXPECT_THAT(list({""}, 0).names, IsEmpty());
}

TEST_F(Answers, OneThatIsRefusedDoesNotKeepOthersFromBeingSet) {
  const auto results = answers_
                           .to(ros2::msg::SetParameters::Request{
                               {{"b", real(0.3)}, {"c", real(1)}, {"limits.speed", real(5)}}})
                           .results;
  ASSERT_THAT(results, SizeIs(3));
  EXPECT_TRUE(results[0].successful);
  EXPECT_FALSE(results[1].successful);
  EXPECT_THAT(results[1].reason, testing::HasSubstr("'c'"));
  EXPECT_TRUE(results[2].successful);
  EXPECT_EQ(table_.value("limits.speed"), real(5));
}

TEST_F(Answers, ThoseThatGoTogetherAreSetAtOnceBecauseARobotWritesItsFlashForEachSet) {
  const auto results =
      answers_.to(ros2::msg::SetParameters::Request{{{"b", real(0.5)}, {"limits.speed", real(2)}}}).results;
  EXPECT_THAT(results, testing::Each(ros2::msg::SetParametersResult{true, ""}));
  EXPECT_THAT(results, SizeIs(2));
  EXPECT_EQ(table_.sets, 1);
  EXPECT_THAT(changes_, ElementsAre(SizeIs(2)));
}

TEST_F(Answers, AtomicallyAllOrNoneAreSet) {
  using Set = ros2::msg::SetParametersAtomically::Request;
  const auto refused = answers_.to(Set{{{"b", real(0.5)}, {"limits.speed", real(2e6)}}}).result;
  EXPECT_FALSE(refused.successful);
  EXPECT_THAT(refused.reason, testing::HasSubstr("'limits.speed'"));
  EXPECT_EQ(table_.value("b"), real(0.2));
  EXPECT_THAT(changes_, IsEmpty());
  EXPECT_TRUE(answers_.to(Set{{{"b", real(0.5)}, {"limits.speed", real(2)}}}).result.successful);
  EXPECT_THAT(changes_, ElementsAre(SizeIs(2))) << "what changes at once is told at once";
}

TEST_F(Answers, ChangesAreToldWithTheValuesThatTheTableHasNow) {
  answers_.to(ros2::msg::SetParameters::Request{{{"b", real(0.3)}, {"c", real(1)}}});
  EXPECT_THAT(changes_, ElementsAre(ElementsAre(ros2::msg::Parameter{"b", real(0.3F)})));
  answers_.to(ros2::msg::SetParametersAtomically::Request{});
  EXPECT_THAT(changes_, SizeIs(1)) << "nothing was set";
}

}  // namespace
}  // namespace astro::live
