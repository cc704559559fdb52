#include "host/import/bags/joint_wheels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "host/formats/files/bag.hpp"
#include "host/formats/messages/joint_state.hpp"
#include "host/import/bags/sample_limit.hpp"
#include "host/import/bags/stamp_count.hpp"
#include "host/import/bags/time_order.hpp"
#include "host/import/wheels/counter_wraps.hpp"
#include "host/import/wheels/mean_of_pairs.hpp"
#include "host/import/wheels/speed_integral.hpp"
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
      : path_(path), topic_(selection.topic) {
    if (!selection.joints.left.empty()) pairs_.push_back(selection.joints);
    pairs_.insert(pairs_.end(), selection.further.begin(), selection.further.end());
  }

  WheelTrack read() {
    track_.unit = WheelUnit::radians;
    for (const bag::BagTopic& topic : bag::read_bag(path_).topics)
      if (topic.name == topic_) require_possible(topic.messages, 24, "states of joints", path_);
    choose_joints();
    positions_.resize(pairs_.size());
    velocities_.resize(pairs_.size());
    bag::BagReport report;
    for_each_state(path_, topic_, report, [this](const ros2::JointState* state, std::int64_t log_time_ns) {
      if (state != nullptr) take(*state, log_time_ns);
    });
    finish(report);
    return std::move(track_);
  }

 private:
  void remark(std::string fact) { track_.remarks.push_back({std::move(fact)}); }

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
    if (pairs_.empty()) recognise(names);
    require_joints(names);
    track_.joints = pairs_.front();
    // Only messages with the left wheel count: other drivers on the same topic may have no clock.
    stamps_ = found.at(track_.joints.left);
    track_.clock = stamps_.most_are_set() ? WheelClock::stamp : WheelClock::receipt;
  }

  void recognise(const std::vector<std::string>& names) {
    const auto recognised = recognise_wheels(names);
    if (!recognised)
      throw UnclearChoice(path_.string() + ": which joints of " + topic_ +
                              " are the wheels cannot be told from their names: " + listed(names),
                          names, WheelProblem::joints_unclear);
    pairs_.push_back(*recognised);
    track_.remarks.push_back({"the wheels are the joints " + recognised->left + " and " + recognised->right,
                              ChoiceRemark::joints_recognised,
                              {recognised->left, recognised->right}});
  }

  void require_joints(const std::vector<std::string>& names) const {
    std::set<std::string> used;
    for (const JointPair& pair : pairs_)
      for (const std::string& joint : {pair.left, pair.right}) {
        if (std::ranges::find(names, joint) == names.end())
          throw UnclearChoice(
              path_.string() + ": " + topic_ + " has no joint '" + joint + "'; it has " + listed(names),
              names, WheelProblem::joints_unclear);
        if (!used.insert(joint).second)
          throw UnclearChoice(path_.string() + ": two wheels are the joint " + joint, names,
                              WheelProblem::joints_unclear);
      }
  }

  void take(const ros2::JointState& state, std::int64_t log_time_ns) {
    std::vector<std::array<std::size_t, 2>> places;
    bool positions = !state.positions.empty();
    for (const JointPair& pair : pairs_) {
      const auto place = [&](const std::string& joint) {
        return static_cast<std::size_t>(std::ranges::find(state.names, joint) - state.names.begin());
      };
      places.push_back({place(pair.left), place(pair.right)});
      for (const std::size_t each : places.back()) {
        if (each >= state.names.size()) return;
        positions = positions && std::isfinite(state.positions[each]);
      }
    }
    const std::vector<double>& values = positions ? state.positions : state.velocities;
    const auto is_missing = [&](const auto& pair) {
      return values.empty() || !std::isfinite(values[pair[0]]) || !std::isfinite(values[pair[1]]);
    };
    if (std::ranges::any_of(places, is_missing)) {
      ++without_values_;
      return;
    }
    const bool stamped = track_.clock == WheelClock::stamp;
    if (stamped && stamps_.is_missing(state.time_ns)) return;
    if (stamped) arrivals_ns_[positions ? 1 : 0].push_back(log_time_ns);
    for (std::size_t i = 0; i < places.size(); ++i)
      (positions ? positions_ : velocities_)[i].push_back(
          {stamped ? state.time_ns : log_time_ns, values[places[i][0]], values[places[i][1]]});
  }

  /// The travel of one pair. What is remarked on the order of messages is the same for all pairs.
  std::vector<WheelSample> travel(std::size_t pair) {
    WheelTrack track;
    track.unit = WheelUnit::radians;
    const bool integrates = positions_[pair].empty();
    track.samples = std::move(integrates ? velocities_[pair] : positions_[pair]);
    order_by_time(track.samples, arrivals_ns_[integrates ? 0 : 1], path_.string(), topic_, track.remarks);
    if (pair > 0) track.remarks.clear();
    if (integrates && !track.samples.empty()) {
      track.samples =
          integral_of(track.samples, "the joints have no positions; their velocities", track.remarks);
      if (pair > 0) track.remarks.clear();
    } else {
      unwrap(track, path_.string() + ": " + topic_);
    }
    track_.remarks.insert(track_.remarks.end(), track.remarks.begin(), track.remarks.end());
    return std::move(track.samples);
  }

  void finish(const bag::BagReport& report) {
    track_.remarks.insert(track_.remarks.end(), report.warnings.begin(), report.warnings.end());
    std::vector<Wheels> wheels;
    std::vector<std::string> left, right;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      wheels.push_back(travel(i));
      left.push_back(pairs_[i].left);
      right.push_back(pairs_[i].right);
    }
    std::vector<Remark> differences;
    track_.samples = mean_of_pairs(std::move(wheels), left, right, differences);
    if (without_values_ > 0)
      remark(std::to_string(without_values_) +
             " messages have neither positions nor velocities of the wheels");
    if (track_.clock == WheelClock::stamp) stamps_.remark("messages of " + topic_, track_.remarks);
    if (track_.samples.size() < 2)
      throw Error(path_.string() + ": " + topic_ + " has fewer than two messages with both wheels (" +
                      track_.joints.left + ", " + track_.joints.right + "): name the right file",
                  JointProblem::too_few_messages,
                  {path_.string(), topic_, track_.joints.left, track_.joints.right});
    track_.remarks.insert(track_.remarks.end(), differences.begin(), differences.end());
  }

  const std::filesystem::path& path_;
  const std::string topic_;
  std::vector<JointPair> pairs_;  // the wheels, front to rear
  StampCount stamps_;             // of the messages with the left wheel
  std::size_t without_values_ = 0;
  std::vector<std::vector<WheelSample>> positions_, velocities_;  // of each pair
  std::array<std::vector<std::int64_t>, 2> arrivals_ns_;          // of the velocities, and of the positions
  WheelTrack track_;
};

}  // namespace

WheelTrack wheels_of_joints(const std::filesystem::path& path, const JointSelection& selection) {
  return JointWheels(path, selection).read();
}

}  // namespace astro::importing
