#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host/robot/port/transport.hpp"

namespace astro::test {

/// Something at a port that answers each write with bytes of a test's choice, in virtual time.
class ScriptedTransport : public robot::Transport {
 public:
  using Bytes = std::vector<std::uint8_t>;
  using Answer = std::function<Bytes(std::span<const std::uint8_t>)>;

  explicit ScriptedTransport(Answer answer) : answer_(std::move(answer)) {}

  void write(std::span<const std::uint8_t> bytes) override {
    const Bytes more = answer_(bytes);
    waiting_.insert(waiting_.end(), more.begin(), more.end());
  }
  std::size_t read(std::span<std::uint8_t> into, microseconds timeout) override {
    if (waiting_.empty()) now_ += timeout;
    const std::size_t size = std::min(into.size(), waiting_.size());
    std::copy_n(waiting_.begin(), size, into.begin());
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(size));
    return size;
  }
  microseconds now() const override { return now_; }
  void reopen(microseconds) override { waiting_.clear(); }
  const std::string& name() const override { return name_; }

 private:
  Answer answer_;
  Bytes waiting_;
  std::string name_ = "port0";
  microseconds now_{0};
};

}  // namespace astro::test
