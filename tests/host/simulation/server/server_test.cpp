#include "host/simulation/server/server.hpp"

#include <gmock/gmock.h>
#include <poll.h>

#include <array>
#include <atomic>
#include <fstream>
#include <optional>
#include <thread>
#include <utility>

#include "common/safety/fault.hpp"
#include "host/base/error.hpp"
#include "host/base/file_problem.hpp"
#include "host/robot/client/client.hpp"
#include "host/robot/motion/drive.hpp"
#include "host/robot/motion/paths.hpp"
#include "host/robot/port/open_transport.hpp"
#include "host/simulation/server/pty.hpp"
#include "host/truth/live/socket_source.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::simulation {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;
using support::Tells;

/// A server on a thread of its own, and a host at its pty.
class Served {
 public:
  explicit Served(bool fast)
      : server_(sim::Config(), MocapConfig(), {folder_.path() / "robot.pty", {}, fast}),
        thread_([this] { server_.run([this] { return stop_.load(); }); }) {}
  ~Served() {
    stop_ = true;
    thread_.join();
  }
  std::string port() const { return folder_.path() / "robot.pty"; }
  std::filesystem::path folder() const { return folder_.path(); }

 private:
  test::TemporaryFolder folder_;
  std::atomic<bool> stop_ = false;
  Server server_;
  std::thread thread_;
};

struct Host {
  explicit Host(const Served& served) : client(robot::open_transport(served.port())) { client.connect(); }
  std::uint64_t device_us() { return client.request(protocol::Ping{}).device_time_us; }
  robot::Client client;
};

std::int64_t us_since(steady_clock::time_point begin) {
  return std::chrono::duration_cast<std::chrono::microseconds>(steady_clock::now() - begin).count();
}

// Measured from the robot's start, because a server that a busy machine held up may catch up with what it has missed since.
TEST(Server, InRealTimeNeverRunsAheadOfTheWallClock) {
  const auto start = steady_clock::now();
  const Served served(false);
  Host host(served);
  std::uint64_t now_us = host.device_us();
  for (const std::uint64_t first_us = now_us; now_us - first_us < 300'000; now_us = host.device_us()) {
    // Without any requests, because each request may cause an early step as its answer.
    for (const auto begin = steady_clock::now(); steady_clock::now() - begin < milliseconds(400);)
      ::poll(nullptr, 0, 5);
  }
  constexpr std::int64_t kTwoWords_us = 2 * 1000;
  EXPECT_LE(static_cast<std::int64_t>(now_us), us_since(start) + kTwoWords_us);
}

TEST(Server, InRealTimeNeverRunsAheadForAHostThatSpeaksOften) {
  const auto start = steady_clock::now();
  const Served served(false);
  Host host(served);
  std::uint64_t now_us = 0;
  int words = 0;
  for (const auto begin = steady_clock::now(); steady_clock::now() - begin < milliseconds(400); ++words)
    now_us = host.device_us();
  constexpr std::int64_t kTwoSteps_us = 2 * 1000;
  EXPECT_LE(static_cast<std::int64_t>(now_us), us_since(start) + kTwoSteps_us) << words << " words";
}

/// Stores a byte that it receives in its flash after some time, and then acknowledges it.
class Keeper : public astro::simulation::ServedRobot {
 public:
  void step() override {
    ++now_ms_;
    if (now_ms_ != keeps_at_ms_) return;
    kept_[0] = heard_;
    answer_ = heard_;
  }
  std::uint64_t now_us() override { return now_ms_ * 1000; }
  std::size_t room(int) override { return 1; }
  void write(int, std::span<const std::uint8_t> bytes) override {
    heard_ = bytes[0];
    keeps_at_ms_ = now_ms_ + 45;
  }
  std::size_t read(int, std::span<std::uint8_t> into) override {
    if (answer_ == 0) return 0;
    into[0] = std::exchange(answer_, std::uint8_t{0});
    return 1;
  }
  std::vector<recording::TruthSample> take_truth() override { return {}; }
  std::span<const std::uint8_t> flash() override { return kept_; }

