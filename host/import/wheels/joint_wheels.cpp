#include "host/import/wheels/joint_wheels.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "host/formats/files/bag.hpp"
#include "host/formats/messages/joint_state.hpp"
#include "host/import/wheels/counter_wraps.hpp"
#include "host/import/wheels/sample_limit.hpp"
#include "host/import/wheels/stamp_count.hpp"
#include "host/import/wheels/time_order.hpp"
#include "host/import/wheels/unclear_choice.hpp"

namespace astro::importing {
namespace {

constexpr std::size_t kMostNames = 4096;  // of one topic

void for_each_state(const std::filesystem::path& path, const std::string& topic, bag::BagReport& report,
                    const std::function<void(const ros2::JointState*, std::int64_t)>& take) {
  bag::BagHandlers handlers;
  handlers.wants = [&](const bag::BagTopic& at) {
    return at.type == ros2::joint_state_type().name && at.encoding == "cdr" &&
           (topic.empty() || at.name == topic);
  };
  handlers.message = [&](const bag::BagTopic&, const bag::BagMessage& message) {
    const auto state = ros2::decode_joint_state(message.data);
    take(state ? &*state : nullptr, message.log_time_ns);
  };
  report = bag::read_bag(path, handlers);
}

class JointWheels {
 public:
  JointWheels(const std::filesystem::path& path, const JointSelection& selection)
      : path_(path), topic_(selection.topic), joints_(selection.joints) {}

  WheelTrack read() {
    track_.unit = WheelUnit::radians;
    choose_topic();
    choose_joints();
    bag::BagReport report;
    for_each_state(path_, topic_, report, [this](const ros2::JointState* state, std::int64_t log_time_ns) {
      if (state != nullptr) take(*state, log_time_ns);
    });
    finish(report);
    return std::move(track_);
  }

 private:
  void remark(std::string fact) { track_.remarks.push_back({std::move(fact)}); }

  void choose_topic() {
    std::vector<std::string> topics;
    std::uint64_t messages = 0;
    for (const bag::BagTopic& topic : bag::read_bag(path_).topics) {
      if (topic.type != ros2::joint_state_type().name || topic.messages == 0) continue;
      topics.push_back(topic.name);
      messages += topic.messages;
    }
    require_possible(messages, 24, "states of joints", path_);
    if (topic_.empty() && topics.size() == 1) topic_ = topics.front();
    if (std::ranges::find(topics, topic_) != topics.end()) return;
    const std::string what = topics.empty()   ? " has no messages of joints (sensor_msgs/msg/JointState)"
                             : topic_.empty() ? " has several topics of joints: "
                                              : " has no topic " + topic_ + " of joints; it has ";
    throw UnclearChoice(path_.string() + what + (topics.empty() ? "" : listed(topics)), topics,
                        WheelProblem::topic_unclear);
  }

  void choose_joints() {
    std::map<std::string, StampCount> found;
    bag::BagReport report;
    for_each_state(path_, topic_, report, [&](const ros2::JointState* state, std::int64_t) {
      if (state == nullptr) return;
      for (const std::string& name : state->names) {
        if (found.size() >= kMostNames && !found.contains(name)) continue;
        found[name].take(state->time_ns);
      }
    });
    std::vector<std::string> names;
    for (const auto& [name, stamps] : found) names.push_back(name);
    if (joints_.left.empty() && joints_.right.empty()) {
      const auto recognised = recognise_wheels(names);
      if (!recognised)
        throw UnclearChoice(path_.string() + ": which joints of " + topic_ +
                                " are the wheels cannot be told from their names: " + listed(names),
                            names, WheelProblem::joints_unclear);
      joints_ = *recognised;
      track_.remarks.push_back({"the wheels are the joints " + joints_.left + " and " + joints_.right,
                                ChoiceRemark::joints_recognised,
                                {joints_.left, joints_.right}});
    }
    for (const std::string& joint : {joints_.left, joints_.right})
      if (!found.contains(joint))
        throw UnclearChoice(
            path_.string() + ": " + topic_ + " has no joint '" + joint + "'; it has " + listed(names), names,
            WheelProblem::joints_unclear);
    if (joints_.left == joints_.right)
      throw UnclearChoice(path_.string() + ": both wheels are the joint " + joints_.left, names,
                          WheelProblem::joints_unclear);
    track_.joints = joints_;
    // Only messages with the left wheel count: other drivers on the same topic may have no clock.
    stamps_ = found.at(joints_.left);
    track_.clock = stamps_.most_are_set() ? WheelClock::stamp : WheelClock::receipt;
  }

  void take(const ros2::JointState& state, std::int64_t log_time_ns) {
    const auto left =
        static_cast<std::size_t>(std::ranges::find(state.names, joints_.left) - state.names.begin());
    const auto right =
        static_cast<std::size_t>(std::ranges::find(state.names, joints_.right) - state.names.begin());
    if (left >= state.names.size() || right >= state.names.size()) return;
    const bool positions = !state.positions.empty() && std::isfinite(state.positions[left]) &&
                           std::isfinite(state.positions[right]);
    const std::vector<double>& values = positions ? state.positions : state.velocities;
    if (values.empty() || !std::isfinite(values[left]) || !std::isfinite(values[right])) {
      ++without_values_;
      return;
    }
    const bool stamped = track_.clock == WheelClock::stamp;
    if (stamped && stamps_.is_missing(state.time_ns)) return;
    const WheelSample sample{stamped ? state.time_ns : log_time_ns, values[left], values[right]};
    (positions ? track_.samples : velocities_).push_back(sample);
  }

  void integrate() {
    remark("the joints have no positions; their velocities were integrated");
    order_by_time(velocities_, topic_, track_.remarks);
    WheelSample sum;
    for (std::size_t i = 0; i < velocities_.size(); ++i) {
      const WheelSample& at = velocities_[i];
      const WheelSample& before = velocities_[i == 0 ? 0 : i - 1];
      const double half_s = 0.5e-9 * static_cast<double>(at.time_ns - before.time_ns);
      sum = {at.time_ns, sum.left + half_s * (at.left + before.left),
             sum.right + half_s * (at.right + before.right)};
      track_.samples.push_back(sum);
    }
  }

  void finish(const bag::BagReport& report) {
    track_.remarks.insert(track_.remarks.end(), report.warnings.begin(), report.warnings.end());
    if (track_.samples.empty() && !velocities_.empty()) {
      integrate();
    } else {
      order_by_time(track_.samples, topic_, track_.remarks);
      unwrap(track_, path_.string() + ": " + topic_);
    }
    if (without_values_ > 0)
      remark(std::to_string(without_values_) +
             " messages have neither positions nor velocities of the wheels");
    if (track_.clock == WheelClock::stamp) stamps_.remark("messages of " + topic_, track_.remarks);
    if (track_.samples.size() < 2)
      throw Error(path_.string() + ": " + topic_ + " has fewer than two messages with both wheels (" +
                      joints_.left + ", " + joints_.right + "): name the right file",
                  JointProblem::too_few_messages, {path_.string(), topic_, joints_.left, joints_.right});
  }

  const std::filesystem::path& path_;
  std::string topic_;
  JointPair joints_;
  StampCount stamps_;  // of the messages with the left wheel
  std::size_t without_values_ = 0;
  std::vector<WheelSample> velocities_;
  WheelTrack track_;
};

}  // namespace

WheelTrack wheels_in_bag(const std::filesystem::path& path, const JointSelection& selection) {
  return JointWheels(path, selection).read();
}

}  // namespace astro::importing
