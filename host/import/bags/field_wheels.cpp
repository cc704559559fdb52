#include "host/import/bags/field_wheels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "common/base/side.hpp"
#include "host/formats/cdr/field_reader.hpp"
#include "host/import/bags/sample_limit.hpp"
#include "host/import/bags/stamp_count.hpp"
#include "host/import/bags/time_order.hpp"
#include "host/import/wheels/counter_wraps.hpp"
#include "host/import/wheels/speed_integral.hpp"

namespace astro::importing {
namespace {

using Values = std::vector<WheelSample>;

/// The value of `samples` at a time between the times of `after - 1` and `after`.
double value_between(const Values& samples, std::size_t after, double WheelSample::*wheel,
                     std::int64_t time_ns) {
  const WheelSample &from = samples[after - 1], &to = samples[after];
  const double part =
      static_cast<double>(time_ns - from.time_ns) / static_cast<double>(to.time_ns - from.time_ns);
  return from.*wheel + part * (to.*wheel - from.*wheel);
}

class FieldWheels {
 public:
  FieldWheels(const std::filesystem::path& path, const WheelSource& source, const TravelMeasure& measure,
              std::optional<double> counter_range)
      : path_(path),
        source_(source),
        measure_(measure),
        counter_range_(counter_range),
        one_topic_(source.left.topic == source.right.topic) {}

  WheelTrack read() {
    track_.unit = measure_.unit;
    collect();
    if (one_topic_) {
      track_.samples = travel(values_of(Side::left), source_.left.topic);
    } else {
      Values left = travel(values_of(Side::left), source_.left.topic);
      Values right = travel(values_of(Side::right), source_.right.topic);
      join(std::move(left), std::move(right));
    }
    if (track_.samples.size() < 2)
      throw Error(path_.string() + ": " + source_.name() +
                  " has fewer than two messages of both wheels at the same time: name the right file");
    return std::move(track_);
  }

 private:
  /// A message with one wheel, or with both.
  struct Reading {
    std::int64_t stamp_ns = 0, log_time_ns = 0;
    double left = 0, right = 0;
  };
  struct Topic {
    std::vector<Reading> readings;
    StampCount stamps;
    bool stamped = false;
  };
  struct TopicReader {
    Side side;
    ros2::FieldReader reader;
  };

  void remark(std::string fact) { track_.remarks.push_back({std::move(fact)}); }

  /// The fields that are read of a topic, those of the wheels first.
  std::optional<ros2::FieldReader> reader_of(const bag::BagTopic& topic, Side side) {
    const auto layout = topic.encoding == "cdr" ? layout_of(topic) : nullptr;
    if (!layout) return std::nullopt;
    std::vector<std::string> paths{side == Side::left ? source_.left.field : source_.right.field};
    if (one_topic_) paths.push_back(source_.right.field);
    const std::string stamp = ros2::stamp_field(*layout);
    if (!stamp.empty()) paths.push_back(stamp);
    return ros2::FieldReader::of(*layout, paths);
  }

  void collect() {
    bag::BagHandlers handlers;
    handlers.wants = [this](const bag::BagTopic& topic) {
      const Side side = topic.name == source_.left.topic ? Side::left : Side::right;
      if (side == Side::right && topic.name != source_.right.topic) return false;
      auto reader = reader_of(topic, side);
      if (reader) readers_.emplace(&topic, TopicReader{side, std::move(*reader)});
      return reader.has_value();
    };
    handlers.message = [this](const bag::BagTopic& topic, const bag::BagMessage& message) {
      TopicReader& at_topic = readers_.at(&topic);
      const std::vector<ros2::FieldValue>* values = at_topic.reader.read(message.data);
      if (values == nullptr)
        ++unreadable_;
      else
        take(at_topic.side, *values, message.log_time_ns);
    };
    for (const bag::BagTopic& topic : bag::read_bag(path_).topics)
      if (topic.name == source_.left.topic || topic.name == source_.right.topic)
        require_possible(topic.messages, 24, "messages of wheels", path_);
    const bag::BagReport report = bag::read_bag(path_, handlers);
    track_.remarks.insert(track_.remarks.end(), report.warnings.begin(), report.warnings.end());
    if (unreadable_ > 0)
      remark(std::to_string(unreadable_) + " messages of wheels do not fit their type and were left out");
    if (without_values_ > 0)
      remark(std::to_string(without_values_) + " messages have no values of the wheels");
    choose_clock();
  }

