#include "host/import/bags/wheel_sources.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "host/base/error.hpp"
#include "host/formats/cdr/field_reader.hpp"
#include "host/formats/messages/joint_state.hpp"
#include "host/formats/messages/known_layouts.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/formats/messages/stamped_pose.hpp"
#include "host/import/wheels/joint_names.hpp"
#include "host/import/wheels/unclear_choice.hpp"

namespace astro::importing {
namespace {

using Kind = WheelSource::Kind;

constexpr std::string_view kSingleField = "data";  // of std_msgs

bool is_usable(const bag::BagTopic& topic) { return topic.messages > 0 && topic.encoding == "cdr"; }

/// Whether the robot may have worked out such odometry from its wheels alone.
bool is_wheel_odometry(const bag::BagTopic& topic) {
  if (topic.type != ros2::odometry_type().name || ros2::speaks_of_tracker(topic.name) ||
      !ros2::may_be_estimate(topic.name, topic.type))
    return false;
  return std::ranges::none_of(words_of(topic.name), [](const std::string& word) {
    for (const char* other : {"amcl", "slam", "ekf", "ukf", "filtered", "fused", "visual", "vio", "laser",
                              "lidar", "icp", "rgbd", "localization", "gps", "map", "gyro", "imu"})
      if (word == other) return true;
    return false;
  });
}

/// The numbers of a message that may be those of wheels.
std::vector<ros2::NumberField> numbers_of(const bag::BagTopic& topic) {
  const auto layout = layout_of(topic);
  if (!layout) return {};
  std::vector<ros2::NumberField> fields = ros2::number_fields(*layout);
  std::erase_if(fields, [](const ros2::NumberField& field) { return field.id == ros2::kBool; });
  return fields;
}

/// The field of a topic that holds one number of interest.
std::optional<ros2::NumberField> single_number(const bag::BagTopic& topic) {
  const std::vector<ros2::NumberField> fields = numbers_of(topic);
  const auto data = std::ranges::find(fields, kSingleField, &ros2::NumberField::path);
  if (data != fields.end()) return *data;
  return fields.size() == 1 ? std::optional(fields.front()) : std::nullopt;
}

/// Finds the pairs of names that differ only in the word for the side.
class Pairs {
 public:
  struct Member {
    WheelSource::Place place;
    bool is_integer = false;
  };

  /// `name` has the word for the side, `context` what else is said.
  void add(std::string_view name, const std::string& context, const Member& member) {
    const SidedName sided = sided_name(name);
    if (!sided.side) return;
    auto& pair = pairs_[{sided.stem, context}];
    pair[at(*sided.side)].push_back(member);
  }

  std::vector<WheelSource> sources() const {
    std::vector<WheelSource> found;
    for (const auto& [key, pair] : pairs_) {
      if (pair[0].size() != 1 || pair[1].size() != 1) continue;
      const bool integers = pair[0][0].is_integer && pair[1][0].is_integer;
      const NamedMeasure named = measure_named(key.first, key.second, integers);
      if (named.of_wheel) found.push_back({Kind::fields, pair[0][0].place, pair[1][0].place, named.measure});
    }
    return found;
  }

