#include "host/truth/live/natnet_stream.hpp"

#include <algorithm>

#include "host/truth/natnet/frame.hpp"

namespace astro::truth {
namespace {

constexpr natnet::Version kOldest{3, 0};

std::string list_of(const natnet::BodyNames& names) {
  constexpr std::size_t kMostShown = 20;
  std::string list;
  std::size_t shown = 0;
  for (const auto& [id, name] : names) {
    if (shown == kMostShown) return list + " and " + std::to_string(names.size() - shown) + " more";
    list += (shown++ == 0 ? "'" : ", '") + name + "'";
  }
  return list;
}

}  // namespace

void NatNetStream::push(ByteView datagram, std::int64_t arrival_us) {
  const auto packet = natnet::packet_in(datagram);
  if (!packet) return;
  if (packet->id == natnet::Id::server_info) {
    if (auto info = natnet::server_info_in(packet->payload)) server_ = std::move(info);
    needs_names_ = names_.empty();
  } else if (packet->id == natnet::Id::models && server_) {
    if (auto names = natnet::body_names_in(packet->payload, server_->version)) {
      names_ = std::move(*names);
      needs_names_ = false;
    }
  } else if (packet->id == natnet::Id::frame && server_ && server_->version >= kOldest) {
    take_frame(packet->payload, arrival_us);
  }
}

void NatNetStream::take_frame(ByteView payload, std::int64_t arrival_us) {
  const auto frame = natnet::frame_in(payload, server_->version);
  if (!frame) return;
  frames_ = true;
  needs_names_ = needs_names_ || frame->models_changed;
  in_frames_.clear();
  bool sighted = false;
  for (const natnet::RigidBody& body : frame->bodies) {
    in_frames_.push_back(body.id);
    const auto name = names_.find(body.id);
    if (name == names_.end()) {
      needs_names_ = true;
      continue;
    }
    if (body_.empty()) body_ = name->second;
    if (name->second != body_ || sighted) continue;  // a frame has one pose of a body
    sighted = true;
    seen_ = true;
    sightings_.push(
        {{natnet::exposed_us(*frame, server_->ticks_per_s), arrival_us}, body.pose, body.tracked});
  }
}

std::vector<std::string> NatNetStream::bodies() const {
  std::vector<std::string> bodies;
  for (const std::int32_t id : in_frames_)
    if (const auto name = names_.find(id); name != names_.end()) bodies.push_back(name->second);
  std::sort(bodies.begin(), bodies.end());
  return bodies;
}

std::string NatNetStream::why_silent() const {
  if (seen_) return "";
  if (!server_) return "it has not answered as a NatNet server";
  const auto [major, minor] = server_->version;
  if (server_->version < kOldest)
    return "it speaks NatNet " + std::to_string(major) + "." + std::to_string(minor) +
           ", and 3.0 is the oldest version that is read";
  if (!frames_) return server_->application + " has answered but sends no frames";
  if (names_.empty()) return server_->application + " tracks no rigid body";
  const bool known =
      std::any_of(names_.begin(), names_.end(), [&](const auto& one) { return one.second == body_; });
  if (!known && !body_.empty()) return "it knows no '" + body_ + "'; it tracks " + list_of(names_);
  return "it knows " + list_of(names_) + " but sends no pose of it";
}

}  // namespace astro::truth
