#include <gmock/gmock.h>

#include <cstdlib>
#include <thread>

#include "tests/host/campaign/place.hpp"
#include "tests/support/base/thorough.hpp"
#include "tests/target/firmware_file.hpp"

// SIGKILL at a system call of every command that writes. What it leaves behind is old or new, or says by its
// name that it is unfinished; the robot's outputs are off; the same command again does the work.
// ASTRO_KILLS=40 ASTRO_SEED=7 kills each command so often, at other calls, in place of twice.
namespace astro::campaign {
namespace {

using support::Harm;
using support::Interference;
using support::TracedOutcome;

unsigned number_in(const char* variable, unsigned otherwise) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? otherwise : static_cast<unsigned>(std::strtoul(text, nullptr, 10));
}

unsigned kill_seed() { return number_in("ASTRO_SEED", 20261122); }

/// How often each command is killed; one that makes fewer calls is killed at each of them.
std::size_t kills_each() { return number_in("ASTRO_KILLS", 2); }

class Killed : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!support::can_trace()) GTEST_SKIP() << "this system lets no program trace its child";
  }
};

TEST_P(Killed, LeavesOldOrNewAndARobotAtRestAndCanBeRepeated) {
  const Scenario& disturbed = scenario(GetParam());
  const std::size_t calls = reference(disturbed).calls.size();
  const unsigned seed = kill_seed();
  std::size_t hits = 0;
  for (const std::size_t at : spread(kills_each(), calls, seed)) {
    const Harm harm = (at + seed) % 2 == 0 ? Harm::killed_amid : Harm::killed_before;
    const Place place;
    disturbed.prepare(place);
    const TracedOutcome outcome = support::run_traced(disturbed.command(place), place.folder(), {harm, at});
    SCOPED_TRACE(testing::Message() << disturbed.name << " killed "
                                    << (harm == Harm::killed_amid ? "amid" : "before") << " call " << at
                                    << " of " << calls << ": " << outcome.calls.back()
                                    << "; ASTRO_SEED=" << seed);
    // It may make fewer calls this time. And a traced program on a busy machine may keep the robot waiting for so long that
    // it stops by itself, as it should.
    const bool kept_waiting = outcome.err.find("command_timeout") != std::string::npos;
    EXPECT_TRUE(outcome.was_hit || outcome.code == 0 || kept_waiting) << outcome.err;
    hits += outcome.was_hit ? 1 : 0;
    expect_old_or_new(disturbed, place, outcome.code == 0);
    expect_repeatable(disturbed, place);
    if (HasFailure()) break;
  }
  std::printf("%s: %zu kills over %zu calls, seed %u\n", disturbed.name.c_str(), hits, calls, seed);
  EXPECT_GT(hits, 0U);
}

std::vector<std::string> names() {
  std::vector<std::string> list;
  for (const Scenario& each : scenarios()) list.push_back(each.name);
  return list;
}

INSTANTIATE_TEST_SUITE_P(All, Killed, testing::ValuesIn(names()),
                         [](const auto& test) { return test.param; });

struct FlashLife {
  TracedOutcome robot;
  std::string acknowledged;
};

// The robot's side: the program that plays the robot dies while it keeps its flash in a file.
class FlashFile : public Killed {
 protected:
  Words robot(const test::TemporaryFolder& folder) const {
    Words words = GetParam() == "simulator" ? Words{ASTROLABE_PROGRAM, "sim", "--fast"}
                                            : Words{ASTROLABE_EMULATOR_PROGRAM, target::kImage, "--fast"};
    for (const auto& [option, file] : {std::pair{"--pty", "robot"}, {"--flash", "flash"}}) {
      words.emplace_back(option);
      words.push_back((folder.path() / file).string());
    }
    return words;
  }
  std::string factors_of(const test::TemporaryFolder& folder) const;
  FlashLife live(const test::TemporaryFolder& folder, Interference interference) const;
};

/// False if the robot's program has ended before.
bool is_there(const test::TemporaryFolder& folder, int robot_pid) {
  const auto port = folder.path() / "robot";
  support::eventually([&] { return std::filesystem::exists(port) || kill(robot_pid, 0) != 0; });
  return std::filesystem::exists(port) && kill(robot_pid, 0) == 0;
}

