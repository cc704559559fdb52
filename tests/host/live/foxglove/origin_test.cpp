#include "host/live/foxglove/origin.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace astro::foxglove {
namespace {

TEST(Origin, ProgramsFoxgloveAndThisComputerMayConnect) {
  for (const char* origin :
       {"", "https://app.foxglove.dev", "https://studio.foxglove.dev", "http://localhost",
        "http://localhost:8080", "https://127.0.0.1:1", "http://[::1]:65535"})
    EXPECT_TRUE(origin_is_allowed(origin, {})) << origin;
}

TEST(Origin, OtherPagesMayNot) {
  for (const char* origin :
       {"null", "file://", "http://app.foxglove.dev", "https://app.foxglove.dev.evil.com", "https://evil.com",
        "https://evil.com/https://app.foxglove.dev", "http://localhost.evil.com",
        "http://localhost:80.evil.com", "http://localhost:", "http://127.0.0.1.evil.com", "http://127.0.0.10",
        "localhost", "ftp://localhost", "https://app.foxglove.dev:444", "http://localhost@evil.com",
        "http://localhost:808080"})
    EXPECT_FALSE(origin_is_allowed(origin, {})) << origin;
}

TEST(Origin, ThoseThatSomebodyAllowsMay) {
  const std::vector<std::string> allowed{"https://viewer.example:8443", "file://"};
  EXPECT_TRUE(origin_is_allowed("https://viewer.example:8443", allowed));
  EXPECT_TRUE(origin_is_allowed("file://", allowed));
  EXPECT_FALSE(origin_is_allowed("https://viewer.example", allowed));
}

TEST(Origin, IsASchemeAndAHostWithoutAPath) {
  for (const char* origin : {"https://viewer.example:8443", "http://[fe80::1]:80", "file://", "null"})
    EXPECT_TRUE(is_origin(origin)) << origin;
  for (const char* word :
       {"", "foo", "viewer.example", "https://", "://x", "https://viewer.example/", "https://a b"})
    EXPECT_FALSE(is_origin(word)) << word;
}

TEST(Origin, NothingThatAShellWouldObeyIsProposed) {
  for (const char* origin : {"https://viewer.example:8443", "http://[fe80::1]:80", "file://"})
    EXPECT_TRUE(origin_can_be_proposed(origin)) << origin;
  for (const std::string& origin :
       {std::string("https://x'; touch /tmp/pwned; '"), std::string("https://x y"),
        std::string("https://$(x)"), std::string("https://x\ty"), std::string("null"), std::string(),
        "https://" + std::string(100, 'a')})
    EXPECT_FALSE(origin_can_be_proposed(origin)) << origin;
}

}  // namespace
}  // namespace astro::foxglove