  /// `values`: in the order of reader_of().
  void take(Side side, const std::vector<ros2::FieldValue>& values, std::int64_t log_time_ns) {
    const std::size_t wheels = one_topic_ ? 2 : 1;
    const Reading reading{values.size() > wheels ? values.back().time_ns : 0, log_time_ns,
                          values.front().number, values[wheels - 1].number};
    if (!std::isfinite(reading.left) || !std::isfinite(reading.right)) {
      ++without_values_;
      return;
    }
    topics_[at(side)].stamps.take(reading.stamp_ns);
    topics_[at(side)].readings.push_back(reading);
  }

  /// Both wheels have the same clock: stamps only if both topics have them.
  void choose_clock() {
    const bool stamped = topics_[0].stamps.most_are_set() && (one_topic_ || topics_[1].stamps.most_are_set());
    track_.clock = stamped ? WheelClock::stamp : WheelClock::receipt;
    for (Topic& topic : topics_) topic.stamped = stamped;
    if (!stamped)
      remark("the messages of the wheels have no stamps; their times are when the recorder received them");
  }

  Values values_of(Side side) {
    Topic& topic = topics_[at(side)];
    const std::string& name = side == Side::left ? source_.left.topic : source_.right.topic;
    Values values;
    std::vector<std::int64_t> arrivals_ns;
    values.reserve(topic.readings.size());
    for (const Reading& reading : topic.readings) {
      if (topic.stamped && topic.stamps.is_missing(reading.stamp_ns)) continue;
      WheelSample sample{topic.stamped ? reading.stamp_ns : reading.log_time_ns,
                         measure_.scale * reading.left, measure_.scale * reading.right};
      // The wheel of the other topic stands, so that nothing is made continuous there.
      if (!one_topic_) (side == Side::left ? sample.right : sample.left) = 0;
      values.push_back(sample);
      if (topic.stamped) arrivals_ns.push_back(reading.log_time_ns);
    }
    topic.readings = {};
    if (topic.stamped) topic.stamps.remark("messages of " + name, track_.remarks);
    order_by_time(values, arrivals_ns, path_.string(), "messages of " + name, track_.remarks);
    return values;
  }

  Values travel(Values values, const std::string& topic) {
    if (measure_.per_second) return integral_of(values, "the speeds of " + topic, track_.remarks);
    WheelTrack track;
    track.unit = measure_.unit;
    track.samples = std::move(values);
    unwrap(track, path_.string() + ": " + topic, counter_range_);
    if (track.counter_range) track_.counter_range = track.counter_range;
    track_.remarks.insert(track_.remarks.end(), track.remarks.begin(), track.remarks.end());
    return std::move(track.samples);
  }

  void join(Values left, Values right) {
    if (left.empty() || right.empty()) return;
    const bool alike = left.size() * 10 <= right.size() * 11 && right.size() * 10 <= left.size() * 11;
    const bool at_left = alike ? left.front().time_ns <= right.front().time_ns : left.size() < right.size();
    const Values &base = at_left ? left : right, &other = at_left ? right : left;
    std::size_t after = 0;
    for (WheelSample sample : base) {
      while (after < other.size() && other[after].time_ns < sample.time_ns) ++after;
      if (after == other.size()) break;
      const bool same = other[after].time_ns == sample.time_ns;
      if (!same && after == 0) continue;
      double WheelSample::*const wheel = at_left ? &WheelSample::right : &WheelSample::left;
      sample.*wheel = same ? other[after].*wheel : value_between(other, after, wheel, sample.time_ns);
      track_.samples.push_back(sample);
    }
    remark("the wheels have a topic each: the values of the " + std::string(at_left ? "right" : "left") +
           " one were interpolated at the times of the " + (at_left ? "left" : "right") + " one");
  }

  const std::filesystem::path& path_;
  const WheelSource& source_;
  const TravelMeasure& measure_;
  const std::optional<double> counter_range_;
  const bool one_topic_;
  std::map<const bag::BagTopic*, TopicReader> readers_;
  std::uint64_t unreadable_ = 0, without_values_ = 0;
  std::array<Topic, 2> topics_;  // one topic with both wheels is the first one
  WheelTrack track_;
};

}  // namespace

WheelTrack wheels_of_fields(const std::filesystem::path& path, const WheelSource& source,
                            const TravelMeasure& measure, std::optional<double> counter_range) {
  return FieldWheels(path, source, measure, counter_range).read();
}

}  // namespace astro::importing
