#include "host/import/bags/bag_wheels.hpp"

#include <algorithm>

#include "host/formats/files/bag.hpp"
#include "host/import/bags/field_wheels.hpp"
#include "host/import/bags/joint_wheels.hpp"
#include "host/import/bags/odometry_wheels.hpp"
#include "host/import/bags/wheel_sources.hpp"
#include "host/import/wheels/unclear_choice.hpp"

namespace astro::importing {
namespace {

class BagWheels {
 public:
  BagWheels(const std::filesystem::path& path, const BagWheelSelection& selection)
      : path_(path), selection_(selection), topics_(bag::read_bag(path).topics) {}

  WheelTrack read() const {
    if (!selection_.topic.empty()) return read(named_source(path_, topics_, selection_.topic));
    const std::vector<WheelSource> sources = wheel_sources(topics_);
    const auto joints =
        static_cast<std::size_t>(std::ranges::count(sources, WheelSource::Kind::joints, &WheelSource::kind));
    if (joints > 1) refuse(std::span(sources).first(joints), " has several topics of joints: ");
    if (joints == 0) return read_recognised(sources);
    try {
      return read(sources.front());
    } catch (const UnclearChoice& unclear) {
      const bool others = recognised_source(sources) != nullptr && selection_.joints.left.empty();
      if (unclear.kind() != Kind(WheelProblem::joints_unclear) || !others) throw;
    }
    return read_recognised(sources);
  }

 private:
  [[noreturn]] void refuse(std::span<const WheelSource> sources, const std::string& what) const {
    std::vector<std::string> names;
    for (const WheelSource& source : sources) names.push_back(source.name());
    throw UnclearChoice(path_.string() + what + listed(names), names, WheelProblem::topic_unclear);
  }

  WheelTrack read_recognised(const std::vector<WheelSource>& sources) const {
    if (sources.empty())
      throw UnclearChoice(
          path_.string() +
              " has no messages of wheels: no joints (sensor_msgs/msg/JointState), no counts, angles or "
              "speeds of a left and a right wheel, and no odometry of the robot",
          {}, WheelProblem::topic_unclear);
    const WheelSource* source = recognised_source(sources);
    if (source == nullptr) refuse(sources, " has several topics that may be the wheels: ");
    WheelTrack track = read(*source);
    if (source->kind == WheelSource::Kind::fields)
      track.remarks.insert(track.remarks.begin(), {"the wheels are " + source->name() + " in " +
                                                       std::string(measure_of(*source).name),
                                                   ChoiceRemark::wheels_recognised,
                                                   {source->name(), std::string(measure_of(*source).name)}});
    return track;
  }

  TravelMeasure measure_of(const WheelSource& source) const {
    if (selection_.measure) return *selection_.measure;
    if (source.measure) return *source.measure;
    std::vector<std::string> names;
    for (const TravelMeasure& measure : travel_measures()) names.emplace_back(measure.name);
    throw UnclearChoice(
        path_.string() + ": the unit of " + source.name() + " cannot be told from its name: " + listed(names),
        names, WheelProblem::unit_unclear);
  }

  WheelTrack read(const WheelSource& source) const {
    const bool fields = source.kind == WheelSource::Kind::fields;
    WheelTrack track = fields ? wheels_of_fields(path_, source, measure_of(source), selection_.counter_range)
                              : read_special(source);
    if (selection_.measure && !fields)
      track.remarks.push_back(
          {"the unit that was stated is not used: " + source.name() + " has one of its own"});
    if (!selection_.joints.left.empty() && source.kind != WheelSource::Kind::joints)
      track.remarks.push_back({"the joints that were stated are not used: " + source.name() + " has none"});
    return track;
  }

  WheelTrack read_special(const WheelSource& source) const {
    if (source.kind == WheelSource::Kind::joints)
      return wheels_of_joints(path_, {source.left.topic, selection_.joints, selection_.further});
    if (!selection_.odometry)
      throw Error(path_.string() + ": the wheels can be worked out from the robot's odometry " +
                      source.name() + " only with the wheelbase that its program uses",
                  WheelProblem::odometry_needs_sizes, {source.name()});
    return wheels_of_odometry(path_, source.left.topic, *selection_.odometry);
  }

  const std::filesystem::path& path_;
  const BagWheelSelection& selection_;
  const std::vector<bag::BagTopic> topics_;
};

}  // namespace

WheelTrack wheels_in_bag(const std::filesystem::path& path, const BagWheelSelection& selection) {
  return BagWheels(path, selection).read();
}

}  // namespace astro::importing