 private:
  std::uint64_t now_ms_ = 0, keeps_at_ms_ = 0;
  std::uint8_t heard_ = 0, answer_ = 0;
  std::array<std::uint8_t, 4096> kept_{};
};

TEST(Server, HasTheFlashInItsFileBeforeTheHostHearsThatItIsKept) {
  const test::TemporaryFolder folder;
  const auto pty = folder.path() / "robot.pty", flash = folder.path() / "flash";
  Server server(std::make_unique<Keeper>(), {pty, flash});
  std::atomic<bool> stop = false;
  std::thread thread([&] { server.run([&] { return stop.load(); }); });
  const auto host = robot::open_transport(pty);
  for (const std::uint8_t byte : {std::uint8_t{'a'}, std::uint8_t{'b'}, std::uint8_t{'c'}}) {
    host->write(std::array{byte});
    std::array<std::uint8_t, 1> answer{};
    EXPECT_EQ(host->read(answer, seconds(10)), 1U);
    EXPECT_EQ(answer[0], byte);
    std::ifstream file(flash, std::ios::binary);  // at once, because the power may fail now
    EXPECT_EQ(file.get(), byte);
  }
  stop = true;
  thread.join();
}

/// Drives for ever, and remembers when each of its steps was made.
class Driving : public astro::simulation::ServedRobot {
 public:
  void step() override {
    const auto now = steady_clock::now();
    const auto gap = now - std::exchange(stepped_at_, now);
    if (++now_ms_ > 1) longest_gap_ = std::max<steady_clock::duration>(longest_gap_, gap);
    has_waited = longest_gap_.load() > milliseconds(900);
  }
  std::uint64_t now_us() override { return now_ms_ * 1000; }
  bool drives() override { return true; }
  std::size_t room(int) override { return 1; }
  void write(int, std::span<const std::uint8_t>) override { heard = true; }
  std::size_t read(int, std::span<std::uint8_t>) override { return 0; }
  std::vector<recording::TruthSample> take_truth() override { return {}; }
  std::span<const std::uint8_t> flash() override { return {}; }

  std::atomic<bool> heard = false, has_waited = false;

 private:
  std::uint64_t now_ms_ = 0;
  steady_clock::time_point stepped_at_{};
  std::atomic<steady_clock::duration> longest_gap_{};
};

// The bound below is one that a busy machine only moves further away.
TEST(Server, InRealTimeWaitsForADriverThatIsLateButNotForEver) {
  const test::TemporaryFolder folder;
  auto owned = std::make_unique<Driving>();
  const Driving& robot = *owned;
  Server server(std::move(owned), {folder.path() / "robot.pty"});
  std::atomic<bool> stop = false;
  std::thread thread([&] { server.run([&] { return stop.load(); }); });
  const auto host = robot::open_transport(folder.path() / "robot.pty");
  host->write(std::array{std::uint8_t{'a'}});
  while (!robot.heard) ::poll(nullptr, 0, 1);
  const auto end = steady_clock::now() + seconds(60);  // only a failure waits so long
  while (!robot.has_waited && steady_clock::now() < end) ::poll(nullptr, 0, 5);
  EXPECT_TRUE(robot.has_waited) << "its time stood still, and went on";
  stop = true;
  thread.join();
}

/// Its host gives voltages. Counts the milliseconds since it last heard of its host.
class Regulated : public Driving {
 public:
  bool is_regulated() override { return true; }
  void step() override {
    Driving::step();
    ++silent_ms;
  }
  void write(int port, std::span<const std::uint8_t> bytes) override {
    Driving::write(port, bytes);
    silent_ms = 0;
  }
  std::atomic<int> silent_ms = 1'000'000;
};