 private:
  std::map<std::pair<std::string, std::string>, std::array<std::vector<Member>, 2>> pairs_;
};

std::vector<WheelSource> field_sources(const bag::BagTopic& topic) {
  Pairs pairs;
  for (const ros2::NumberField& field : numbers_of(topic))
    pairs.add(field.path, topic.name + ' ' + topic.type, {{topic.name, field.path}, field.is_integer()});
  return pairs.sources();
}

std::vector<WheelSource> topic_sources(std::span<const bag::BagTopic> topics) {
  Pairs pairs;
  for (const bag::BagTopic& topic : topics)
    if (const auto field = is_usable(topic) ? single_number(topic) : std::nullopt)
      pairs.add(topic.name, topic.type, {{topic.name, field->path}, field->is_integer()});
  return pairs.sources();
}

int rank(const WheelSource& source) {
  if (source.kind == Kind::joints) return 0;
  if (source.kind == Kind::odometry) return 3;
  return source.measure && !source.measure->per_second ? 1 : 2;
}

const bag::BagTopic& topic_named(const std::filesystem::path& path, std::span<const bag::BagTopic> topics,
                                 const std::string& name) {
  const auto found = std::ranges::find_if(
      topics, [&](const bag::BagTopic& topic) { return topic.name == name && is_usable(topic); });
  if (found != topics.end()) return *found;
  std::vector<std::string> names;
  for (const WheelSource& source : wheel_sources(topics)) names.push_back(source.name());
  if (names.empty())
    for (const bag::BagTopic& topic : topics) names.push_back(topic.name);
  throw UnclearChoice(path.string() + " has no topic " + name + " of wheels; it has " + listed(names), names,
                      WheelProblem::topic_unclear);
}

[[noreturn]] void refuse_fields(const std::filesystem::path& path, const bag::BagTopic& topic,
                                const std::string& what) {
  if (!layout_of(topic))
    throw Error(path.string() + ": what the messages of " + topic.name +
                " are made of is not known: the bag has no "
                "definition of " +
                topic.type + " as a .msg file: record the run again with a later version of ROS");
  std::vector<std::string> names;
  for (const ros2::NumberField& field : numbers_of(topic)) names.push_back(field.path);
  throw UnclearChoice(
      path.string() + ": " + what + "; the numbers in " + topic.name + " are " + listed(names), names,
      WheelProblem::fields_unclear);
}

/// A part of a source's name.
WheelSource::Place place_in(std::string_view text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  return {std::string(text.substr(0, colon)), std::string(text.substr(std::min(colon + 1, text.size())))};
}

WheelSource source_of_topic(const std::filesystem::path& path, const bag::BagTopic& topic) {
  const WheelSource::Place place{topic.name, ""};
  if (topic.type == ros2::joint_state_type().name) return {Kind::joints, place, place, {}};
  if (topic.type == ros2::odometry_type().name) return {Kind::odometry, place, place, {}};
  const std::vector<WheelSource> found = field_sources(topic);
  if (const WheelSource* one = recognised_source(found)) return *one;
  refuse_fields(path, topic,
                "which fields of " + topic.name + " are the wheels cannot be told from their names");
}

/// Completes the field of a topic, and checks one that is named.
ros2::NumberField complete(const std::filesystem::path& path, std::span<const bag::BagTopic> topics,
                           WheelSource::Place& place) {
  const bag::BagTopic& topic = topic_named(path, topics, place.topic);
  if (place.field.empty()) {
    const auto single = single_number(topic);
    if (!single) refuse_fields(path, topic, topic.name + " does not hold a single number");
    place.field = single->path;
    return *single;
  }
  const auto layout = layout_of(topic);
  const auto field = layout ? ros2::number_field(*layout, place.field) : std::nullopt;
  if (!field) refuse_fields(path, topic, topic.name + " has no number '" + place.field + "'");
  return *field;
}

}  // namespace

std::string WheelSource::name() const {
  if (kind != Kind::fields) return left.topic;
  if (left.topic == right.topic) return left.topic + ':' + left.field + ',' + right.field;
  std::string text;
  for (const Place& place : {left, right})
    text += (text.empty() ? "" : ",") + place.topic + (place.field == kSingleField ? "" : ':' + place.field);
  return text;
}

std::shared_ptr<const ros2::MessageLayout> layout_of(const bag::BagTopic& topic) {
  return topic.layout ? topic.layout : ros2::known_layout(topic.type);
}

std::vector<WheelSource> wheel_sources(std::span<const bag::BagTopic> topics) {
  std::vector<WheelSource> sources = topic_sources(topics);
  for (const bag::BagTopic& topic : topics) {
    if (!is_usable(topic)) continue;
    const WheelSource::Place place{topic.name, ""};
    if (topic.type == ros2::joint_state_type().name) {
      sources.push_back({Kind::joints, place, place, {}});
    } else if (is_wheel_odometry(topic)) {
      sources.push_back({Kind::odometry, place, place, {}});
    } else {
      const std::vector<WheelSource> found = field_sources(topic);
      sources.insert(sources.end(), found.begin(), found.end());
    }
  }
  std::ranges::stable_sort(sources, {}, rank);
  return sources;
}

const WheelSource* recognised_source(std::span<const WheelSource> sources) {
  const WheelSource* found = nullptr;
  for (const WheelSource& source : sources) {
    if (source.kind == Kind::joints) continue;
    if (found != nullptr) return rank(source) == rank(*found) ? nullptr : found;
    found = &source;
  }
  return found;
}

WheelSource named_source(const std::filesystem::path& path, std::span<const bag::BagTopic> topics,
                         const std::string& name) {
  const std::size_t comma = name.find(',');
  if (comma == std::string::npos && name.find(':') == std::string::npos)
    return source_of_topic(path, topic_named(path, topics, name));
  const std::string_view text = name;
  WheelSource source{Kind::fields, place_in(text.substr(0, comma)), {}, {}};
  if (comma == std::string::npos)
    refuse_fields(path, topic_named(path, topics, source.left.topic),
                  "the field of the right wheel is missing");
  source.right = place_in(text.substr(comma + 1));
  const bool is_field = !source.left.field.empty() && source.right.field.empty() &&
                        std::ranges::find(topics, source.right.topic, &bag::BagTopic::name) == topics.end();
  if (is_field) source.right = {source.left.topic, source.right.topic};
  const ros2::NumberField left = complete(path, topics, source.left),
                          right = complete(path, topics, source.right);
  if (source.left == source.right)
    throw UnclearChoice(path.string() + ": both wheels are " + name, {name}, WheelProblem::fields_unclear);
  const std::string words = source.left.topic == source.right.topic ? source.left.field : source.left.topic;
  source.measure = measure_named(words, "wheel", left.is_integer() && right.is_integer()).measure;
  return source;
}

}  // namespace astro::importing
