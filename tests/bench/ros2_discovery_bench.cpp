/// How long it takes until the first sample of a node that starts comes to a peer that is there, and the other way round.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "host/ros2/cdr/codec.hpp"
#include "host/ros2/messages/odometry.hpp"
#include "host/ros2/node/node.hpp"
#include "tests/support/ros2/domain.hpp"
#include "tests/support/ros2/peer_program.hpp"

namespace {

using namespace astro;
using namespace astro::ros2;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using support::PeerKind;
using support::PeerProgram;

constexpr double kBar_ms = 1000;
constexpr auto kLongest = std::chrono::seconds(20);

/// A node with the endpoints of a robot, or nearly so many.
class RobotNode {
 public:
  RobotNode() {
    for (const char* name : {"/odom", "/a", "/b", "/c", "/d", "/e", "/f"})
      publishers_.push_back(node_->advertise({name, message_type<msg::Odometry>()}));
    for (const char* name : {"/g", "/h"})
      node_->subscribe({name, message_type<msg::Odometry>()}, [](ByteView) {});
  }
  void publish() {
    publishers_.front()->publish(encode(msg::Odometry{}), 0);
    node_->poll();
    node_->wait(milliseconds(2));
  }

 private:
  std::unique_ptr<Middleware> node_ =
      open_node({{"robot"}, GidSize::iron_and_later}, {support::test_domain()});
  std::vector<std::unique_ptr<Publisher>> publishers_;
};

double milliseconds_until_more(PeerProgram& peer, std::size_t before, RobotNode& node,
                               steady_clock::time_point begin) {
  while (peer.lines("got /odom").size() == before && steady_clock::now() - begin < kLongest) node.publish();
  return std::chrono::duration<double, std::milli>(steady_clock::now() - begin).count();
}

/// Whether all are within the bar.
bool report(const char* what, std::vector<double> times_ms) {
  std::sort(times_ms.begin(), times_ms.end());
  const auto within =
      std::count_if(times_ms.begin(), times_ms.end(), [](double time) { return time <= kBar_ms; });
  fmt::print("{:40} median {:4.0f} ms, longest {:4.0f} ms, {} of {} within {:.0f} ms\n", what,
             times_ms[times_ms.size() / 2], times_ms.back(), within, times_ms.size(), kBar_ms);
  return within == static_cast<std::ptrdiff_t>(times_ms.size());
}

bool node_starts(PeerKind kind, const char* name, int starts) {
  PeerProgram peer(kind, support::test_domain());
  peer.say("sub /odom odometry");
  while (peer.lines("subscribed").empty()) poll(nullptr, 0, 1);
  std::vector<double> times_ms;
  for (int start = 0; start < starts; ++start) {
    const std::size_t before = peer.lines("got /odom").size();
    const auto begin = steady_clock::now();
    RobotNode node;
    times_ms.push_back(milliseconds_until_more(peer, before, node, begin));
  }
  return report(fmt::format("a node starts beside a peer on {}", name).c_str(), times_ms);
}

bool peer_starts(PeerKind kind, const char* name, int starts) {
  RobotNode node;
  std::vector<double> times_ms;
  for (int start = 0; start < starts; ++start) {
    const auto begin = steady_clock::now();
    PeerProgram peer(kind, support::test_domain());
    peer.say("sub /odom odometry");
    times_ms.push_back(milliseconds_until_more(peer, 0, node, begin));
  }
  return report(fmt::format("a peer on {} starts beside a node", name).c_str(), times_ms);
}

}  // namespace

int main(int count, char** arguments) {
  const int starts = count > 1 ? std::atoi(arguments[1]) : 50;
  bool good = true;
  for (const auto& [kind, name] :
       {std::pair{PeerKind::fast, "Fast DDS"}, std::pair{PeerKind::cyclone, "CycloneDDS"}}) {
    if (support::path_of(kind).empty()) continue;
    good = node_starts(kind, name, starts) && good;
    good = peer_starts(kind, name, starts) && good;
  }
  return good ? 0 : 1;
}
