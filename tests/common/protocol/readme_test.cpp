#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "tests/common/protocol/readme_text.hpp"
#include "tests/support/base/places.hpp"

namespace astro::protocol {
namespace {

TEST(ProtocolReadme, DescribesTheSchemaAsItIs) {
  std::ifstream in(support::checkout() / "common/protocol/README.md");
  const std::string readme{std::istreambuf_iterator<char>(in), {}};
  ASSERT_NE(with_generated_part(readme), "") << "README.md is missing or has lost its marker lines";
  EXPECT_TRUE(readme == with_generated_part(readme))
      << "run: build/host/bin/protocol_readme common/protocol/README.md";
}

TEST(ProtocolReadme, NoticesAWordThatDiffersFromTheSchema) {
  const std::string readme = with_generated_part(
      "a\n<!-- generated from the schema: begin -->\n<!-- generated from the schema: end -->\nb\n");
  ASSERT_NE(readme, "");
  std::string edited = readme;
  edited.replace(edited.find("2^-40 m"), 7, "2^-32 m");
  EXPECT_NE(edited, with_generated_part(edited));
  EXPECT_EQ(readme, with_generated_part(edited));
}

}  // namespace
}  // namespace astro::protocol
