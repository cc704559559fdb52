// The host's side of the link: a robot whose answers are the input, put into good frames under the request's
// id.
#include <algorithm>

#include "common/protocol/frame.hpp"
#include "common/protocol/messages.hpp"
#include "host/robot/client/client.hpp"
#include "host/robot/parameters/parameters.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {
namespace {

/// Each request is answered by the next piece of the input: a length, then a body whose request id becomes
/// that of the request unless its length has the highest bit set; then it is sent as it is.
class Stranger : public robot::Transport {
 public:
  explicit Stranger(ByteView input) : input_(input) {}

  void write(std::span<const std::uint8_t> bytes) override {
    for (const std::uint8_t byte : bytes)
      if (const auto body = framer_.push(byte)) answer(protocol::peek(*body)->request_id);
  }
  std::size_t read(std::span<std::uint8_t> into, microseconds timeout) override {
    if (out_.empty()) now_ += timeout;
    if (out_.empty() && input_.empty() && ++silences_ > 50) throw robot::LinkLost("the input has ended");
    const std::size_t size = std::min(into.size(), out_.size());
    std::copy_n(out_.begin(), size, into.begin());
    out_.erase(out_.begin(), out_.begin() + static_cast<std::ptrdiff_t>(size));
    return size;
  }
  microseconds now() const override { return now_; }
  void reopen(microseconds) override {}
  const std::string& name() const override { return name_; }

 private:
  void answer(std::uint16_t request_id) {
    if (input_.empty()) return;
    const std::uint8_t head = input_[0];
    const std::size_t size = std::min<std::size_t>(head & 0x7FU, input_.size() - 1);
    Bytes body(input_.begin() + 1, input_.begin() + 1 + static_cast<std::ptrdiff_t>(size));
    input_ = input_.subspan(1 + size);
    if ((head & 0x80U) == 0 && body.size() >= protocol::kHeaderSize) {
      body[1] = static_cast<std::uint8_t>(request_id);
      body[2] = static_cast<std::uint8_t>(request_id >> 8U);
    }
    std::array<std::uint8_t, protocol::kMaxFrame> frame{};
    const std::size_t framed = protocol::encode_frame(body, frame);
    out_.insert(out_.end(), frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(framed));
  }

  ByteView input_;
  protocol::Framer framer_;
  Bytes out_;
  microseconds now_{0};
  int silences_ = 0;
  std::string name_ = "stranger";
};

template <protocol::Message M>
void append_answer(Bytes& to, const M& message) {
  std::array<std::uint8_t, protocol::kMaxBody> body{};
  const std::size_t size = protocol::encode(message, 1, body);
  to.push_back(static_cast<std::uint8_t>(size));
  to.insert(to.end(), body.begin(), body.begin() + static_cast<std::ptrdiff_t>(size));
}

}  // namespace

void take(ByteView input) {
  Stranger stranger(input);
  robot::Client client(stranger);
  try {
    client.connect({std::chrono::milliseconds(100), 2});
    auto parameters = robot::RemoteParameters::fetch(client);
    for (const robot::ParameterRow& row : parameters.rows()) {
      const robot::Value value = parameters.value(row.name);
      robot::describe(row, value);
      parameters.stage(row.name, value);
    }
    client.request(protocol::GetStatus{});
    client.request(protocol::GetFaultLog{});
    client.request(protocol::GetFaults{});
    client.pump(std::chrono::seconds(1));
  } catch (const Error&) {
  }
}

std::vector<Bytes> seeds() {
  Bytes answers;
  protocol::HelloReply hello;
  hello.parameter_count = 2;
  append_answer(answers, hello);
  for (int i = 0; i < 2; ++i) {
    append_answer(answers, protocol::ParameterInfo{});
    append_answer(answers, protocol::ParameterValue{});
  }
  for (int i = 0; i < 2; ++i) append_answer(answers, protocol::Ack{});
  append_answer(answers, protocol::Status{});
  append_answer(answers, protocol::FaultLogEntry{});
  append_answer(answers, protocol::FaultReport{});
  append_answer(answers, protocol::Pong{});
  std::vector<Bytes> all{answers};
  protocol::Events::visit([&]<protocol::Message M>() {
    Bytes one = answers;
    append_answer(one, M{});
    one[answers.size()] |= 0x80U;
    one[answers.size() + 2] = one[answers.size() + 3] = 0;
    all.push_back(std::move(one));
  });
  return all;
}

}  // namespace astro::fuzz
