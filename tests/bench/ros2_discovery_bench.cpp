/// A node among peers: how long until all topics come to a peer, whether all services answer, and whether the node survives it. On
/// this computer alone; and with the settings of stock nodes, on this and on another one (tests/support/ros2/two_computers.hpp).
///
///   ros2_discovery [starts [first calls]]
#include <fmt/format.h>
#include <sys/prctl.h>

#include <algorithm>
#include <set>

#include "tests/support/ros2/domain.hpp"
#include "tests/support/ros2/peer_program.hpp"
#include "tests/support/ros2/robot_node.hpp"
#include "tests/support/ros2/two_computers.hpp"

namespace {

using namespace astro;
using std::chrono::steady_clock;
using support::PeerKind;
using support::PeerProgram;
using support::RobotNode;
using support::TwoComputers;

constexpr double kBar_ms = 1000;
constexpr double kLongest_ms = 10'000;

double ms_since(steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(steady_clock::now() - begin).count();
}
void sleep_ms(int time_ms) { poll(nullptr, 0, time_ms); }

int be_a_node(const char* domain, const char* range) {
  RobotNode node({std::atoi(domain), dds::range_in(range).value()});
  for (;;) node.step();
}

/// A node in a process of its own, so that it can die alone.
class NodeProgram {
 public:
  explicit NodeProgram(const char* range) {
    const std::string domain = std::to_string(support::test_domain());
    pid_ = fork();
    if (pid_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    execl("/proc/self/exe", "ros2_discovery", "node", domain.c_str(), range, nullptr);
    _exit(127);
  }
  ~NodeProgram() {
    if (!lives()) return;
    end();
  }
  NodeProgram(const NodeProgram&) = delete;
  NodeProgram& operator=(const NodeProgram&) = delete;

  bool lives() {
    if (pid_ > 0 && waitpid(pid_, nullptr, WNOHANG) == pid_) pid_ = -1;
    return pid_ > 0;
  }
  void end() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }

 private:
  pid_t pid_ = -1;
};

struct Place {
  TwoComputers* two;  // nothing: this computer alone
  bool other;         // where the peer is

