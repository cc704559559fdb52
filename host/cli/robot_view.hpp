#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/protocol/session.hpp"
#include "common/protocol/status.hpp"
#include "host/recording/planar_pose.hpp"

/// What the robot says, in words and keys that all commands share.
namespace astro::cli {

/// Keys keep the order in which a person would ask.
using Json = nlohmann::ordered_json;

/// To stdout as it stands; print adds a newline. Throws astro::Error if stdout takes no more.
/// To stdout. Throws astro::Error if this, or anything before it, could not be written.
void write(const std::string& text);
void print(const std::string& text);
void print_json(const Json& json);

std::string firmware_version(const protocol::HelloReply& robot);
std::string hex_id(const protocol::HelloReply& robot);

std::vector<std::string> fault_list(std::uint32_t mask);

/// "none" or the names.
std::string faults_in_words(std::uint32_t mask);

/// "2 h 03 min 10 s", "12.3 s".
std::string duration_in_words(std::uint64_t us);

Json to_json(const recording::PlanarPose& pose);

/// "x 1.0000 m   y -0.0003 m   heading 0.02 deg".
std::string in_words(const recording::PlanarPose& pose);

}  // namespace astro::cli
