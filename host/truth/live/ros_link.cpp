#include "host/truth/live/ros_link.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "host/base/blocked_signals.hpp"
#include "host/base/environment.hpp"
#include "host/base/error.hpp"
#include "host/formats/cdr/names.hpp"
#include "host/formats/cdr/type_description.hpp"
#include "host/formats/messages/stamped_pose.hpp"
#include "host/live/dds/fast_dds.hpp"

namespace astro::truth {

namespace dds = dds;
using std::chrono::microseconds;
using std::chrono::milliseconds;

namespace {

constexpr microseconds kLookPeriod = milliseconds(100);
constexpr microseconds kTakeOver = milliseconds(500);  // of silence, until another publisher counts
constexpr int kMostRivals = 5;  // poses that interrupt the publisher's, until it is an error
constexpr std::int64_t kNanosPerMicro = 1000;
constexpr dds::Qos kBestEffort{false, false, 100}, kLatched{true, true, 100}, kNodes{true, true, 0};

const char* kNodesTopic = "ros_discovery_info";
const char* kNodesType = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_";

/// The message type of an endpoint, if it can hold poses.
std::optional<std::string> pose_type_of(const dds::RemoteEndpoint& endpoint) {
  auto type = ros2::ros_type_name(endpoint.type);
  return type && ros2::holds_poses(*type) ? type : std::nullopt;
}

bool are_of_one_participant(const dds::Guid& a, const dds::Guid& b) {
  return std::equal(a.bytes.begin(), a.bytes.begin() + 12, b.bytes.begin());
}

std::string range_in_words(const dds::Discovery& discovery) {
  return fmt::format("in the domain {}{}", discovery.domain,
                     discovery.range == dds::Range::subnet ? "" : " of this computer");
}

}  // namespace

RosLink::RosLink(const TrackerUrl& url)
    : RosLink(url, dds::discovery_from(url.where, environment_variable)) {}

RosLink::RosLink(const TrackerUrl& url, const dds::Discovery& discovery)
    : topic_(url.topic), discovery_(discovery), stream_({url.topic, url.parent, url.body}) {
  const BlockedSignals blocked;
  participant_ = dds::open_fast_dds(discovery_, "ground_truth", "enclave=/;");
  nodes_reader_ = participant_->create_reader({kNodesTopic, kNodesType, kNodes});
}

void RosLink::work(microseconds now) {
  for (const dds::Sample& sample : nodes_reader_->take()) nodes_.take(sample.payload);
  if (now >= look_at_) {
    look_around();
    look_at_ = now + kLookPeriod;
  }
  if (reader_) read(now);
}

/// Reads the topic under a type that somebody publishes. A publisher may have come back with another one.
void RosLink::look_around() {
  others_ = participant_->remote_endpoints();
  std::set<std::string> types;
  for (const dds::RemoteEndpoint& other : others_)
    if (other.writes && other.topic == ros2::wire_name_of_topic(topic_))
      if (const auto type = pose_type_of(other)) types.insert(*type);
  if (!types.empty() && !types.contains(type_)) open_reader(*types.begin());
}

void RosLink::open_reader(const std::string& type) {
  const BlockedSignals blocked;
  type_ = type;
  const std::string type_on_wire = ros2::dds_type_name(type);
  reader_ = participant_->create_reader({ros2::wire_name_of_topic(topic_), type_on_wire, kBestEffort});
  fixed_reader_.reset();
  if (type == ros2::tf_message_type().name)
    fixed_reader_ =
        participant_->create_reader({ros2::wire_name_of_topic(topic_ + "_static"), type_on_wire, kLatched});
}

void RosLink::read(microseconds now) {
  if (fixed_reader_)
    for (const dds::Sample& sample : fixed_reader_->take()) stream_.push_fixed(sample.payload);
  for (const dds::Sample& sample : reader_->take()) {
    stream_.push(type_, sample.payload);
    const std::vector<RosPose> poses = stream_.take();
    if (poses.empty() || !is_from_publisher(sample.id.writer, now)) continue;
    for (const RosPose& pose : poses)
      sightings_.push({{pose.time_ns / kNanosPerMicro, now.count()}, pose.pose});
  }
}

/// A publisher that restarts appears as another one, whose first poses follow the last ones of the old publisher. If poses of
/// two publishers alternate, both are running.
bool RosLink::is_from_publisher(const Guid& writer, microseconds now) {
  if (publisher_ && publisher_ != writer && now - heard_at_ < kTakeOver) {
    if (std::exchange(heard_since_rival_, false)) ++rivals_;
    if (rivals_ < kMostRivals) return false;
    const std::string one = node_of(*publisher_), other = node_of(writer);
    throw Error(fmt::format("the poses of '{}' on {} are of two publishers at once, {} and {}", body(),
                            topic_, one, other),
                TopicProblem::two_publishers, {body(), topic_, one, other});
  }
  if (publisher_ != writer) {
    publisher_ = writer;
    ++connections_;
    rivals_ = 0;
  }
  heard_since_rival_ = true;
  heard_at_ = now;
  return true;
}

std::string RosLink::node_of(const Guid& endpoint) const {
  const std::string name = nodes_.node_of(endpoint.bytes);
  return name.empty() ? "a participant without a node" : "the node " + name;
}

/// "/a (geometry_msgs/msg/PoseStamped)"
std::vector<std::string> RosLink::pose_topics() const {
  std::set<std::string> topics;
  for (const dds::RemoteEndpoint& other : others_)
    if (const auto type = pose_type_of(other); type && other.writes && other.topic.starts_with("rt/"))
      topics.insert(fmt::format("{} ({})", other.topic.substr(2), *type));
  return {topics.begin(), topics.end()};
}

std::string RosLink::why_silent() const {
  if (publisher_) return "";
  const auto published = std::ranges::find_if(others_, [&](const dds::RemoteEndpoint& other) {
    return other.writes && other.topic == ros2::wire_name_of_topic(topic_);
  });
  if (published == others_.end()) {
    const std::vector<std::string> topics = pose_topics();
    const bool here_alone = discovery_.range != dds::Range::subnet && discovery_.peers.empty();
    return fmt::format(
        "nobody publishes {} {}; {}{}", topic_, range_in_words(discovery_),
        topics.empty() ? "there are no topics with poses"
                       : fmt::format("poses are on {}", fmt::join(topics, ", ")),
        here_alone ? "; only this computer is looked at: for others put range=subnet behind the ? of the "
                     "tracker's address, or set ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET"
                   : "");
  }
  if (!reader_)
    return fmt::format("{} is of the type {}, which holds no poses", topic_,
                       ros2::ros_type_name(published->type).value_or(published->type));
  return fmt::format("{} publishes {}, but {}", node_of(published->guid), topic_, stream_.why_silent());
}

std::string RosLink::way() const {
  if (!publisher_) return "over DDS";
  std::string way = fmt::format("as {} in '{}' by {}", type_, stream_.frame(), node_of(*publisher_));
  const bool drives = std::ranges::any_of(others_, [&](const dds::RemoteEndpoint& other) {
    return !other.writes && other.topic.ends_with("/cmd_vel") &&
           are_of_one_participant(other.guid, *publisher_);
  });
  if (drives) return way + ", which also takes /cmd_vel and so may compute them from the robot's own wheels";
  if (type_ != ros2::tf_message_type().name && ros2::may_be_estimate(topic_, type_))
    way += " (by its name or type perhaps an estimate of the robot itself)";
  return way;
}

}  // namespace astro::truth
