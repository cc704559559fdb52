#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "common/protocol/frame.hpp"
#include "tests/common/protocol/body_of.hpp"
#include "tests/host/python/messages_text.hpp"
#include "tests/host/python/schema.hpp"
#include "tests/support/base/places.hpp"

namespace astro::python {
namespace {

constexpr const char* kWriteAgain =
    "run: build/host/bin/python_messages host/python/astrolabe/messages.py tests/host/python/vectors.json";

std::string text_of(const std::string& file) {
  std::ifstream in(support::checkout() / file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::uint8_t> bytes_of(const std::string& hex) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t at = 0; at < hex.size(); at += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(at, 2), nullptr, 16)));
  return bytes;
}

TEST(PythonMessages, AreThoseOfTheSchema) {
  EXPECT_TRUE(text_of("host/python/astrolabe/messages.py") == messages_text()) << kWriteAgain;
}

TEST(PythonMessages, HaveTheVectorsThatThisCodecWrites) {
  EXPECT_TRUE(text_of("tests/host/python/vectors.json") == vectors_text()) << kWriteAgain;
}

/// Python decodes the same bytes to the fields beside them.
TEST(Vectors, AreDecodedAndEncodedToTheSameBytesAgain) {
  const auto table = nlohmann::json::parse(text_of("tests/host/python/vectors.json"));
  std::size_t tried = 0;
  visit_messages([&]<Message M>() {
    for (const auto& vector : table.at("messages")) {
      if (vector.at("message") != M::kName) continue;
      const auto body = bytes_of(vector.at("body"));
      const auto decoded = protocol::decode<M>(body);
      ASSERT_TRUE(decoded.ok()) << vector;
      EXPECT_EQ(tests::body_of(*decoded, vector.at("request_id")), body) << vector;
      ++tried;
    }
  });
  EXPECT_EQ(tried, table.at("messages").size());
}

TEST(Vectors, OfRefusedBodiesAreAllRefused) {
  const auto table = nlohmann::json::parse(text_of("tests/host/python/vectors.json"));
  for (const auto& refused : table.at("refused")) EXPECT_NE(refused.at("error"), "none") << refused;
}

}  // namespace
}  // namespace astro::python
