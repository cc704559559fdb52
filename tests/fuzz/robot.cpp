// The robot's side of the link: bytes at both ports of the simulated robot, as they are or put into good
// frames.
#include "common/protocol/frame.hpp"
#include "common/protocol/messages.hpp"
#include "host/simulation/robot/virtual_robot.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {
namespace {

/// Each piece: a byte that says where it goes and how (bit 7: to port 1; bit 6: as it is), its length, its
/// bytes. Low bits of the first byte: so many milliseconds pass afterwards.
struct Piece {
  int port = 0;
  bool raw = false;
  int wait_ms = 0;
  ByteView bytes;
};

Piece next(ByteView& input) {
  Piece piece{input[0] >> 7, (input[0] & 0x40) != 0, (input[0] & 0x3F) * 4, {}};
  const std::size_t size = input.size() < 2 ? 0 : std::min<std::size_t>(input[1], input.size() - 2);
  piece.bytes = input.subspan(std::min<std::size_t>(2, input.size()), size);
  input = input.subspan(std::min<std::size_t>(2 + size, input.size()));
  return piece;
}

}  // namespace

void take(ByteView input) {
  simulation::VirtualRobot robot(sim::Config{}, {});
  std::array<std::uint8_t, 8192> out{};
  for (int pieces = 0; !input.empty() && pieces < 40; ++pieces) {
    const Piece piece = next(input);
    std::array<std::uint8_t, protocol::kMaxFrame> frame{};
    const std::size_t size = piece.raw ? 0 : protocol::encode_frame(piece.bytes, frame);
    robot.board().ports().host_write(piece.port, piece.raw ? piece.bytes : ByteView(frame).first(size));
    for (int ms = 0; ms <= piece.wait_ms; ++ms) robot.step();
    for (const int port : {0, 1}) robot.board().ports().host_read(port, out);
  }
}

std::vector<Bytes> seeds() {
  std::vector<Bytes> all;
  Bytes script;
  const auto add = [&]<protocol::Message M>() {
    std::array<std::uint8_t, protocol::kMaxBody> body{};
    const std::size_t size = protocol::encode(M{}, 7, body);
    Bytes one{2, static_cast<std::uint8_t>(size)};
    one.insert(one.end(), body.begin(), body.begin() + static_cast<std::ptrdiff_t>(size));
    script.insert(script.end(), one.begin(), one.end());
    all.push_back(std::move(one));
  };
  protocol::Requests::visit(add);
  all.push_back(std::move(script));
  return all;
}

}  // namespace astro::fuzz