std::string FlashFile::factors_of(const test::TemporaryFolder& folder) const {
  // One that was killed has left the name of its terminal behind.
  std::filesystem::remove(folder.path() / "robot");
  const support::Program again(robot(folder));
  const std::string port = (folder.path() / "robot").string();
  support::Outcome outcome;
  support::eventually([&] {
    outcome = support::astrolabe({"params", "get", "c_R", "c_L", "kp", "--port", port});
    return outcome.code == 0;
  });
  return outcome.out;
}

constexpr const char* kDefaultFactors = "c_R=1\nc_L=1\nkp=60\n";
constexpr const char* kFirstFactors = "c_R=1.001\nc_L=0.999\nkp=50\n";
constexpr const char* kSecondFactors = "c_R=1.002\nc_L=0.998\nkp=55\n";

/// Sets the first factors, then the second, while the robot's program is being killed; returns which are
/// acknowledged.
const char* set_both(const test::TemporaryFolder& folder, int robot_pid) {
  if (!is_there(folder, robot_pid)) return kDefaultFactors;
  const auto set = [&](const Words& values) {
    Words words{"params", "set", "--yes", "--port", (folder.path() / "robot").string()};
    words.insert(words.end(), values.begin(), values.end());
    return support::astrolabe(words).code == 0;
  };
  if (!set({"c_R=1.001", "c_L=0.999", "kp=50"})) return kDefaultFactors;
  return set({"c_R=1.002", "c_L=0.998", "kp=55"}) ? kSecondFactors : kFirstFactors;
}

/// One that is told to set both, and is ended then if it has not been killed before.
FlashLife FlashFile::live(const test::TemporaryFolder& folder, Interference interference) const {
  FlashLife life;
  std::thread host;
  support::TraceHooks hooks;
  hooks.counts = [](const std::string& call) { return call.find("/flash") != std::string::npos; };
  hooks.started = [&](int pid) {
    host = std::thread([&life, &folder, pid] {
      life.acknowledged = set_both(folder, pid);
      kill(pid, SIGTERM);
    });
  };
  life.robot = support::run_traced(robot(folder), folder.path().string(), interference, hooks);
  host.join();
  return life;
}

TEST_P(FlashFile, HoldsOneOfTheSetsAndAllThatWasAcknowledged) {
  if (GetParam() == "emulator" && !support::thorough()) GTEST_SKIP() << support::kLeftToThorough;
  std::size_t calls = 0;
  {
    const test::TemporaryFolder folder;
    const FlashLife undisturbed = live(folder, {});
    ASSERT_EQ(undisturbed.acknowledged, kSecondFactors) << undisturbed.robot.err;
    EXPECT_EQ(factors_of(folder), kSecondFactors);
    calls = undisturbed.robot.calls.size();
    ASSERT_GE(calls, 3U) << "it opens, writes and renames";
  }
  const unsigned seed = kill_seed();
  std::size_t hits = 0;
  for (const std::size_t at : spread((kills_each() + 1) / 2, calls, seed)) {
    for (const Harm harm : {Harm::killed_before, Harm::killed_amid}) {
      const test::TemporaryFolder folder;
      const FlashLife life = live(folder, {harm, at});
      SCOPED_TRACE(testing::Message()
                   << "killed at call " << at << " of " << calls << ": " << life.robot.calls.back());
      hits += life.robot.was_hit ? 1 : 0;
      // What was under way when it died was acknowledged to nobody, and may have come through or
      // not.
      const std::string now = factors_of(folder);
      const bool is_next =
          life.acknowledged == kDefaultFactors ? now == kFirstFactors : now == kSecondFactors;
      EXPECT_TRUE(now == life.acknowledged || (life.acknowledged != kSecondFactors && is_next))
          << "acknowledged " << life.acknowledged << "found " << now;
    }
    if (HasFailure()) break;
  }
  std::printf("%s --flash: %zu kills over %zu calls, seed %u\n", GetParam().c_str(), hits, calls, seed);
  EXPECT_GT(hits, 0U);
}

INSTANTIATE_TEST_SUITE_P(OfThe, FlashFile, testing::Values("simulator", "emulator"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace astro::campaign
