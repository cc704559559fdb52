// COBS, framer and the codec of every message: what was decoded is encoded to the same bytes.
#include <algorithm>
#include <array>

#include "common/protocol/frame.hpp"
#include "common/protocol/messages.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {
namespace {

using namespace protocol;  // NOLINT(google-build-using-namespace): this file is all messages

template <Message M>
void take_as(ByteView body) {
  const auto message = decode<M>(body);
  if (!message.ok()) return;
  std::array<std::uint8_t, kMaxBody> again{};
  const std::size_t size = encode(*message, peek(body)->request_id, again);
  require(size > 0 && size <= body.size(), "what was decoded can be encoded");
  const auto twice = decode<M>(ByteView(again).first(size));
  require(twice.ok(), "what was encoded can be decoded");
  std::array<std::uint8_t, kMaxBody> third{};
  require(encode(*twice, peek(body)->request_id, third) == size && std::ranges::equal(again, third),
          "a message says the same after a second way through the codec");
}

void take_body(ByteView body) {
  if (!peek(body)) return;
  const auto as = [&]<Message M>() { take_as<M>(body); };
  Requests::visit(as);
  Replies::visit(as);
  Events::visit(as);
}

}  // namespace

void take(ByteView input) {
  Framer framer;
  for (const std::uint8_t byte : input)
    if (const auto body = framer.push(byte)) take_body(*body);
  take_body(input.first(std::min(input.size(), kMaxBody)));
  if (input.size() < kHeaderSize || input.size() > kMaxBody) return;
  std::array<std::uint8_t, kMaxFrame> frame{};
  const std::size_t size = encode_frame(input, frame);
  Framer fresh;
  for (std::size_t i = 0; i + 1 < size; ++i) require(!fresh.push(frame[i]), "no zero inside a frame");
  const auto back = fresh.push(frame[size - 1]);
  require(back && std::ranges::equal(*back, input), "a body comes out of its frame as it went in");
}

std::vector<Bytes> seeds() {
  std::vector<Bytes> all;
  const auto add = [&]<Message M>() {
    const Frame frame(M{}, 7);
    all.emplace_back(frame.bytes().begin(), frame.bytes().end());
    std::array<std::uint8_t, kMaxBody> body{};
    all.emplace_back(body.begin(), body.begin() + static_cast<std::ptrdiff_t>(encode(M{}, 7, body)));
  };
  Requests::visit(add);
  Replies::visit(add);
  Events::visit(add);
  return all;
}

}  // namespace astro::fuzz
