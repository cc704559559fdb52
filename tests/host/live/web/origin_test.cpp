#include "host/live/web/origin.hpp"

#include <gtest/gtest.h>

namespace astro::web {
namespace {

TEST(Host, AddressesAndLocalhostAreOurs) {
  for (const char* host : {"localhost", "localhost:8770", "127.0.0.1:8770", "127.0.0.1", "[::1]:8770",
                           "[::1]", "192.168.1.7:9000", "[fe80::1]:80"})
    EXPECT_TRUE(host_is_ours(host)) << host;
}

TEST(Host, NamesMayBeAnybodys) {
  for (const char* host : {"", "evil.com", "evil.com:8770", "localhost.evil.com:8770", "127.0.0.1.evil.com",
                           "robot", "localhost:", "localhost:80:80", "127.0.0.1:x", "[::1", "[::1]x",
                           "[evil.com]:80", "localhost@evil.com", "127.0.0.1 evil.com"})
    EXPECT_FALSE(host_is_ours(host)) << host;
}

TEST(SameOrigin, IsThatOfTheServerByTheNameThatThePageCallsIt) {
  EXPECT_TRUE(is_same_origin("http://127.0.0.1:8770", "127.0.0.1:8770"));
  EXPECT_TRUE(is_same_origin("http://localhost:8770", "localhost:8770"));
  for (const char* origin : {"http://localhost:8888", "http://127.0.0.1", "https://localhost:8770", "null",
                             "file://", "http://evil.com", "http://localhost:8770.evil.com"})
    EXPECT_FALSE(is_same_origin(origin, "localhost:8770")) << origin;
  EXPECT_FALSE(is_same_origin("http://", ""));
}

}  // namespace
}  // namespace astro::web
