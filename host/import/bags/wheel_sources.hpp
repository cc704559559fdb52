#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/formats/files/bag.hpp"
#include "host/import/wheels/travel_measure.hpp"

/// Where in a bag the travel of both wheels may be, as far as the names of its topics, types and fields show
/// it.
namespace astro::importing {

struct WheelSource {
  enum class Kind : std::uint8_t {
    joints,    // sensor_msgs/msg/JointState
    fields,    // numbers in messages of any type: two of one topic, or one each of two topics
    odometry,  // nav_msgs/msg/Odometry of the robot itself
  };
  struct Place {
    std::string topic, field;  // field: "" unless the kind is fields
    bool operator==(const Place&) const = default;
  };

  Kind kind = Kind::joints;
  Place left, right;
  std::optional<TravelMeasure> measure;  // of fields whose names show it

  /// As a person may name it: "/joint_states", "/sensor_state:left_encoder,right_encoder", "/lwheel,/rwheel".
  std::string name() const;
};

/// What the messages of a topic are made of; null if neither the bag nor this program knows.
std::shared_ptr<const ros2::MessageLayout> layout_of(const bag::BagTopic& topic);

/// All sources in topics with messages: first joints, then travel, then speeds, then odometry. Odometry whose
/// name says that a tracker or a filter published it is none.
std::vector<WheelSource> wheel_sources(std::span<const bag::BagTopic> topics);

/// The source that is meant if nobody names one, of those that are no joints: the only one with travel, or if
/// there is none the only one with speeds or an unknown measure, or else the only odometry. Null if there is
/// no such one.
const WheelSource* recognised_source(std::span<const WheelSource> sources);

/// The source that a person names: a topic, TOPIC:LEFT,RIGHT with the fields of both wheels, or the topics of
/// both wheels as TOPIC,TOPIC, each with :FIELD unless it holds a single number. `path` is for error
/// messages.
///
/// Errors  UnclearChoice with the topics if there is no such topic, and with the fields if they are not
///         recognised or not there; astro::Error if nothing says what the messages of the topic are made of.
WheelSource named_source(const std::filesystem::path& path, std::span<const bag::BagTopic> topics,
                         const std::string& name);

}  // namespace astro::importing