// Else the voltage that the host finds right meets another robot than the one it has seen.
TEST(Server, InFastMotionWaitsForAHostThatRegulatesVoltages) {
  const test::TemporaryFolder folder;
  auto owned = std::make_unique<Regulated>();
  const Regulated& robot = *owned;
  ServerConfig config{folder.path() / "robot.pty"};
  config.fast = true;
  Server server(std::move(owned), config);
  std::atomic<bool> stop = false;
  std::thread thread([&] { server.run([&] { return stop.load(); }); });
  const auto host = robot::open_transport(folder.path() / "robot.pty");
  host->write(std::array{std::uint8_t{'a'}});
  const auto end = steady_clock::now() + seconds(60);  // only a failure waits so long
  while ((!robot.heard || robot.silent_ms < 30) && steady_clock::now() < end) ::poll(nullptr, 0, 1);
  ::poll(nullptr, 0, 100);  // time for a thousand more, were it not to wait ten seconds
  EXPECT_GE(robot.silent_ms, 30);
  EXPECT_LE(robot.silent_ms, 32);
  stop = true;
  thread.join();
}

Remark refusal(const std::filesystem::path& flash) {
  const test::TemporaryFolder folder;
  return support::told_by([&] {
    const Server server(std::make_unique<Keeper>(), {folder.path() / "robot.pty", flash});
  });
}

TEST(Server, RefusesAFlashFileThatItCannotWriteBeforeAnyRobotRuns) {
  const test::TemporaryFolder folder;
  const auto flash = folder.path() / "flash";
  std::filesystem::create_directory(folder.path() / "flash.part");
  EXPECT_THAT(refusal(flash), Tells(FileProblem::unwritable, flash.string() + ".part"));
  EXPECT_THAT(refusal("/proc/robot.flash"), Tells(FileProblem::unwritable, "/proc/robot.flash.part"))
      << "where nobody makes a file";
  std::filesystem::remove(folder.path() / "flash.part");
  EXPECT_EQ(refusal(flash).sentence, "");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "flash.part")) << "the trial leaves nothing";
}

TEST(Server, InFastMotionRunsAheadOfAHostThatKeepsUp) {
  const Served served(true);
  Host host(served);
  host.client.request(protocol::SetTelemetry{10, protocol::Telemetry::kPose});
  const auto wall = steady_clock::now();
  robot::DriveSession drive(host.client);
  const std::uint64_t start_us = host.device_us();
  drive.run(robot::line(10, {0.5, 0}));  // 21 s of the robot's time
  const double virtual_s = static_cast<double>(host.device_us() - start_us) / 1e6;
  const double wall_s = std::chrono::duration<double>(steady_clock::now() - wall).count();
  EXPECT_GT(virtual_s, 20);
  EXPECT_GT(virtual_s, 3 * wall_s) << virtual_s << " s in " << wall_s
                                   << " s";  // by hundreds where nothing else runs
}

TEST(Server, InFastMotionStillNoticesAHostThatFallsSilent) {
  const Served served(true);
  truth::SocketSource cameras(truth::mocap_socket_of(served.port()));
  {
    Host host(served);
    host.client.request(protocol::Arm{});
    host.client.request(robot::line(100, {0.2, 0}).front());
  }  // disconnected without Disarm
  // The robot's own time-out and the ramp after it take 0.6 s of its time: three camera seconds are enough.
  std::size_t seen = 0;
  const auto end = steady_clock::now() + seconds(30);
  while (seen < 180 && steady_clock::now() < end) seen += cameras.poll().size();
  ASSERT_GE(seen, 180U);
  Host second(served);
  EXPECT_EQ(second.client.request(protocol::GetFaults{}).latched, bit(Fault::link_lost));
}

TEST(Server, TheCamerasSeeTheRobotDrive) {
  const Served served(true);
  truth::SocketSource cameras(truth::mocap_socket_of(served.port()));
  Host host(served);
  robot::DriveSession drive(host.client);
  drive.run(robot::line(0.5));
  drive.pump(milliseconds(20));
  const auto samples = cameras.poll();
  ASSERT_GT(samples.size(), 60U);
  const double gone_m =
      std::hypot(samples.back().x_m - samples.front().x_m, samples.back().y_m - samples.front().y_m);
  EXPECT_NEAR(gone_m, 0.5, 0.01);  // wheels of nominal size; slip and camera noise are some millimetres
}

