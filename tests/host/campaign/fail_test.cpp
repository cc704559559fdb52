#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>

#include "tests/host/campaign/place.hpp"

// Each system call that changes something fails in turn, and each place that allocates memory gets none: the
// program says so in one sentence and ends with an error, or ends well and has done all of its work. Nothing
// is lost, and the robot is at rest. The ordinary tests take a few of them; ASTRO_FAILURES=100000 takes all.
namespace astro::campaign {
namespace {

using support::Harm;
using support::Outcome;
using support::TracedOutcome;

std::size_t failures_each() {
  const char* const text = std::getenv("ASTRO_FAILURES");
  return text == nullptr ? 4 : std::strtoul(text, nullptr, 10);
}

constexpr unsigned kFailSeed = 20261122;

/// One sentence at the end of stderr, and a code that says that it did not work.
void expect_told(int code, const std::string& err) {
  EXPECT_GT(code, 0);
  EXPECT_LT(code, 128) << "it crashed or hung";
  const std::size_t end = err.find_last_not_of('\n');
  const std::size_t begin = end == std::string::npos ? 0 : err.rfind('\n', end);
  const std::string last = err.substr(begin == std::string::npos || begin == 0 ? 0 : begin + 1);
  EXPECT_THAT(last, testing::StartsWith("astrolabe: "));
  EXPECT_THAT(last, testing::Not(testing::HasSubstr("should not have happened")));
}

void expect_told_or_done(const Scenario& disturbed, const Place& place, int code, const std::string& err) {
  if (code != 0) expect_told(code, err);
  expect_old_or_new(disturbed, place, code == 0);
}

class Fails : public testing::TestWithParam<std::string> {};

TEST_P(Fails, ACallOfTheSystemAndIsToldAndLosesNothing) {
  if (!support::can_trace()) GTEST_SKIP() << "this system lets no program trace its child";
  const Scenario& disturbed = scenario(GetParam());
  const std::size_t calls = reference(disturbed).calls.size();
  std::size_t hits = 0, told = 0;
  for (const std::size_t at : spread(failures_each(), calls, kFailSeed)) {
    const Place place;
    disturbed.prepare(place);
    const TracedOutcome outcome =
        support::run_traced(disturbed.command(place), place.folder(), {Harm::fails, at});
    SCOPED_TRACE(testing::Message() << disturbed.name << ", call " << at << " of " << calls
                                    << " failed: " << outcome.calls.back() << '\n'
                                    << outcome.err);
    hits += outcome.was_hit ? 1 : 0;
    told += outcome.code != 0 ? 1 : 0;
    expect_told_or_done(disturbed, place, outcome.code, outcome.err);
    if (HasFailure()) break;
  }
  std::printf("%s: %zu of %zu calls failed, %zu told\n", disturbed.name.c_str(), hits, calls, told);
  EXPECT_GT(hits, 0U);
}

Words with_malloc(const char* wish, const std::string& value, const std::string& hit, const Words& command) {
  Words words{"/usr/bin/env", std::string("LD_PRELOAD=") + FAILING_MALLOC, std::string(wish) + "=" + value,
              "ASTRO_MALLOC_HIT=" + hit};
  words.insert(words.end(), command.begin(), command.end());
  return words;
}

Words places_that_allocate(const Scenario& disturbed) {
  const Place place;
  disturbed.prepare(place);
  const Outcome outcome = run(
      with_malloc("ASTRO_MALLOC_LIST", place.path("places"), place.path("hit"), disturbed.command(place)));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  std::ifstream file(place.path("places"));
  Words places;
  for (std::string line; std::getline(file, line);) places.push_back(line);
  return places;
}

TEST_P(Fails, ToGetMemoryAndIsToldAndLosesNothing) {
  const Scenario& disturbed = scenario(GetParam());
  const Words places = places_that_allocate(disturbed);
  ASSERT_GT(places.size(), 50U) << "the allocations are not seen";
  std::size_t hits = 0, told = 0;
  for (const std::size_t at : spread(failures_each(), places.size(), kFailSeed)) {
    const Place place;
    disturbed.prepare(place);
    const Outcome outcome =
        run(with_malloc("ASTRO_MALLOC_FAIL", places[at - 1], place.path("hit"), disturbed.command(place)));
    SCOPED_TRACE(testing::Message() << disturbed.name << ", no memory at place " << at << " of "
                                    << places.size() << " (ASTRO_MALLOC_FAIL=" << places[at - 1] << ")\n"
                                    << outcome.err);
    hits += std::filesystem::exists(place.path("hit")) ? 1 : 0;
    told += outcome.code != 0 ? 1 : 0;
    expect_told_or_done(disturbed, place, outcome.code, outcome.err);
    if (HasFailure()) break;
  }
  std::printf("%s: no memory at %zu of %zu places, %zu told\n", disturbed.name.c_str(), hits, places.size(),
              told);
  EXPECT_GT(hits, 0U);
}

INSTANTIATE_TEST_SUITE_P(All, Fails, testing::Values("upload", "record", "record_programme", "umbmark"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace astro::campaign
