#include "host/import/bags/imu_rates.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/files/bag.hpp"
#include "host/formats/messages/sensors.hpp"
#include "host/import/bags/sample_limit.hpp"
#include "host/import/bags/stamp_count.hpp"
#include "host/import/bags/time_order.hpp"
#include "host/import/wheels/unclear_choice.hpp"

namespace astro::importing {
namespace {

namespace fs = std::filesystem;
using ros2::msg::Imu;

bool holds_rates(const bag::BagTopic& topic) {
  return topic.type == Imu::kType && topic.encoding == "cdr" && topic.messages > 0;
}

/// The topic to read, or none.
const bag::BagTopic* chosen(const fs::path& path, const std::vector<bag::BagTopic>& topics,
                            const std::string& name, std::vector<Remark>& remarks) {
  std::vector<const bag::BagTopic*> found;
  std::vector<std::string> names;
  for (const bag::BagTopic& topic : topics)
    if (holds_rates(topic)) {
      if (name.empty() || topic.name == name) found.push_back(&topic);
      names.push_back(topic.name);
    }
  if (!name.empty() && found.empty())
    throw UnclearChoice(path.string() + " has no IMU on " + name + "; it has " + listed(names), names,
                        WheelProblem::imu_unclear);
  if (found.size() > 1)
    remarks.push_back({"there are several IMUs, and none is used: " + listed(names),
                       ChoiceRemark::several_imus, std::move(names)});
  return found.size() == 1 ? found.front() : nullptr;
}

/// Nothing if the message holds no rates.
std::optional<Imu> rates_in(ByteView message) {
  std::optional<Imu> imu = ros2::decode<Imu>(message);
  if (!imu || imu->angular_velocity_covariance[0] == -1) return std::nullopt;
  const ros2::msg::Vector3& rate = imu->angular_velocity;
  if (!std::isfinite(rate.x) || !std::isfinite(rate.y) || !std::isfinite(rate.z)) return std::nullopt;
  return imu;
}

}  // namespace

ImuRates imu_rates_in_bag(const fs::path& path, const std::string& name) {
  ImuRates found;
  const std::vector<bag::BagTopic> topics = bag::read_bag(path).topics;
  const bag::BagTopic* topic = chosen(path, topics, name, found.remarks);
  if (topic == nullptr) return found;
  found.topic = topic->name;
  require_possible(topic->messages, 40, "rates of an IMU", path);
  StampCount stamps;
  std::size_t unreadable = 0;
  std::vector<std::int64_t> stamps_ns;
  bag::BagHandlers handlers;
  handlers.wants = [&](const bag::BagTopic& at) { return at.name == topic->name && at.type == Imu::kType; };
  handlers.message = [&](const bag::BagTopic&, const bag::BagMessage& message) {
    const std::optional<Imu> imu = rates_in(message.data);
    if (!imu) {
      ++unreadable;
      return;
    }
    const ros2::msg::Vector3& rate = imu->angular_velocity;
    found.samples.push_back({message.log_time_ns, {rate.x, rate.y, rate.z}});
    stamps_ns.push_back(ros2::msg::nanoseconds(imu->header.stamp));
    stamps.take(stamps_ns.back());
  };
  bag::read_bag(path, handlers);
  const std::string what = "rates of " + found.topic;
  if (unreadable > 0)
    found.remarks.push_back({what + ": " + std::to_string(unreadable) + " cannot be read and were left out"});
  std::vector<std::int64_t> arrivals_ns;
  if (stamps.most_are_set()) {
    stamps.remark(what, found.remarks);
    std::vector<ImuRate> stamped;
    for (std::size_t i = 0; i < found.samples.size(); ++i) {
      if (stamps.is_missing(stamps_ns[i])) continue;
      arrivals_ns.push_back(found.samples[i].time_ns);
      stamped.push_back({stamps_ns[i], found.samples[i].rate_radps});
    }
    found.samples = std::move(stamped);
  } else if (!found.samples.empty()) {
    found.remarks.push_back({what + " have no stamps: the recorder's times are used"});
  }
  order_by_time(found.samples, arrivals_ns, path.string(), what, found.remarks);
  return found;
}

}  // namespace astro::importing
