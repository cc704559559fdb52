#include "host/commands/live/ros_arguments.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "host/base/file_problem.hpp"
#include "host/commands/live/robot_driver.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/live/driver/parameter_table.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::commands {
namespace {

using live::ParameterType;
using testing::ElementsAre;

using Words = std::vector<std::string>;

RosArguments read(const Words& words) { return ros_arguments(words, {"astrolabe", "/"}); }

std::string why_not(const Words& words) {
  try {
    read(words);
    return "taken";
  } catch (const console::WrongUsage& error) {
    return error.what();
  }
}

std::vector<std::string> renamed(const Words& words) {
  std::vector<std::string> all;
  for (const live::Renaming& each : read(words).renamed) all.push_back(each.from + " > " + each.to);
  return all;
}

std::string shown(const ros2::msg::ParameterValue& value) {
  switch (static_cast<ParameterType>(value.type)) {
    case ParameterType::boolean:
      return value.bool_value ? "true" : "false";
    case ParameterType::integer:
      return "whole " + std::to_string(value.integer_value);
    case ParameterType::real:
      return "real " + std::to_string(value.double_value);
    default:
      return '\'' + value.string_value + '\'';
  }
}

std::vector<std::string> parameters(const Words& words) {
  std::vector<std::string> all;
  for (const ros2::msg::Parameter& each : read(words).parameters)
    all.push_back(each.name + " = " + shown(each.value));
  return all;
}

TEST(RosArguments, NameTheNodeAndItsNamespace) {
  EXPECT_EQ(ros2::full_name(read({}).node), "/astrolabe");
  EXPECT_EQ(ros2::full_name(read({"-r", "__node:=base", "-r", "__ns:=/hall/left"}).node), "/hall/left/base");
  EXPECT_EQ(ros2::full_name(read({"--remap", "__name:=base", "-r", "__ns:=/"}).node), "/base");
  EXPECT_EQ(ros2::full_name(read({"-r", "__ns:=/foo", "-r", "__ns:=/bar"}).node), "/foo/astrolabe")
      << "the first counts";
  EXPECT_EQ(ros2::full_name(read({"-r", "other:__node:=base", "-r", "astrolabe:__ns:=/left"}).node),
            "/left/astrolabe");
}

TEST(RosArguments, RenameTopicsAndServicesAsTheyLieInTheNodesNamespace) {
  EXPECT_THAT(renamed({"-r", "cmd_vel:=cmd_vel_safe", "-r", "/tf:=tf", "-r", "~/x:=/y"}),
              ElementsAre("/cmd_vel > /cmd_vel_safe", "/tf > /tf", "/astrolabe/x > /y"));
  EXPECT_THAT(renamed({"-r", "/tf:=tf", "-r", "rosservice://arm:=ready", "-r", "__ns:=/left"}),
              ElementsAre("/tf > /left/tf", "/left/arm > /left/ready"));
  EXPECT_THAT(renamed({"-r", "other:odom:=x", "-r", "astrolabe:odom:=y"}), ElementsAre("/odom > /y"));
}

TEST(RosArguments, ParametersHaveTheTypeOfTheirYaml) {
  EXPECT_THAT(parameters({"-p", "use_sim_time:=true", "-p", "publish_rate:=30", "-p", "c_R:=1.002", "-p",
                          "robot_name:=ASTRO", "--param", "text:='1'", "-p", "low:=-2.5e-3"}),
              ElementsAre("use_sim_time = true", "publish_rate = whole 30", "c_R = real 1.002000",
                          "robot_name = 'ASTRO'", "text = '1'", "low = real -0.002500"));
  EXPECT_THAT(parameters({"-p", "kp:=50", "-p", "kp:=60", "-p", "other:kp:=70", "-p", "list:=[1, 2]"}),
              ElementsAre("kp = whole 60"))
      << "the last counts, and that of another node does not";
}

TEST(RosArguments, AFileHasSectionsForNodesByTheirFullNames) {
  const test::TemporaryFolder folder;
  const std::string file = (folder.path() / "params.yaml").string();
  std::ofstream(file) << "/**:\n  ros__parameters:\n    use_sim_time: true\n    qos: {depth: 3}\n"
                         "astrolabe:\n  ros__parameters:\n    kp: 10\n"
                         "/left/astrolabe:\n  ros__parameters:\n    kp: 20\n"
                         "left:\n  other:\n    ros__parameters:\n      kp: 30\n"
                         "/*/astrolabe:\n  ros__parameters:\n    ki: 1.5\n";
  EXPECT_THAT(parameters({"--params-file", file}),
              ElementsAre("use_sim_time = true", "qos.depth = whole 3", "kp = whole 10"));
  EXPECT_THAT(
      parameters({"-r", "__ns:=/left", "--params-file", file}),
      ElementsAre("use_sim_time = true", "qos.depth = whole 3", "kp = whole 20", "ki = real 1.500000"));
  EXPECT_THAT(parameters({"--params-file", file, "-p", "kp:=5"}), testing::Contains("kp = whole 5"));
  EXPECT_THAT(parameters({"-p", "kp:=5", "--params-file", file}), testing::Contains("kp = whole 10"));
  const std::string none = (folder.path() / "none.yaml").string();
  EXPECT_THAT(([&] { read({"--params-file", none}); }), support::ThrowsTelling(FileProblem::missing, none));
}

TEST(RosArguments, WhatThisNodeHasNoneOfIsPassedOver) {
  EXPECT_EQ(why_not({"--log-level", "debug", "--enable-rosout-logs", "--disable-stdout-logs", "-e", "/hall",
                     "--log-config-file", "x"}),
            "taken");
}

TEST(RosArguments, AWordThatIsNoneOfThemIsNamed) {
  const std::string word = "has to be letters, digits and underscores, and must not begin with a digit",
                    path = "it has to begin with a /, and what is between two of them " + word;
  for (const auto& [words, said] : std::vector<std::pair<Words, std::string>>{
           {{"-r"}, "-r needs a value"},
           {{"-r", "odom"}, "-r 'odom' is not FROM:=TO"},
           {{"-r", ":=odom"}, "-r ':=odom' is not FROM:=TO"},
           {{"-r", "odom:="}, "-r 'odom:=' is not FROM:=TO"},
           {{"-r", "__node:=a/b"}, "-r: the name of the node is 'a/b': it " + word},
           {{"-r", "__ns:=left"}, "-r: the namespace is 'left': " + path},
           {{"-r", "odom:=1st"}, "-r: the name is '/1st': " + path},
           {{"-p", "kp"}, "-p 'kp' is not FROM:=TO"},
           {{"__node:=base"}, "knows no '__node:=base'"},
           {{"--params-file"}, "--params-file needs a value"}})
    EXPECT_EQ(why_not(words), "--ros-args: " + said);
  EXPECT_THAT(why_not({"-p", "kp:={"}),
              testing::StartsWith("--ros-args: -p 'kp:={': kp, line 2: this is not YAML: "));
}

TEST(RosArguments, ParametersOfTheNodeTakeThePlaceOfOptions) {
  RobotDriverOptions options;
  take_parameters(read({"-p", "publish_rate:=30", "-p", "cmd_vel_timeout:=0.2", "-p", "cmd_vel_type:=Twist",
                        "-p", "odom_frame_id:=odom2", "-p", "enable_odom_tf:=false", "-p",
                        "use_sim_time:=true", "-p", "c_R:=1.002"})
                      .parameters,
                  options);
  EXPECT_EQ(options.rate_hz, 30);
  EXPECT_EQ(options.cmd_vel_timeout_s, 0.2);
  EXPECT_EQ(options.cmd_vel_type, live::CommandType::twist);
  EXPECT_EQ(names_of(options).odom_frame(), "odom2");
  EXPECT_FALSE(options.odom_tf);
  EXPECT_TRUE(options.use_sim_time);
  ASSERT_EQ(options.robot_parameters.size(), 1U);
  EXPECT_EQ(options.robot_parameters[0].name, "c_R");
  for (const char* wrong :
       {"publish_rate:=0", "publish_rate:=fast", "cmd_vel_timeout:=60", "cmd_vel_type:=Pose",
        "odom_frame_id:=/odom", "enable_odom_tf:=1", "use_sim_time:='true'"})
    EXPECT_THROW(take_parameters(read({"-p", wrong}).parameters, options), console::WrongUsage) << wrong;
}

}  // namespace
}  // namespace astro::commands
