#include "host/formats/files/yaml_scalars.hpp"

#include <gmock/gmock.h>

#include <random>

#include "host/base/error.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::bag {
namespace {

using astro::support::measured;
using astro::support::Taken;
using astro::support::ThrowsTelling;
using ::testing::ElementsAre;

std::vector<std::string> paths(std::string_view text) {
  std::vector<std::string> all;
  for (const YamlScalar& scalar : yaml_scalars(text, "x.yaml"))
    all.push_back(scalar.path + "=" + scalar.value);
  return all;
}

TEST(YamlScalars, EachValueHasTheKeysThatLeadToIt) {
  EXPECT_THAT(
      paths("a:\n  b: 1\n  c: [x, {d: 2}, [y, z]]\n  e:\n    - f: 3\n      g: '4'\nh: |\n  text\n  more\n"),
      ElementsAre("a/b=1", "a/c/0=x", "a/c/1/d=2", "a/c/2/0=y", "a/c/2/1=z", "a/e/0/f=3", "a/e/0/g=4",
                  "h=text\nmore\n"));
  EXPECT_THAT(paths("{? [a, b] : c, k: *a, m: &a 1}"), ElementsAre("?/0=a", "?/1=b", "?=c", "m=1"));
  EXPECT_THAT(paths("just text"), ElementsAre("=just text"));
  EXPECT_THAT(paths(""), ElementsAre());
}

TEST(YamlScalars, WhatIsNoYamlIsRefusedWithItsLine) {
  EXPECT_THAT([] { yaml_scalars("a: 1\nb: [1, 2\nc: }", "x.yaml"); },
              ThrowsTelling(YamlProblem::not_yaml, "x.yaml", "3"));
  EXPECT_THAT([] { yaml_scalars(std::string(100, '['), "x.yaml"); },
              ThrowsTelling(YamlProblem::nested_too_deep, "x.yaml", "1"));
}

TEST(YamlScalars, TextThatWouldMultiplyItselfIsBounded) {
  constexpr std::size_t kSize = std::size_t{1} << 20;
  for (const std::string& text :
       {support::filled("a,", kSize).insert(0, "["), support::filled("- - - ", kSize),
        support::filled("[", kSize), support::filled("{a: &x [1], b: *x}\n", kSize),
        support::filled("? ", kSize),
        std::string(kSize / 2, 'k') + ": [" + support::filled("1,", kSize / 2)}) {
    const Taken taken = measured([&] { yaml_scalars(text, "x.yaml"); });
    EXPECT_BOUNDED(taken, text.size());
  }
}

TEST(YamlScalars, RandomDamageNeverHarmsTheReader) {
  constexpr unsigned kSeed = 20240614;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  const std::string seed =
      "a:\n  b: 1.5\n  c: [x, {d: 2}]\n  e:\n    - f: &q \"3\\n\"\n      g: *q\n? [k]\n: >\n  t\n";
  constexpr std::string_view kMarks = "[]{}:,-?&*!|>'\"#%@`\n\t \0\xFF";
  for (int round = 0; round < 3000; ++round) {
    std::string bad = seed;
    for (std::size_t edits = 1 + random() % 6; edits > 0; --edits)
      bad[random() % bad.size()] = kMarks[random() % kMarks.size()];
    try {
      for (const YamlScalar& scalar : yaml_scalars(bad, "x.yaml"))
        EXPECT_LE(scalar.value.size(), 4 * bad.size());
    } catch (const Error&) {
    }
  }
}

}  // namespace
}  // namespace astro::bag
