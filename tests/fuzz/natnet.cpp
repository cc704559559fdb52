// Datagrams of a NatNet server, in every version: frames, models and the server's facts.
#include "host/truth/source/floor_track.hpp"
#include "host/truth/trackers/natnet_frame.hpp"
#include "host/truth/trackers/natnet_models.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {

using namespace truth;  // NOLINT(google-build-using-namespace): this file is all truth

void take(ByteView input) {
  const auto packet = natnet::packet_in(input);
  if (!packet) return;
  require(packet->payload.size() + 4 <= input.size(), "a packet is no longer than its datagram");
  natnet::server_info_in(packet->payload);
  for (const natnet::Version version : {natnet::Version{3, 0}, {4, 0}, {4, 1}, {4, 3}}) {
    FloorTrack track(UpAxis::y);
    if (const auto frame = natnet::frame_in(packet->payload, version)) {
      require(38 * frame->bodies.size() <= packet->payload.size(), "each body has its bytes");
      for (const natnet::RigidBody& body : frame->bodies)
        track.take(natnet::exposed_us(*frame, frame->sent_ticks), body.pose, body.tracked);
    }
    if (const auto names = natnet::body_names_in(packet->payload, version))
      require(names->size() <= packet->payload.size(), "each name has its bytes");
  }
}

std::vector<Bytes> seeds() {
  natnet::Frame frame;
  frame.bodies = {{1, {1, 0, 2, 0, 0, 0, 1}, true}, {2, {}, false}};
  std::vector<Bytes> seeds{
      natnet::connect_request(),
      natnet::datagram_of(natnet::Id::server_info, natnet::payload_of(natnet::ServerInfo{}))};
  for (const natnet::Version version : {natnet::Version{3, 0}, {4, 1}}) {
    seeds.push_back(natnet::datagram_of(natnet::Id::frame, natnet::payload_of(frame, version)));
    seeds.push_back(natnet::datagram_of(natnet::Id::models,
                                        natnet::payload_of(natnet::BodyNames{{1, "ASTRO"}}, version)));
  }
  return seeds;
}

}  // namespace astro::fuzz