TEST(Server, TakesItsFilesAwayWithIt) {
  std::filesystem::path folder;
  {
    const Served served(true);
    folder = served.folder();
    EXPECT_TRUE(std::filesystem::exists(served.port()));
    EXPECT_TRUE(std::filesystem::exists(served.port() + ".mocap"));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "robot.pty"));
  EXPECT_FALSE(std::filesystem::exists(folder / "robot.pty.mocap"));
}

TEST(Pty, DoesNotReplaceWhatIsNoSimulators) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "precious";
  std::ofstream(path) << "text";
  EXPECT_THAT([&] { Pty{path}; }, support::ThrowsTelling(ServerProblem::path_taken, path.string()));
  EXPECT_EQ(std::filesystem::file_size(path), 4U);
}

TEST(Pty, ReplacesALinkThatLeadsNowhere) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "robot.pty";
  std::filesystem::create_symlink("/dev/pts/no-such", path);
  const Pty pty(path);
  EXPECT_TRUE(std::filesystem::exists(path));
}

TEST(Pty, KnowsWhetherAHostIsThere) {
  const test::TemporaryFolder folder;
  const Pty pty(folder.path() / "robot.pty");
  EXPECT_FALSE(pty.connected());
  std::optional<std::unique_ptr<robot::Transport>> host(robot::open_transport(folder.path() / "robot.pty"));
  EXPECT_TRUE(pty.connected());
  host.reset();
  EXPECT_FALSE(pty.connected());
}

TEST(RuntimeFolder, IsSweptOfWhatDeadSimulatorsLeft) {
  namespace fs = std::filesystem;
  const test::TemporaryFolder runtime, elsewhere;
  const auto in = [&](const char* name) { return runtime.path() / name; };
  const Pty here(in("here.pty"));
  const Pty there(elsewhere.path() / "robot");
  fs::create_symlink(there.link(), in("there.pty"));
  fs::create_symlink("/dev/pts/nobody", in("dead.pty"));
  fs::create_symlink(fs::read_symlink(here.link()),
                     in("reused.pty"));  // the number of a dead simulator that was reused
  fs::create_symlink(elsewhere.path() / "gone", in("gone.pty"));
  fs::create_symlink("/dev/pts/nobody", in("dead.txt"));
  for (const char* name : {"file.pty", "dead.pty.mocap.txt"}) std::ofstream(in(name)) << "kept";
  fs::create_symlink(elsewhere.path() / "gone.mocap", in("gone.pty.mocap"));
  sweep_dead_links(runtime.path());
  std::vector<std::string> left;
  for (const auto& entry : fs::directory_iterator(runtime.path())) left.push_back(entry.path().filename());
  EXPECT_THAT(left, testing::UnorderedElementsAre("here.pty", "there.pty", "dead.txt", "file.pty",
                                                  "dead.pty.mocap.txt"));
  sweep_dead_links(elsewhere.path() / "no such folder");
}

TEST(Flash, ThatIsALinkIsRefusedAndNothingIsWrittenThroughOne) {
  namespace fs = std::filesystem;
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "precious") << "kept";
  fs::create_symlink(folder.path() / "precious", folder.path() / "flash");
  fs::create_symlink(folder.path() / "nothing", folder.path() / "dangling");
  for (const char* name : {"flash", "dangling"})
    EXPECT_THAT([&] { load_flash(folder.path() / name); },
                support::ThrowsTelling(ServerProblem::flash_is_link, (folder.path() / name).string()));
}

TEST(Server, ARobotIsWhereItsParametersAreOrElseWhereItIs) {
  const test::TemporaryFolder folder;
  const auto identity = [&](const char* pty, const char* flash) {
    return sim::identity_of(
        config_of({}, {.pty = folder.path() / pty, .flash = *flash == '\0' ? "" : folder.path() / flash}));
  };
  EXPECT_EQ(identity("a.pty", ""), identity("a.pty", "")) << "started again";
  EXPECT_NE(identity("a.pty", ""), identity("b.pty", ""));
  EXPECT_EQ(identity("a.pty", "flash"), identity("b.pty", "flash")) << "moved to another port";
  EXPECT_NE(identity("a.pty", "flash"), identity("a.pty", "other"));
}

}  // namespace
}  // namespace astro::simulation
