#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/live/dds/participant.hpp"
#include "host/truth/live/tracker_link.hpp"
#include "host/truth/live/tracker_url.hpp"
#include "host/truth/trackers/node_names.hpp"
#include "host/truth/trackers/ros_pose_stream.hpp"

namespace astro::truth {

/// Two nodes publish the same poses. Values: the body, the topic, and both nodes.
enum class TopicProblem { two_publishers };

/// A topic of ROS 2 with the robot's poses, over DDS. Its type is that under which somebody publishes it: PoseStamped,
/// PoseWithCovarianceStamped and TransformStamped of geometry_msgs, nav_msgs/Odometry, or the transforms of tf2_msgs/TFMessage,
/// with the fixed ones of the same topic with "_static" behind its name.
///
/// It subscribes with best effort, which publishers of both reliabilities serve. A lost pose would come too late anyway.
///
/// One publisher at a time: another one takes over once the first has been silent for half a second. work() throws if two
/// publish the same body at once, or if the poses are no ground truth.
class RosLink : public TrackerLink {
 public:
  /// Uses the domain and range that the URL names, or else the environment. Throws astro::Error if these are impossible.
  explicit RosLink(const TrackerUrl& url);
  RosLink(const TrackerUrl& url, const dds::Discovery& discovery);

  void work(std::chrono::microseconds now) override;
  void wait(std::chrono::microseconds timeout) override { participant_->wait(timeout); }
  std::vector<Sighting> take() override { return sightings_.take(); }
  std::string why_silent() const override;
  std::vector<std::string> bodies() const override { return stream_.bodies(); }
  const std::string& body() const override { return stream_.body(); }
  std::string way() const override;
  int connections() const override { return connections_; }

 private:
  using microseconds = std::chrono::microseconds;
  using Guid = dds::Guid;

  void look_around();
  void open_reader(const std::string& type);
  void read(microseconds now);
  bool is_from_publisher(const Guid& writer, microseconds now);
  std::string node_of(const Guid& endpoint) const;
  std::vector<std::string> pose_topics() const;

  std::string topic_;
  dds::Discovery discovery_;
  std::unique_ptr<dds::Participant> participant_;  // before its readers
  std::unique_ptr<dds::Reader> nodes_reader_, reader_, fixed_reader_;
  NodeNames nodes_;
  std::vector<dds::RemoteEndpoint> others_;  // as of the last look
  std::string type_;                         // under which the topic is read; "": not yet
  RosPoseStream stream_;
  Waiting<Sighting> sightings_;
  std::optional<Guid> publisher_;  // whose poses are taken
  microseconds look_at_{}, heard_at_{};
  bool heard_since_rival_ = false;
  int rivals_ = 0;  // how often another one has published between two poses of the publisher
  int connections_ = 0;
};

}  // namespace astro::truth
