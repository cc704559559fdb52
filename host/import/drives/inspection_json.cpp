#include "host/import/drives/inspection_json.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace astro::importing {
namespace {

nlohmann::json number(const std::optional<double>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

nlohmann::json facts_of(const std::vector<Remark>& remarks) {
  nlohmann::json json = nlohmann::json::array();
  for (const Remark& remark : remarks) json.push_back(remark.sentence);
  return json;
}

nlohmann::json axis_json(const std::optional<truth::Direction3>& axis) {
  return axis ? nlohmann::json(*axis) : nlohmann::json();
}

nlohmann::json body_json(const truth::BodyInspection& body) {
  nlohmann::json json = {{"name", body.name.name},
                         {"id", body.name.id},
                         {"format", body.facts.format},
                         {"length_unit", body.facts.length_unit},
                         {"rotation", body.facts.rotation},
                         {"start_time", body.facts.start_time},
                         {"samples", body.samples},
                         {"duration_s", body.duration_s},
                         {"median_period_s", body.median_period_s},
                         {"lost", body.lost.all()},
                         {"gaps", body.gaps},
                         {"longest_gap_s", body.longest_gap_s},
                         {"up_by_positions", axis_json(body.up.by_positions)},
                         {"up_by_rotations", axis_json(body.up.by_rotations)},
                         {"noise", nullptr},
                         {"remarks", facts_of(body.facts.remarks)}};
  if (body.noise)
    json["noise"] = {
        {"rest_s", body.noise->rest_s}, {"sd_m", body.noise->sd_m}, {"sd_rad", body.noise->sd_rad}};
  return json;
}

nlohmann::json bag_json(const BagInspection& bag) {
  nlohmann::json topics = nlohmann::json::array(), poses = nlohmann::json::array();
  for (const importing::TopicInspection& one : bag.topics)
    topics.push_back({{"name", one.topic.name},
                      {"type", one.topic.type},
                      {"messages", one.topic.messages},
                      {"first_ns", one.topic.first_ns},
                      {"last_ns", one.topic.last_ns},
                      {"rate_hz", one.rate_hz},
                      {"longest_gap_s", one.longest_gap_s}});
  for (const importing::PoseStream& stream : bag.poses)
    poses.push_back({{"topic", stream.topic},
                     {"frame", stream.frame},
                     {"child_frame", stream.child_frame},
                     {"poses", stream.poses}});
  nlohmann::json sources = nlohmann::json::array();
  for (const importing::WheelSource& source : bag.sources)
    sources.push_back({{"name", source.name()},
                       {"unit", source.measure ? nlohmann::json(source.measure->name) : nlohmann::json()},
                       {"taken", bag.source && bag.source->name() == source.name()}});
  nlohmann::json wheels;
  if (bag.wheels) wheels = {{"left", bag.wheels->left}, {"right", bag.wheels->right}};
  return {{"kind", "bag"},
          {"topics", topics},
          {"poses", poses},
          {"joints", bag.joints},
          {"wheels", wheels},
          {"wheel_sources", sources},
          {"truncated", bag.report.truncated},
          {"damaged", bag.report.damaged},
          {"warnings", facts_of(bag.report.warnings)}};
}

nlohmann::json tracker_json(const truth::Inspection& tracker) {
  nlohmann::json bodies = nlohmann::json::array();
  for (const truth::BodyInspection& body : tracker.bodies) bodies.push_back(body_json(body));
  return {{"kind", "tracker"}, {"bodies", bodies}, {"bodies_left_out", tracker.bodies_left_out}};
}

constexpr const char* name_of(WheelClock clock) {
  return clock == WheelClock::file ? "file" : clock == WheelClock::stamp ? "stamp" : "receipt";
}

nlohmann::json wheels_json(const WheelInspection& wheels) {
  return {{"kind", "wheels"},
          {"unit", unit_name(wheels.track.unit)},
          {"columns",
           {{"time", wheels.track.columns.time},
            {"left", wheels.track.columns.left},
            {"right", wheels.track.columns.right},
            {"values", wheels.track.columns.values}}},
          {"clock", name_of(wheels.track.clock)},
          {"joints", {{"left", wheels.track.joints.left}, {"right", wheels.track.joints.right}}},
          {"odometry", wheels.track.odometry},
          {"samples", wheels.track.samples.size()},
          {"duration_s", wheels.duration_s},
          {"rate_hz", wheels.rate_hz},
          {"longest_gap_s", wheels.longest_gap_s},
          {"left", wheels.left},
          {"right", wheels.right},
          {"remarks", facts_of(wheels.track.remarks)}};
}

}  // namespace

nlohmann::json inspection_json(const FileInspection& found) {
  if (found.bag) return bag_json(*found.bag);
  if (found.tracker && found.wheels)
    return {{"kind", "wheels and poses"},
            {"wheels", wheels_json(*found.wheels)},
            {"tracker", tracker_json(*found.tracker)}};
  if (found.tracker) return tracker_json(*found.tracker);
  if (found.wheels) return wheels_json(*found.wheels);
  if (found.end_poses) return {{"kind", "end poses"}, {"runs", found.end_poses->poses.size()}};
  const RobotGeometry& robot = *found.robot;
  return {{"kind", "robot"},
          {"wheel_diameter_m", number(robot.wheel_diameter_m)},
          {"counts_per_turn", number(robot.counts_per_turn)},
          {"wheelbase_m", number(robot.wheelbase_m)},
          {"c_R", robot.c_r},
          {"c_L", robot.c_l},
          {"e", robot.e},
          {"kappa0", robot.kappa0},
          {"left_joint", robot.joints.left},
          {"right_joint", robot.joints.right}};
}

}  // namespace astro::importing
