#include "host/simulation/server/network_tracker.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/network.hpp"
#include "host/simulation/server/natnet_server.hpp"
#include "host/simulation/server/vrpn_server.hpp"
#include "host/truth/live/live_source.hpp"
#include "host/truth/live/natnet_link.hpp"
#include "host/truth/live/vrpn_link.hpp"
#include "host/truth/trackers/natnet_packet.hpp"
#include "host/truth/trackers/vrpn_tracker.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::simulation {
namespace {

using net::address_v4;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using support::Tells;
using support::ThrowsTelling;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using truth::LiveProblem;

recording::TruthSample sample_at(double x_m, double theta_rad) {
  recording::TruthSample sample;
  sample.x_m = x_m;
  sample.y_m = -1;
  sample.theta_rad = theta_rad;
  return sample;
}

// ---- frames

TEST(VirtualTracker, ItsFramesHaveThePoseOnTheFloorAndLeaveAfterTheLatency) {
  VirtualTracker tracker({0.03, 0, 1});
  for (int i = 0; i < 100; ++i) tracker.take(10'000 * i, sample_at(0.1 * i, 0.1 * i));
  EXPECT_FALSE(tracker.next(29'999));
  for (int i = 0; i < 100; ++i) {
    const auto frame = tracker.next(30'000 + 10'000 * i);
    ASSERT_TRUE(frame) << i;
    EXPECT_EQ(frame->number, i + 1);
    EXPECT_EQ(frame->exposed_us, 10'000 * i);
    const Pose2 pose = truth::on_floor(frame->pose, truth::UpAxis::z);
    EXPECT_DOUBLE_EQ(pose.x_m, 0.1 * i);
    EXPECT_DOUBLE_EQ(pose.y_m, -1);
    EXPECT_NEAR(std::remainder(pose.theta_rad - 0.1 * i, 2 * M_PI), 0, 1e-12)
        << "the tilt does not change it";
    EXPECT_NEAR(frame->pose.qx * frame->pose.qx + frame->pose.qy * frame->pose.qy +
                    frame->pose.qz * frame->pose.qz + frame->pose.qw * frame->pose.qw,
                1, 1e-12);
    EXPECT_FALSE(tracker.next(30'000 + 10'000 * i));
  }
}

TEST(VirtualTracker, OfItsFramesTheShareThatIsAskedForIsLostButCounted) {
  VirtualTracker tracker({0, 0.1, 5});
  int came = 0;
  std::int32_t last = 0;
  for (int i = 0; i < 10'000; ++i) {
    tracker.take(i, sample_at(0, 0));
    while (const auto frame = tracker.next(i)) ++came, last = frame->number;
  }
  EXPECT_NEAR(came, 9000, 4 * std::sqrt(10'000 * 0.1 * 0.9));  // four standard deviations
  EXPECT_GT(last, 9'950);
}

// ---- clients over loopback, in the tracker's virtual time

/// A tracker with a robot that drives along x at 1 m/s.
struct Lab {
  NetworkTracker tracker;
  microseconds now{1'000'000};
  bool sees = true;

  explicit Lab(const NetworkTrackerConfig& config) : tracker(config) {}
  void pass(microseconds time) {
    for (const microseconds end = now + time; now < end; now += milliseconds(1)) {
      std::vector<recording::TruthSample> seen;
      if (sees && now.count() % 10'000 == 0)
        seen.push_back(sample_at(1e-6 * static_cast<double>(now.count()), 0.5));
      tracker.step(seen);
      tracker.work();
    }
  }
};

/// Time passes at the tracker while its client waits.
class LabLink : public truth::TrackerLink {
 public:
  LabLink(Lab& lab, const truth::TrackerUrl& url) : lab_(lab), link_(truth::open_link(url)) {}
  void work(microseconds now) override { link_->work(now); }
  void wait(microseconds timeout) override {
    lab_.pass(timeout);
    link_->wait(microseconds::zero());
  }
  std::vector<truth::Sighting> take() override { return link_->take(); }
  std::string why_silent() const override { return link_->why_silent(); }
  std::vector<std::string> bodies() const override { return link_->bodies(); }
  const std::string& body() const override { return link_->body(); }
  std::string way() const override { return link_->way(); }
  int connections() const override { return link_->connections(); }

 private:
  Lab& lab_;
  std::unique_ptr<truth::TrackerLink> link_;
};

NetworkTrackerConfig with_vrpn(double latency_s = 0.008, double dropped = 0) {
  NetworkTrackerConfig config;
  config.vrpn_port = 0;
  config.faults = {latency_s, dropped, 3};
  return config;
}

truth::TrackerUrl url_of(const Lab& lab, const std::string& body = "ASTRO") {
  return truth::tracker_url_in("vrpn://127.0.0.1:" + std::to_string(lab.tracker.vrpn()->endpoint().port()) +
                               "/" + body);
}

std::unique_ptr<truth::LiveSource> open(Lab& lab, const truth::TrackerUrl& url) {
  return std::make_unique<truth::LiveSource>(url, std::make_unique<LabLink>(lab, url),
                                             [&lab] { return lab.now; });
}

/// How much later than the exposures the times of two seconds of poses are, at least and at most. The body drives along x at
/// 1 m/s with a heading of 0.5 rad, and a tenth of 200 poses is lost.
std::pair<double, double> lateness_us(Lab& lab, truth::LiveSource& source, double heading_tolerance_rad) {
  source.poll();
  int count = 0;
  double least_us = 1e9, most_us = 0;
  for (int i = 0; i < 100; ++i) {
    lab.pass(milliseconds(20));
    for (const recording::TruthSample& sample : source.poll()) {
      EXPECT_TRUE(sample.valid);
      EXPECT_NEAR(sample.theta_rad, 0.5, heading_tolerance_rad);
      const double late_us = static_cast<double>(sample.time_us) - 1e6 * sample.x_m;
      least_us = std::min(least_us, late_us);
      most_us = std::max(most_us, late_us);
      ++count;
    }
  }
  EXPECT_NEAR(count, 180, 4 * std::sqrt(200 * 0.1 * 0.9));
  return {least_us, most_us};
}

TEST(NetworkTracker, ItsPosesComeToAVrpnClientWithTheTimeOfTheExposure) {
  Lab lab(with_vrpn(0.03, 0.1));
  const auto source = open(lab, url_of(lab));
  EXPECT_THAT(source->description(),
              HasSubstr("over TCP, 100.0 poses per second, times by the tracker's clock"));
  const auto [least_us, most_us] = lateness_us(lab, *source, 1e-12);
  EXPECT_NEAR(most_us, least_us, 1.5) << "the times are those of the exposures, but for a constant";
  EXPECT_NEAR(least_us, 30'000, 21'000) << "the latency, and up to 20 ms until the client looks";
}

TEST(NetworkTracker, ABodyThatItDoesNotKnowIsNamedWithThoseThatItDoes) {
  Lab lab(with_vrpn());
  const truth::TrackerUrl url = url_of(lab, "ROBOT");
  EXPECT_THAT([&] { open(lab, url); }, ThrowsTelling(LiveProblem::tracker_silent, url.place(),
                                                     "it knows no 'ROBOT'; it has described 'ASTRO'"));
}

TEST(NetworkTracker, ABodyThatIsNotSeenIsNamedAsSuch) {
  Lab lab(with_vrpn());
  lab.sees = false;
  const truth::TrackerUrl url = url_of(lab);
  EXPECT_THAT([&] { open(lab, url); }, ThrowsTelling(LiveProblem::tracker_silent, url.place(),
                                                     "it knows 'ASTRO' but sends no pose of it"));
}

TEST(NetworkTracker, WhereNothingListensTheClientSaysSo) {
  Lab lab(NetworkTrackerConfig{});
  net::io_context io;
  const std::uint16_t port = net::listen_tcp(io, {address_v4::loopback(), 0}).local_endpoint().port();
  const auto url = truth::tracker_url_in("vrpn://127.0.0.1:" + std::to_string(port) + "/ASTRO");
  EXPECT_THAT([&] { open(lab, url); },
              ThrowsTelling(LiveProblem::tracker_silent, url.place(),
                            "nothing answers there, neither by TCP nor by a call back"));
}

TEST(NetworkTracker, AClientThatLosesItConnectsAgain) {
  auto lab = std::make_unique<Lab>(with_vrpn());
  const std::uint16_t port = lab->tracker.vrpn()->endpoint().port();
  const truth::TrackerUrl url = url_of(*lab);
  truth::VrpnLink link(url);
  microseconds now{0};
  const auto run = [&](microseconds time) {
    std::size_t came = 0;
    for (const microseconds end = now + time; now < end; now += milliseconds(10)) {
      if (lab) lab->pass(milliseconds(10));
      link.work(now);
      came += link.take().size();
    }
    return came;
  };
  EXPECT_GT(run(milliseconds(500)), 40U);
  lab.reset();
  EXPECT_LT(run(milliseconds(500)), 5U);
  EXPECT_EQ(link.why_silent(), "it has ended the connection");
  NetworkTrackerConfig again = with_vrpn();
  again.vrpn_port = port;
  lab = std::make_unique<Lab>(again);
  EXPECT_GT(run(std::chrono::seconds(6)), 90U);
  EXPECT_EQ(link.connections(), 2);
}

void send_datagram(const Lab& lab, const std::string& request) {
  net::io_context io;
  const auto at = lab.tracker.vrpn()->endpoint();
  net::udp::socket socket = net::bind_udp(io, {at.address(), 0});
  net::send_datagram(socket, as_bytes(request), {at.address(), at.port()});
}

/// A client of the library, which asks by UDP to be called.
TEST(NetworkTracker, ItCallsBackWhoeverAsksByUdp) {
  Lab lab(with_vrpn());
  net::io_context io;
  net::tcp::acceptor listener = net::listen_tcp(io, {address_v4::loopback(), 0});
  send_datagram(lab, "10.1.2.3 " + std::to_string(listener.local_endpoint().port()));
  lab.pass(milliseconds(5));
  auto called = net::accept_tcp(listener);
  ASSERT_TRUE(called) << "at the address that the request came from, not at the one that it names";
  lab.pass(milliseconds(100));
  std::array<std::uint8_t, 4096> buffer{};
  truth::VrpnStream stream("ASTRO");
  while (net::wait_to_read(io, milliseconds(10), called->socket)) {
    stream.push(*net::receive(called->socket, buffer), 0);
    if (stream.senders().size() == 1) break;
  }
  EXPECT_THAT(stream.take(), testing::Not(IsEmpty()));
}

TEST(NetworkTracker, RequestsForNoPortOrAPortOfTheSystemAreIgnored) {
  Lab lab(with_vrpn());
  for (const char* request :
       {"", "127.0.0.1", "127.0.0.1 ", "127.0.0.1 22", "127.0.0.1 99999", "127.0.0.1 -5"})
    send_datagram(lab, request);
  lab.pass(milliseconds(20));
  EXPECT_EQ(lab.tracker.vrpn()->clients(), 0U);
}

/// A client with bytes of its own.
struct RawClient {
  explicit RawClient(Lab& in) : lab(in) {
    socket.connect(lab.tracker.vrpn()->endpoint());
    socket.non_blocking(true);
    lab.pass(milliseconds(5));
  }
  Bytes received() {
    std::array<std::uint8_t, 65536> buffer{};
    Bytes all;
    for (auto bytes = net::receive(socket, buffer); bytes && !bytes->empty();
         bytes = net::receive(socket, buffer))
      append(all, *bytes);
    return all;
  }
  Lab& lab;
  net::io_context io;
  net::tcp::socket socket{io};
};

TEST(NetworkTracker, AnswersPingsAsTheLibrarysClientsExpect) {
  Lab lab(with_vrpn());
  lab.sees = false;
  RawClient client(lab);
  Bytes bytes = truth::vrpn::cookie();
  truth::vrpn::append_description(bytes, truth::vrpn::kSenderDescription, 30, "ASTRO", 0);
  truth::vrpn::append_description(bytes, truth::vrpn::kTypeDescription, 40, "vrpn_Base ping_message", 0);
  truth::vrpn::append(bytes, {0, 30, 40, 0, {}});
  net::send(client.socket, bytes);
  lab.pass(milliseconds(5));
  truth::vrpn::StreamReader reader;
  truth::vrpn::Directory directory;
  reader.push(client.received());
  int pongs = 0;
  while (const auto message = reader.next())
    if (!directory.take(*message) && directory.type(message->type) == "vrpn_Base pong_message" &&
        directory.sender(message->sender) == "ASTRO")
      ++pongs;
  EXPECT_EQ(pongs, 1);
}

TEST(NetworkTracker, ClientsThatSendNonsenseOrDoNotReadAreDisconnectedAndDisturbNobody) {
  Lab lab(with_vrpn());
  const auto source = open(lab, url_of(lab));
  RawClient nonsense(lab), hangs(lab);
  EXPECT_EQ(lab.tracker.vrpn()->clients(), 3U);
  net::send(nonsense.socket, as_bytes("GET / HTTP/1.1\r\n\r\n"));
  source->poll();
  std::size_t came = 0;
  int seconds = 0;
  for (; seconds < 300 && lab.tracker.vrpn()->clients() > 1; ++seconds) {
    lab.pass(std::chrono::seconds(1));
    came += source->poll().size();
  }
  EXPECT_LT(seconds, 300) << "one that does not read has the kernel's buffers and 64 KiB";
  EXPECT_GE(came, static_cast<std::size_t>(99 * seconds));
}

TEST(NetworkTracker, SeventeenClientsAreOneTooMany) {
  Lab lab(with_vrpn());
  std::vector<std::unique_ptr<RawClient>> clients;
  for (int i = 0; i < 20; ++i) clients.push_back(std::make_unique<RawClient>(lab));
  EXPECT_EQ(lab.tracker.vrpn()->clients(), 16U);
}

TEST(NetworkTracker, ListensToThisComputerAlone) {
  Lab lab(with_vrpn());
  const auto at = lab.tracker.vrpn()->endpoint();
  EXPECT_EQ(at.address(), address_v4::loopback());
  EXPECT_THAT(lab.tracker.urls(),
              testing::ElementsAre("vrpn://127.0.0.1:" + std::to_string(at.port()) + "/ASTRO"));
}

TEST(NetworkTracker, APortInUseIsNamed) {
  Lab lab(with_vrpn());
  NetworkTrackerConfig same = with_vrpn();
  same.vrpn_port = lab.tracker.vrpn()->endpoint().port();
  EXPECT_THAT([&] { NetworkTracker{same}; }, ThrowsTelling(net::AddressProblem::port_unusable,
                                                           std::to_string(*same.vrpn_port), "127.0.0.1"));
}

/// With 400 of some 28,000 ports in use, one in seventy servers would find its port taken.
TEST(NetworkTracker, AnyFreePortIsFreeForUdpToo) {
  net::io_context io;
  std::vector<net::udp::socket> taken;
  for (int i = 0; i < 400; ++i) taken.push_back(net::bind_udp(io, {address_v4::loopback(), 0}));
  for (int i = 0; i < 500; ++i) EXPECT_NO_THROW(NetworkTracker{with_vrpn()}) << i;
}

// ---- NatNet

NetworkTrackerConfig with_natnet(truth::natnet::Version version = {4, 1}) {
  NetworkTrackerConfig config;
  config.natnet_port = 0;
  config.natnet_version = version;
  config.natnet_data_port = 0;  // tests run side by side, and only one of them could have port 1511
  config.faults = {0.03, 0.1, 3};
  return config;
}

truth::TrackerUrl natnet_url_of(const Lab& lab, const std::string& body = "/ASTRO") {
  return truth::tracker_url_in(
      "natnet://127.0.0.1:" + std::to_string(lab.tracker.natnet()->endpoint().port()) + body);
}

TEST(NetworkTracker, ItsPosesComeToANatNetClientOfEachVersionWithTheTimeOfTheExposure) {
  for (const truth::natnet::Version version : {truth::natnet::Version{3, 0}, {3, 1}, {4, 0}, {4, 1}}) {
    Lab lab(with_natnet(version));
    const auto source = open(lab, natnet_url_of(lab));
    EXPECT_THAT(source->description(),
                HasSubstr("by UDP, 100.0 poses per second, times by the tracker's clock"));
    const auto [least_us, most_us] = lateness_us(lab, *source, 1e-6);  // NatNet has single precision
    EXPECT_NEAR(most_us, least_us, 1.5) << "positions of some metres are good to 0.2 um";
  }
}

TEST(NetworkTracker, ANatNetClientKeepsItselfKnownAndFindsTheServerAgain) {
  auto lab = std::make_unique<Lab>(with_natnet());
  const truth::TrackerUrl url = natnet_url_of(*lab);
  const std::uint16_t port = lab->tracker.natnet()->endpoint().port();
  truth::NatNetLink link(url);
  microseconds now{0};
  const auto run = [&](microseconds time) {
    std::size_t came = 0;
    for (const microseconds end = now + time; now < end; now += milliseconds(10)) {
      if (lab) lab->pass(milliseconds(10));
      link.work(now);
      came += link.take().size();
    }
    return came;
  };
  EXPECT_GT(run(std::chrono::seconds(20)), 1'600U) << "of 2000, a tenth of which is lost";
  lab.reset();
  EXPECT_LT(run(std::chrono::seconds(5)), 5U);
  EXPECT_EQ(link.why_silent(), "nothing answers there as a NatNet server");
  NetworkTrackerConfig again = with_natnet();
  again.natnet_port = port;
  lab = std::make_unique<Lab>(again);
  EXPECT_GT(run(std::chrono::seconds(5)), 250U);
  EXPECT_EQ(link.connections(), 2);
}

TEST(NetworkTracker, ANatNetClientThatFallsSilentIsDropped) {
  Lab lab(with_natnet());
  {
    truth::NatNetLink link(natnet_url_of(lab));
    link.work(microseconds(0));
    lab.pass(milliseconds(10));
    EXPECT_EQ(lab.tracker.natnet()->clients(), 1U);
  }
  lab.pass(std::chrono::seconds(6));
  EXPECT_EQ(lab.tracker.natnet()->clients(), 0U);
}

TEST(NetworkTracker, ANatNetClientThatWasDroppedWhileNobodyListenedHasTruthBeforeItsRunBegins) {
  Lab lab(with_natnet());
  const auto source = open(lab, natnet_url_of(lab));
  source->poll();
  lab.pass(std::chrono::seconds(7));  // a person is asked something, and nobody serves the link
  EXPECT_EQ(lab.tracker.natnet()->clients(), 0U);
  const microseconds begin = lab.now;
  source->begin_run();
  EXPECT_LE(lab.now - begin, milliseconds(1'500)) << "sooner than the silence of a server is noticed";
  source->poll();
  std::size_t came = 0;
  for (int i = 0; i < 250; ++i) {
    lab.pass(milliseconds(20));
    came += source->poll().size();
  }
  EXPECT_NEAR(static_cast<double>(came), 450, 4 * std::sqrt(500 * 0.1 * 0.9));
}

TEST(NetworkTracker, NoRunBeginsOnceItIsGone) {
  for (const NetworkTrackerConfig& config : {with_natnet(), with_vrpn()}) {
    Lab lab(config);
    const truth::TrackerUrl url = config.natnet_port ? natnet_url_of(lab) : url_of(lab);
    const auto source = open(lab, url);
    lab.pass(milliseconds(100));  // the system keeps these poses
    lab.sees = false;
    lab.pass(milliseconds(100));
    const auto why = config.natnet_port ? Tells(LiveProblem::tracker_silent, url.place(),
                                                "Astrolabe has answered but sends no frames")
                                        : Tells(LiveProblem::poses_ended, url.place(), "ASTRO");
    EXPECT_THAT(support::told_by([&] { source->begin_run(); }), why);
  }
}

TEST(NetworkTracker, ANatNetBodyThatItDoesNotKnowIsNamedWithThoseThatItDoes) {
  Lab lab(with_natnet());
  const truth::TrackerUrl url = natnet_url_of(lab, "/ROBOT");
  EXPECT_THAT([&] { open(lab, url); }, ThrowsTelling(LiveProblem::tracker_silent, url.place(),
                                                     "it knows no 'ROBOT'; it tracks 'ASTRO'"));
  EXPECT_THAT(open(lab, natnet_url_of(lab, ""))->description(), HasSubstr("'ASTRO'")) << "the only one";
}

/// The frames of this server come to the client's other socket, so that the port is no reason for anything.
TEST(NetworkTracker, ThePortForDataIsNotBlamedWhereFramesCome) {
  net::io_context io;
  const net::udp::socket taken = net::bind_udp(io, {address_v4::loopback(), 0});
  NetworkTrackerConfig config = with_natnet();
  config.natnet_data_port = taken.local_endpoint().port();
  Lab lab(config);
  truth::NatNetLink link(natnet_url_of(lab, "/ROBOT"));
  for (microseconds now{0}; now < std::chrono::seconds(2); now += milliseconds(10)) {
    lab.pass(milliseconds(10));
    link.work(now);
  }
  EXPECT_EQ(link.why_silent(), "it knows no 'ROBOT'; it tracks 'ASTRO'");
}

TEST(NetworkTracker, ANatNetServerIgnoresWhoeverHasNotConnectedAndWhatIsNone) {
  Lab lab(with_natnet());
  net::io_context io;
  const net::udp::endpoint server = lab.tracker.natnet()->endpoint();
  net::udp::socket stranger = net::connect_udp(io, server);
  for (const Bytes& datagram :
       {Bytes{}, Bytes{1}, Bytes(200, 0xFF), truth::natnet::datagram_of(truth::natnet::Id::request_models),
        truth::natnet::datagram_of(truth::natnet::Id::keep_alive)})
    net::send_datagram(stranger, datagram, server);
  lab.pass(milliseconds(50));
  EXPECT_EQ(lab.tracker.natnet()->clients(), 0U);
  EXPECT_FALSE(net::wait_to_read(io, milliseconds(1), stranger));
}

}  // namespace
}  // namespace astro::simulation
