#include "host/commands/live/foxglove_options.hpp"

#include <gmock/gmock.h>

#include "tests/support/base/remarks.hpp"

namespace astro::commands {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::string announcement(const std::string& listen, bool allow_commands) {
  FoxgloveOptions options;
  options.listen = listen;
  options.allow_commands = allow_commands;
  return foxglove_announcement(options, listen_address_in(listen).port);
}

TEST(FoxgloveOptions, AnAddressIsAPortOrHasOne) {
  EXPECT_EQ(listen_address_in("8765").ip, "127.0.0.1");
  EXPECT_EQ(listen_address_in("8766").port, 8766);
  EXPECT_EQ(listen_address_in("0.0.0.0:80").ip, "0.0.0.0");
  EXPECT_EQ(listen_address_in("[::1]:80").ip, "::1");
  EXPECT_EQ(listen_address_in("[::1]:80").port, 80);
  EXPECT_EQ(listen_address_in("localhost:80").ip, "127.0.0.1");
  EXPECT_EQ(listen_address_in("localhost:80").port, 80);
  const auto said_of = [](const std::string& word) {
    return support::told_by([&] { listen_address_in(word); }).sentence;
  };
  for (const std::string wrong : {"", "65536", "-1", "localhost", "localhost:", "127.0.0.1", "80x"})
    EXPECT_EQ(said_of(wrong), "'" + wrong + "' is not PORT or ADDRESS:PORT, with a port up to 65535");
  for (const std::string wrong : {"lab", "1.2.3"})
    EXPECT_EQ(said_of(wrong + ":80"),
              "'" + wrong + "' is no address of a network, as 192.168.1.7, [::1] or 0.0.0.0 for all of them");
}

TEST(FoxgloveOptions, WhoCanBeReachedByOthersIsWarned) {
  EXPECT_THAT(announcement("8765", false), HasSubstr("ws://localhost:8765 "));
  EXPECT_THAT(announcement("8765", false), Not(HasSubstr("drive")));
  EXPECT_THAT(announcement("8765", true), HasSubstr("may arm and drive"));
  EXPECT_THAT(announcement("[::1]:1", true), Not(HasSubstr("WARNING")));
  EXPECT_THAT(announcement("192.168.1.7:1", false), HasSubstr("WARNING: other computers can connect"));
  EXPECT_THAT(announcement("0.0.0.0:1", true), HasSubstr("DRIVE THE ROBOT"));
}

TEST(FoxgloveOptions, ServicesThatStopTheRobotAreForEverybody) {
  EXPECT_THAT(foxglove_settings({}, "robot", live::Names("left")).always_served,
              ElementsAre("/left/emergency_stop", "/left/stop"));
  EXPECT_THAT(foxglove_settings({}, "robot", live::Names("", {{{"/stop", "/halt"}}})).always_served,
              ElementsAre("/emergency_stop", "/halt"));
}

}  // namespace
}  // namespace astro::commands
