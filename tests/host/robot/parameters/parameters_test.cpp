#include "host/robot/parameters/parameters.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "host/robot/client/robot_problem.hpp"
#include "host/robot/parameters/parameter_problem.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/links/fake_link.hpp"

namespace astro::robot {
namespace {

using protocol::ParameterKind;
using support::Tells;
using support::ThrowsTelling;
using test::FakeLink;

ParameterRow row(ParameterKind kind, int exponent, std::int32_t minimum, std::int32_t maximum) {
  ParameterRow r;
  r.name = "p";
  r.unit = "m";
  r.kind = kind;
  r.exponent = exponent;
  r.minimum = minimum;
  r.maximum = maximum;
  return r;
}

Remark why_not(const ParameterRow& r, const Value& value) {
  return support::told_by([&] { to_raw(r, value); });
}

constexpr auto kLowest = std::numeric_limits<std::int32_t>::min();
constexpr auto kHighest = std::numeric_limits<std::int32_t>::max();

TEST(ParameterRow, EveryRawValueSurvivesTheWayToARealNumberAndBack) {
  std::mt19937 random(7);
  std::uniform_int_distribution<std::int32_t> any(kLowest, kHighest);
  for (const auto& r : {row(ParameterKind::binary_scaled, -30, kLowest, kHighest),
                        row(ParameterKind::binary_scaled, 3, kLowest, kHighest),
                        row(ParameterKind::decimal_scaled, -9, kLowest, kHighest),
                        row(ParameterKind::decimal_scaled, 6, kLowest, kHighest),
                        row(ParameterKind::integer, 0, kLowest, kHighest)}) {
    for (const std::int32_t raw : {kLowest, -1, 0, 1, kHighest})
      EXPECT_EQ(to_raw(r, to_real(r, raw)).raw, raw);
    for (int i = 0; i < 10'000; ++i) {
      const std::int32_t raw = any(random);
      ASSERT_EQ(to_raw(r, to_real(r, raw)).raw, raw) << "exponent " << r.exponent;
    }
  }
}

TEST(ParameterRow, RoundsToTheNearestStep) {
  const auto r = row(ParameterKind::decimal_scaled, -3, 0, 1000);
  EXPECT_EQ(to_raw(r, 0.1234).raw, 123);
  EXPECT_EQ(to_raw(r, 0.1236).raw, 124);
  EXPECT_EQ(to_raw(row(ParameterKind::binary_scaled, -30, kLowest, kHighest), 1.00416).raw,
            1078208590);  // ...589.988
}

TEST(ParameterRow, DecimalValuesReadAsPeopleWroteThem) {
  const auto r = row(ParameterKind::decimal_scaled, -9, 0, kHighest);
  EXPECT_EQ(describe(r, to_value(r, {290'000'000, {}})), "0.29 m");
  EXPECT_EQ(to_raw(r, 0.29).raw, 290'000'000);
}

TEST(ParameterRow, ValuesReadBackAsTheyWereWritten) {
  const auto q30 = row(ParameterKind::binary_scaled, -30, kLowest, kHighest);
  EXPECT_EQ(std::get<double>(to_value(q30, to_raw(q30, 1.002))), 1.002);
  EXPECT_EQ(describe(q30, to_value(q30, to_raw(q30, 1.002))), "1.002 m");
  EXPECT_NE(to_real(q30, to_raw(q30, 1.002).raw), 1.002)
      << "what is computed with stays what the robot holds";
  std::mt19937 random(11);
  std::uniform_int_distribution<int> any(-1'999'999, 1'999'999);
  for (int i = 0; i < 10'000; ++i) {
    const double written = any(random) / 1e6;
    ASSERT_EQ(std::get<double>(to_value(q30, to_raw(q30, written))), written);
    const std::int32_t raw = any(random) * 1000;
    ASSERT_EQ(to_raw(q30, to_shortest(q30, raw)).raw, raw);
  }
}

TEST(ParameterRow, OutOfRangeNamesParameterValueUnitAndLimits) {
  const auto r = row(ParameterKind::decimal_scaled, -3, 50, 2000);
  EXPECT_THAT(why_not(r, 3.5), Tells(ParameterProblem::out_of_range, "p", "3.5 m", "0.05 m to 2 m"));
  EXPECT_NO_THROW(to_raw(r, 0.0496)) << "rounds to the limit";
  EXPECT_THAT(why_not(r, 0.0494), Tells(ParameterProblem::out_of_range));
  EXPECT_THAT(why_not(r, 1e300), Tells(ParameterProblem::out_of_range));
}

TEST(ParameterRow, LimitsHaveTheDigitsThatPeopleWrite) {
  const auto r = row(ParameterKind::binary_scaled, -30, -214'748'365, 214'748'365);
  EXPECT_EQ(range_of(r), "-0.2 m to 0.2 m");
  EXPECT_THAT(why_not(r, 0.33), Tells(ParameterProblem::out_of_range, "p", "0.33 m", "-0.2 m to 0.2 m"));
  EXPECT_NO_THROW(to_raw(r, -0.2));
}

TEST(ParameterRow, RefusesWhatIsNoValueOfItsKind) {
  const auto digit = row(ParameterKind::integer, 0, 0, 9), text = row(ParameterKind::text, 0, 1, 23);
  EXPECT_THAT(why_not(digit, std::nan("")), Tells(ParameterProblem::not_a_number, "p"));
  EXPECT_THAT(why_not(digit, HUGE_VAL), Tells(ParameterProblem::not_a_number, "p"));
  EXPECT_THAT(why_not(digit, 1.5), Tells(ParameterProblem::not_whole, "p"));
  EXPECT_THAT(why_not(row(ParameterKind::flag, 0, 0, 1), 2.0),
              Tells(ParameterProblem::out_of_range, "p", "2 m", "0 m to 1 m"));
  EXPECT_THAT(why_not(digit, std::string("x")), Tells(ParameterProblem::is_number, "p"));
  EXPECT_THAT(why_not(text, 5.0), Tells(ParameterProblem::is_text, "p"));
  EXPECT_THAT(why_not(text, std::string(24, 'x')), Tells(ParameterProblem::wrong_length, "p", "24"));
  EXPECT_THAT(why_not(text, std::string()), Tells(ParameterProblem::wrong_length, "p", "0"));
}

class Parameters : public testing::Test {
 protected:
  FakeLink link;
  Client client{link};
  void SetUp() override { client.connect(); }
};

TEST_F(Parameters, AreWhatTheRobotSaysTheyAre) {
  const auto parameters = RemoteParameters::fetch(client);
  ASSERT_EQ(parameters.rows().size(), link.robot.parameters.size());
  EXPECT_EQ(parameters.row("b").unit, "m");
  EXPECT_EQ(std::get<double>(parameters.value("b")), 0.29);
  EXPECT_EQ(std::get<double>(parameters.value("c_R")), 1.0);
  EXPECT_EQ(std::get<std::string>(parameters.value("robot_name")), "astro");
  EXPECT_EQ(parameters.find("no_such"), nullptr);
  EXPECT_THROW(parameters.row("no_such"), Error);
}

TEST_F(Parameters, ThatAreNumbersAreReadAsSuchOneByOneOrTogether) {
  const auto parameters = RemoteParameters::fetch(client);
  EXPECT_EQ(parameters.number("b"), 0.29);
  const std::map<std::string, double> all = parameters.numbers();
  EXPECT_EQ(all.at("b"), 0.29);
  EXPECT_EQ(all.at("c_R"), 1.0);
  EXPECT_FALSE(all.contains("robot_name")) << "a text";
  EXPECT_THAT([&] { (void)parameters.number("robot_name"); },
              ThrowsTelling(ParameterProblem::is_text, "robot_name"));
  EXPECT_THROW((void)parameters.number("no_such"), Error);
}

TEST_F(Parameters, StagedValuesComeInForceWithTheCommit) {
  auto parameters = RemoteParameters::fetch(client);
  parameters.stage("b", 0.3);
  parameters.stage("robot_name", std::string("zwei"));
  EXPECT_EQ(link.robot.parameter("b").value.active, 290'000'000);
  parameters.commit();
  EXPECT_EQ(link.robot.parameter("b").value.active, 300'000'000);
  EXPECT_EQ(link.robot.parameter("robot_name").value.active_text.view(), "zwei");
  parameters.refresh();
  EXPECT_EQ(std::get<double>(parameters.value("b")), 0.3);
}

TEST_F(Parameters, RevertAndDefaultsChangeOnlyWhatIsStaged) {
  auto parameters = RemoteParameters::fetch(client);
  parameters.stage("b", 0.3);
  parameters.commit();
  parameters.defaults();
  EXPECT_EQ(parameters.row("b").staged.raw, 290'000'000);
  EXPECT_EQ(parameters.row("b").active.raw, 300'000'000);
  parameters.revert();
  EXPECT_EQ(link.robot.parameter("b").value.staged, 300'000'000);
}

TEST_F(Parameters, ARefusedCommitNamesTheParameterAndItsValue) {
  auto parameters = RemoteParameters::fetch(client);
  parameters.stage("polarity", 0.0);
  try {
    parameters.commit();
    FAIL();
  } catch (const RobotRefused& refused) {
    EXPECT_EQ(refused.code(), protocol::ErrorCode::invalid_parameter);
    EXPECT_THAT(refused.remark(), Tells(RobotProblem::refused, "polarity", "0"));
  }
}

TEST_F(Parameters, OfMoreParametersThanAnyRobotHasIsNotAskedFor) {
  link.robot.identity.parameter_count = 65'535;
  client.connect();
  const std::size_t before = link.robot.seen.size();
  EXPECT_THAT([&] { RemoteParameters::fetch(client); }, ThrowsTelling(ParameterProblem::too_many, "65535"));
  EXPECT_EQ(link.robot.seen.size(), before);
}

TEST_F(Parameters, HasNoNamesThatATerminalWouldObey) {
  link.robot.parameters.front().info.name = Text<24>("c\033[2J");
  link.robot.parameters.front().info.unit = Text<8>("\xFF");
  const auto parameters = RemoteParameters::fetch(client);
  EXPECT_EQ(parameters.rows().front().name, "c\uFFFD[2J");
  EXPECT_EQ(parameters.rows().front().unit, "\uFFFD");
}

TEST_F(Parameters, TakesNoTextWithControlCharacters) {
  auto parameters = RemoteParameters::fetch(client);
  const std::string nul("a\0b", 3);
  for (const std::string& text : {std::string("a\033[2J"), std::string("a\nb"), std::string("\xFF"), nul})
    EXPECT_THROW(parameters.stage("robot_name", text), Error);
  EXPECT_NO_THROW(parameters.stage("robot_name", std::string("Größe")));
}

}  // namespace
}  // namespace astro::robot
