#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "host/robot/port/open_transport.hpp"
#include "tests/support/links/fake_robot.hpp"

namespace astro::test {

/// What becomes of one frame on the way.
enum class Fate { arrives, lost, corrupted, twice, link_drops };

/// A FakeRobot at the other end of a line in virtual time: reading is what makes time pass.
class FakeLink : public robot::Transport {
 public:
  FakeRobot robot;

  // What a test may set.
  std::function<Fate(bool to_robot, std::uint8_t message_id)> fate = [](bool, std::uint8_t) {
    return Fate::arrives;
  };
  int drop_at_frame = -1;         // this frame, counted from 0 in both directions, and the link is gone
  bool restarts_on_drop = false;  // the robot loses power with the link
  microseconds stays_away{0};     // after a drop, before reopen() succeeds
  microseconds delay{0};          // from the robot to us, beyond the tick of the next read
  std::int64_t rate = 1;  // of the robot's clock against ours, beyond 1: a simulator in fast motion ...
  std::uint64_t waits_after_us = 0;  // ... that stops its clock this long after a request; 0: does not
  int frames = 0, reopened = 0;

  void write(std::span<const std::uint8_t> bytes) override {
    if (gone_) lose();
    Bytes frame(bytes.begin(), bytes.end());
    carry(frame, true, [&](const Bytes& arrived) { answer(robot.receive(arrived)); });
    if (gone_) lose();
  }

  std::size_t read(std::span<std::uint8_t> into, microseconds timeout) override {
    const microseconds deadline = now_ + timeout;
    while (true) {
      if (gone_) lose();
      land();
      if (!arrived_.empty()) break;
      if (now_ >= deadline) return 0;
      tick();
    }
    const std::size_t size = std::min(into.size(), arrived_.size());
    std::copy_n(arrived_.begin(), size, into.begin());
    arrived_.erase(arrived_.begin(), arrived_.begin() + static_cast<std::ptrdiff_t>(size));
    return size;
  }

  microseconds now() const override { return now_; }
  const std::string& name() const override { return name_; }

  void reopen(microseconds timeout) override {
    const microseconds deadline = now_ + timeout;
    ++reopened;
    arrived_.clear();
    under_way_.clear();
    while (gone_ && now_ < std::min(deadline, back_at_)) tick();
    if (gone_ && now_ < back_at_) throw Error("there is no port fake0", robot::PortProblem::absent, {name_});
    gone_ = false;
  }

  void drop() {
    gone_ = true;
    back_at_ = now_ + stays_away;
    if (restarts_on_drop) robot.restart();
  }

 private:
  using Bytes = FakeRobot::Bytes;
  std::string name_ = "fake0";
  microseconds now_{1'000'000};
  microseconds back_at_{0};
  bool gone_ = false;
  std::deque<std::pair<microseconds, Bytes>> under_way_;
  std::deque<std::uint8_t> arrived_;

  [[noreturn]] void lose() { throw robot::LinkLost("lost fake0: it was unplugged"); }

  void tick() {
    const bool waits = waits_after_us != 0 && robot.device_us - robot.last_request_us >= waits_after_us;
    now_ += microseconds(waits ? 1000 : std::max<std::int64_t>(1, 1000 / rate));
    if (!waits) answer(robot.tick());
  }

  void answer(const std::vector<Bytes>& out) {
    for (const Bytes& frame : out) {
      carry(frame, false, [&](const Bytes& bytes) { under_way_.emplace_back(now_ + delay, bytes); });
    }
  }

  void land() {
    for (; !under_way_.empty() && under_way_.front().first <= now_; under_way_.pop_front()) {
      const Bytes& bytes = under_way_.front().second;
      arrived_.insert(arrived_.end(), bytes.begin(), bytes.end());
    }
  }

  static std::uint8_t message_id(const Bytes& frame) {
    protocol::Framer framer;
    for (const std::uint8_t byte : frame) {
      if (const auto body = framer.push(byte)) return body->front();
    }
    return 0;
  }

  template <class Deliver>
  void carry(Bytes frame, bool to_robot, Deliver deliver) {
    if (gone_) return;
    const std::uint8_t id = message_id(frame);
    if (id == 0) return deliver(frame);  // not a frame: a delimiter
    const Fate what = frames++ == drop_at_frame ? Fate::link_drops : fate(to_robot, id);
    if (what == Fate::link_drops) return drop();
    if (what == Fate::lost) return;
    if (what == Fate::corrupted) frame[frame.size() / 2] ^= 0x10;
    deliver(frame);
    if (what == Fate::twice) deliver(frame);
  }
};

}  // namespace astro::test
