#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/robot/client/client.hpp"
#include "host/robot/sharing/relay.hpp"
#include "tests/support/links/fake_robot.hpp"

namespace astro::test {

/// A FakeRobot or another robot, a relay and the programs at it, in one virtual time: whoever reads makes it pass.
class RelayRig {
 public:
  using Bytes = FakeRobot::Bytes;

  RelayRig() = default;
  RelayRig(const RelayRig&) = delete;
  RelayRig& operator=(const RelayRig&) = delete;

  FakeRobot robot;
  // The robot behind the relay: the frames that it sends because of these bytes, and in its next millisecond.
  std::function<std::vector<Bytes>(const Bytes&)> receive = [this](const Bytes& bytes) {
    return robot.receive(bytes);
  };
  std::function<std::vector<Bytes>()> tick = [this] { return robot.tick(); };
  robot::Relay relay;
  std::vector<protocol::Header> at_robot;  // of all requests, in the order in which they came
  // Whether a frame arrives; asked for each.
  std::function<bool(bool to_robot, const protocol::Header&)> arrives = [](bool, const protocol::Header&) {
    return true;
  };
  microseconds now{1'000'000};

  /// One millisecond.
  void step() {
    now += std::chrono::milliseconds(1);
    to_relay(tick());
    relay.tick(now);
    carry();
  }
  void run(microseconds duration) {
    for (const microseconds end = now + duration; now < end;) step();
  }

  /// What waits in the relay goes to the robot, and its answers to the relay.
  void carry() {
    while (!relay.to_robot().empty()) {
      const auto bytes = relay.to_robot().front();
      const Bytes frame(bytes.begin(), bytes.end());
      relay.to_robot().taken(frame.size());
      const protocol::Header header = header_of(frame);
      if (!arrives(true, header)) continue;
      at_robot.push_back(header);
      to_relay(receive(frame));
    }
  }

  static protocol::Header header_of(const Bytes& frame) {
    protocol::Framer framer;
    for (const std::uint8_t byte : frame)
      if (const auto body = framer.push(byte)) return *protocol::peek(*body);
    return {};
  }

  /// How often a request came to the robot.
  long count(std::uint8_t message) const {
    return std::count_if(at_robot.begin(), at_robot.end(),
                         [&](const protocol::Header& h) { return h.message_id == message; });
  }

 private:
  void to_relay(const std::vector<Bytes>& frames) {
    for (const Bytes& frame : frames)
      if (arrives(false, header_of(frame))) relay.from_robot(frame, now);
  }
};

/// A program's way through the relay.
class RelayedTransport : public robot::Transport {
 public:
  RelayedTransport(RelayRig& rig, robot::PortUser user, bool greets = true)
      : rig_(rig), id_(rig.relay.join(std::move(user), greets)) {}

  void write(std::span<const std::uint8_t> bytes) override {
    rig_.relay.from_session(id_, bytes, rig_.now);
    rig_.carry();
  }
  std::size_t read(std::span<std::uint8_t> into, microseconds timeout) override {
    const microseconds deadline = rig_.now + timeout;
    while (rig_.relay.to_session(id_).empty() && rig_.now < deadline) rig_.step();
    const auto waiting = rig_.relay.to_session(id_).front();
    const std::size_t size = std::min(into.size(), waiting.size());
    std::copy_n(waiting.begin(), size, into.begin());
    if (size > 0) rig_.relay.to_session(id_).taken(size);
    return size;
  }
  microseconds now() const override { return rig_.now; }
  void reopen(microseconds) override { throw Error("this port is not opened again"); }
  const std::string& name() const override { return name_; }

  robot::SessionId id() const { return id_; }

 private:
  RelayRig& rig_;
  robot::SessionId id_;
  std::string name_ = "port0";
};

/// A program at the port: says Hello at once.
struct RelayedProgram {
  RelayedProgram(RelayRig& rig, std::uint32_t pid, const std::string& command)
      : transport(rig, {pid, command}), client(transport), rig_(rig) {
    client.connect();
  }
  ~RelayedProgram() { leave(); }
  RelayedProgram(const RelayedProgram&) = delete;
  RelayedProgram& operator=(const RelayedProgram&) = delete;

  /// Its connection ends, as when it is killed.
  void leave() { rig_.relay.leave(transport.id()); }
  robot::SessionId id() const { return transport.id(); }
  /// A request on its way, without waiting for the answer.
  template <protocol::Message M>
  void send(const M& message, std::uint16_t id) {
    transport.write(protocol::Frame(message, id).bytes());
  }

  RelayedTransport transport;
  robot::Client client;

 private:
  RelayRig& rig_;
};

}  // namespace astro::test
