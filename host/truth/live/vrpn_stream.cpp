#include "host/truth/live/vrpn_stream.hpp"

#include <algorithm>

#include "host/truth/trackers/vrpn_tracker.hpp"

namespace astro::truth {
namespace {

constexpr std::size_t kMostSenders = 256;

std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t kMostShown = 20;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMostShown); ++i)
    list += (i == 0 ? "'" : ", '") + names[i] + "'";
  if (names.size() > kMostShown) list += " and " + std::to_string(names.size() - kMostShown) + " more";
  return list;
}

}  // namespace

void VrpnStream::push(ByteView bytes, std::int64_t arrival_us) {
  reader_.push(bytes);
  while (const auto message = reader_.next())
    if (!directory_.take(*message)) take_pose(*message, arrival_us);
}

void VrpnStream::take_pose(const vrpn::Message& message, std::int64_t arrival_us) {
  if (directory_.type(message.type) != vrpn::kPoseType) return;
  const std::string_view sender = directory_.sender(message.sender);
  const auto pose = vrpn::pose_in(message.payload);
  if (sender.empty() || !pose || pose->sensor != 0) return;
  if (body_.empty()) body_ = sender;
  // The server may give an id another name before each pose.
  if (senders_.size() < kMostSenders && !senders_.contains(sender)) senders_.emplace(sender);
  seen_ = seen_ || sender == body_;
  if (sender == body_) sightings_.push({{message.time_us, arrival_us}, pose->pose});
}

std::string VrpnStream::why_silent() const {
  if (seen_) return "";
  if (!reader_.greeted()) return "it has not answered as a VRPN server";
  const std::vector<std::string> bodies = directory_.bodies();
  if (bodies.empty()) return "it has described no body";
  if (body_.empty()) return "it has described " + list_of(bodies) + " and sent no pose";
  const bool known = std::find(bodies.begin(), bodies.end(), body_) != bodies.end();
  if (!known) return "it knows no '" + body_ + "'; it has described " + list_of(bodies);
  return "it knows '" + body_ + "' but sends no pose of it" +
         (senders_.empty() ? "" : "; it sends poses of " + list_of(senders()));
}

}  // namespace astro::truth