  const char* range() const { return two == nullptr ? "localhost" : "subnet"; }
  std::string name() const {
    return two == nullptr ? "this computer alone" : other ? "another computer" : "this computer";
  }
  std::unique_ptr<PeerProgram> start(PeerKind kind) const {
    const auto make = [&] {
      return std::make_unique<PeerProgram>(kind, support::test_domain(), two == nullptr ? "" : "subnet");
    };
    return other ? two->on_the_other(make) : make();
  }
};

const char* name_of(PeerKind kind) { return kind == PeerKind::fast ? "Fast DDS" : "CycloneDDS"; }

template <class Condition>
bool until(NodeProgram& node, Condition condition) {
  const auto begin = steady_clock::now();
  while (node.lives() && ms_since(begin) < kLongest_ms) {
    if (condition()) return true;
    sleep_ms(1);
  }
  return false;
}

std::size_t topics_of(PeerProgram& peer) {
  std::set<std::string> topics;
  for (const std::string& line : peer.lines("got ")) topics.insert(line.substr(4, line.find(' ', 4) - 4));
  return topics.size();
}

struct Figures {
  std::size_t aborts = 0, topics = 0, services = 0;
  std::vector<double> times_ms{};
};

void start_once(const Place& place, PeerKind kind, bool node_first, int number, Figures& figures) {
  const int settled_ms = 500 + number * 37 % 200;  // at each phase of its announcements
  std::optional<NodeProgram> node;
  if (node_first) {
    node.emplace(place.range());
    sleep_ms(settled_ms);
  }
  auto begin = steady_clock::now();
  const auto peer = place.start(kind);
  for (const char* topic : RobotNode::kTopics) peer->say(std::string("sub ") + topic + " odometry");
  if (!node_first) {
    while (peer->lines("subscribed").size() < RobotNode::kTopics.size()) sleep_ms(1);
    sleep_ms(settled_ms);
    begin = steady_clock::now();
    node.emplace(place.range());
  }
  until(*node, [&] { return topics_of(*peer) == RobotNode::kTopics.size(); });
  figures.times_ms.push_back(ms_since(begin));
  figures.topics += topics_of(*peer);
  for (const char* service : RobotNode::kServices) peer->say(std::string("call ") + service);
  until(*node, [&] { return peer->lines("reply").size() == RobotNode::kServices.size(); });
  figures.services += peer->lines("reply").size();
  if (!node->lives()) ++figures.aborts;
}

bool discovery(const Place& place, PeerKind kind, bool node_first, std::size_t starts) {
  Figures figures;
  for (std::size_t i = 0; i < starts; ++i) start_once(place, kind, node_first, static_cast<int>(i), figures);
  std::ranges::sort(figures.times_ms);
  const double p95_ms = figures.times_ms[(starts - 1) * 95 / 100];
  const std::size_t topics = starts * RobotNode::kTopics.size(),
                    services = starts * RobotNode::kServices.size();
  fmt::print(
      "{:10} on {:19}, {} first: aborts {}, topics {} of {}, services {} of {}, all topics after {:.0f} ms, "
      "p95 {:.0f} ms, longest {:.0f} ms (bar {:.0f})\n",
      name_of(kind), place.name(), node_first ? "node" : "peer", figures.aborts, figures.topics, topics,
      figures.services, services, figures.times_ms[starts / 2], p95_ms, figures.times_ms.back(), kBar_ms);
  std::fflush(stdout);
  return figures.aborts == 0 && figures.topics == topics && figures.services == services && p95_ms <= kBar_ms;
}

/// Each of a client that has just started, one after the other.
bool first_calls(const Place& place, PeerKind kind, int calls) {
  NodeProgram node(place.range());
  int answered = 0;
  std::string last;
  for (int i = 0; i < calls && node.lives(); ++i) {
    const auto peer = place.start(kind);
    peer->say("call /stop");
    if (!until(node, [&] { return !peer->lines("reply").empty(); })) continue;
    last = peer->lines("reply").front();
    ++answered;
  }
  const std::string expected = fmt::format("reply /stop yes call {}", calls);
  fmt::print("{:10} on {:19}: first calls answered {} of {}, each carried out once: {}\n", name_of(kind),
             place.name(), answered, calls, last == expected ? "yes" : "no, the last is '" + last + "'");
  std::fflush(stdout);
  return answered == calls && last == expected;
}

void print_how_long_a_killed_node_is_seen(const Place& place, PeerKind kind) {
  NodeProgram node(place.range());
  const auto peer = place.start(kind);
  peer->say("sub /odom odometry");
  until(node, [&] { return topics_of(*peer) == 1; });
  node.end();
  const auto begin = steady_clock::now();
  for (bool seen = true; seen && ms_since(begin) < 30'000;) {
    const std::size_t asked = peer->lines("writers").size();
    const std::size_t before = peer->lines("writer /odom").size();
    peer->say("writers /odom");
    while (peer->lines("writers").size() == asked) sleep_ms(1);
    seen = peer->lines("writer /odom").size() > before;
  }
  fmt::print("{:10} on {:19}: sees a node that was killed for {:.1f} s\n", name_of(kind), place.name(),
             ms_since(begin) / 1000);
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 4 && std::string_view(arguments[1]) == "node") return be_a_node(arguments[2], arguments[3]);
  const int starts = count > 1 ? std::atoi(arguments[1]) : 50;
  const int calls = count > 2 ? std::atoi(arguments[2]) : 200;
  support::test_domain();  // its name is of this computer
  bool good = true;
  const auto measure = [&](const Place& place) {
    for (const PeerKind kind : {PeerKind::fast, PeerKind::cyclone}) {
      if (support::path_of(kind).empty()) continue;
      for (const bool node_first : {true, false})
        good = discovery(place, kind, node_first, static_cast<std::size_t>(starts)) && good;
      good = first_calls(place, kind, calls) && good;
      print_how_long_a_killed_node_is_seen(place, kind);
    }
  };
  measure({nullptr, false});
  const auto two = TwoComputers::make();
  if (!two) {
    fmt::print("other computers are left out: network namespaces take root and the command ip\n");
    return good ? 0 : 1;
  }
  measure({two.get(), false});
  measure({two.get(), true});
  return good ? 0 : 1;
}
