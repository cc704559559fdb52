// What a VRPN server sends by TCP and in datagrams, and what a client sends to ours.
#include <algorithm>

#include "host/base/error.hpp"
#include "host/truth/live/vrpn_stream.hpp"
#include "host/truth/source/floor_track.hpp"
#include "host/truth/trackers/vrpn_tracker.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {
namespace {

using namespace truth;  // NOLINT(google-build-using-namespace): this file is all truth

/// Number of poses, and the complaint, of a stream that arrives in pieces.
std::pair<std::size_t, std::string> read(ByteView input, std::size_t piece) {
  VrpnStream stream("ASTRO");
  FloorTrack track(UpAxis::z);
  std::size_t count = 0;
  std::string complaint;
  try {
    for (std::size_t at = 0; at < input.size(); at += piece)
      stream.push(input.subspan(at, std::min(piece, input.size() - at)), 0);
  } catch (const Error& error) {
    complaint = error.what();
  }
  for (const Sighting& sighting : stream.take()) {
    ++count;
    const recording::TruthSample sample = track.take(sighting.stamp.sender_us, sighting.pose);
    require(!sample.valid || sample.x_m * sample.x_m < 1e9, "a valid sample is at a possible place");
  }
  require(count == 0 || stream.why_silent().empty(), "a body that was seen is not silent");
  return {count, complaint};
}

}  // namespace

void take(ByteView input) {
  require(read(input, input.size()) == read(input, 7), "the pieces in which bytes arrive make no difference");
  try {
    std::size_t bytes = 0;
    for (const vrpn::Message& message : vrpn::messages_in(input))
      bytes += vrpn::kHeaderBytes + message.payload.size();
    require(bytes <= input.size(), "messages are no longer than their datagram");
  } catch (const Error&) {
  }
}

std::vector<Bytes> seeds() {
  Bytes stream = vrpn::cookie(), datagram;
  vrpn::append_description(stream, vrpn::kSenderDescription, 1, "ASTRO", 0);
  vrpn::append_description(stream, vrpn::kTypeDescription, 2, vrpn::kPoseType, 0);
  const Bytes payload = vrpn::payload_of({0, {1, 2, 0.2, 0, 0, 0.6, 0.8}});
  for (std::int64_t i = 0; i < 3; ++i) vrpn::append(stream, {10'000 * i, 1, 2, 0, payload});
  for (std::int64_t i = 0; i < 3; ++i) vrpn::append(datagram, {10'000 * i, 1, 2, 0, payload});
  return {stream, datagram};
}

}  // namespace astro::fuzz
