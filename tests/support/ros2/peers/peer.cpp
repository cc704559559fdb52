#include "tests/support/ros2/peers/peer.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <map>
#include <sstream>

namespace astro::support {
namespace {

using std::chrono::steady_clock;
using Words = std::istringstream;

void print(const std::string& line) {
  std::puts(line.c_str());
  std::fflush(stdout);
}

/// Lines of standard input; waits for none of them.
class Lines {
 public:
  bool ended() const { return ended_; }
  std::optional<std::string> next(int wait_ms) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (text_.find('\n') == std::string::npos && poll(&input, 1, wait_ms) > 0) {
      char buffer[4096];
      const ssize_t size = read(STDIN_FILENO, buffer, sizeof buffer);
      if (size <= 0) ended_ = true;
      if (size > 0) text_.append(buffer, static_cast<std::size_t>(size));
    }
    const std::size_t end = text_.find('\n');
    if (end == std::string::npos) return std::nullopt;
    std::string line = text_.substr(0, end);
    text_.erase(0, end + 1);
    return line;
  }

 private:
  std::string text_;
  bool ended_ = false;
};

class Session {
 public:
  explicit Session(Peer& peer) : peer_(peer) {}

  int run() {
    print("ready");
    while (!lines_.ended() && !quit_) {
      if (const auto line = lines_.next(1)) obey(*line);
      take();
    }
    return 0;
  }

 private:
  template <class T = std::string>
  static T next(Words& words, T otherwise = {}) {
    T value;
    return words >> value ? value : otherwise;
  }

  void obey(const std::string& line) {
    Words words(line);
    const std::string verb = next(words);
    const std::map<std::string, std::function<void(Words&)>> verbs{
        {"sub", [&](Words& rest) { subscribe(rest); }},
        {"writers", [&](Words& rest) { writers(rest); }},
        {"participants", [&](Words&) { participants(); }},
        {"twist", [&](Words& rest) { publish(rest, false); }},
        {"twist_stamped", [&](Words& rest) { publish(rest, true); }},
        {"drive", [&](Words& rest) { drive(rest); }},
        {"pose", [&](Words& rest) { pose(rest); }},
        {"call", [&](Words& rest) { call(rest); }},
        {"get", [&](Words& rest) { get(rest); }},
        {"set", [&](Words& rest) { set(rest); }},
        {"list", [&](Words& rest) { list(rest); }},
        {"describe", [&](Words& rest) { describe(rest); }},
        {"quit", [&](Words&) { quit_ = true; }}};
    const auto found = verbs.find(verb);
    if (found == verbs.end()) return print("error there is no command '" + verb + "'");
    found->second(words);
  }

  void take() {
    peer_.take([](const std::string& topic, const std::string& kind, const std::string& text) {
      print(fmt::format("got {} {} {}", topic, kind, text));
    });
  }
  void subscribe(Words& words) {
    const std::string topic = next(words), kind = next(words), how = next(words);
    if (!peer_.subscribe(topic, kind, how == "latched"))
      return print("error there is no type '" + kind + "'");
    print("subscribed " + topic);
  }
  void writers(Words& words) {
    const std::string topic = next(words);
    for (const std::string& writer : peer_.writers_of(topic))
      print(fmt::format("writer {} {}", topic, writer));
    print("writers " + topic);
  }
  void participants() {
    for (const std::string& each : peer_.participants()) print("participant " + each);
    print("participants");
  }
  bool send(const std::string& topic, bool stamped, double v, double w, double age_s) {
    using std::chrono::system_clock;
    if (!stamped) return peer_.twist(topic, v, w);
    const std::int64_t now_ns = std::chrono::nanoseconds(system_clock::now().time_since_epoch()).count();
    return peer_.twist_stamped(topic, v, w, now_ns - static_cast<std::int64_t>(1e9 * age_s));
  }
  static void sent(const std::string& topic, bool success) {
    print(success ? "sent " + topic : "error nobody reads " + topic);
  }
  void publish(Words& words, bool stamped) {
    const std::string topic = next(words);
    const double v = next<double>(words), w = next<double>(words), age_s = next<double>(words);
    sent(topic, send(topic, stamped, v, w, age_s));
  }
  /// At 20 Hz, with what comes printed meanwhile.
  void drive(Words& words) {
    const std::string topic = next(words);
    const bool stamped = next(words) == "twist_stamped";
    const double v = next<double>(words), w = next<double>(words), seconds = next<double>(words);
    bool success = send(topic, stamped, v, w, 0);
    const auto end = steady_clock::now() + std::chrono::duration<double>(seconds);
    while (success && steady_clock::now() < end) {
      take();
      poll(nullptr, 0, 50);
      success = send(topic, stamped, v, w, 0);
    }
    sent(topic, success);
  }
  void pose(Words& words) {
    const std::string topic = next(words);
    const double x = next<double>(words), y = next<double>(words), heading = next<double>(words);
    sent(topic, peer_.pose(topic, next(words, std::string("map")), x, y, heading));
  }

  static void answer(const std::string& what, const std::string& name, const std::optional<Answer>& answer) {
    if (!answer) return print(fmt::format("error no answer from {}", name));
    print(fmt::format("{} {} {} {}", what, name, answer->success ? "yes" : "no", answer->text));
  }
  void call(Words& words) {
    const std::string service = next(words), data = next(words);
    answer("reply", service, data.empty() ? peer_.trigger(service) : peer_.set_bool(service, data == "true"));
  }
  void get(Words& words) {
    const std::string node = next(words), name = next(words);
    answer("value", name, peer_.get(node, name));
  }
  void set(Words& words) {
    const std::string node = next(words), name = next(words), value = next(words);
    answer("set", name, peer_.set(node, name, value));
  }
  void list(Words& words) {
    const std::string node = next(words);
    const auto depth = next<std::uint64_t>(words);
    answer("names", node, peer_.list(node, next(words), depth));
  }
  void describe(Words& words) {
    const std::string node = next(words), name = next(words);
    answer("described", name, peer_.describe(node, name));
  }

  Peer& peer_;
  Lines lines_;
  bool quit_ = false;
};

}  // namespace

int run(Peer& peer) { return Session(peer).run(); }

}  // namespace astro::support
