#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "common/protocol/session.hpp"
#include "common/protocol/status.hpp"
#include "common/safety/fault.hpp"
#include "host/base/pose2.hpp"

/// What the robot reports, in words and JSON keys that all commands share.
namespace astro::commands {

/// Keys keep the order in which a person would ask.
using Json = nlohmann::ordered_json;

/// To stdout, through plain_text; print adds a newline. Throws astro::Error if this, or anything before it,
/// could not be written.
void write(const std::string& text);
void print(const std::string& text);

/// Unchanged if a program reads stdout, because it may open the path; through plain_text on a terminal.
void print_path(const std::filesystem::path& path);

/// Valid JSON whatever the texts contain: texts of a robot or a file may be invalid UTF-8.
template <class AnyJson>
void print_json(const AnyJson& json) {
  print(json.dump(2, ' ', false, AnyJson::error_handler_t::replace));
}

/// Flushes stdout. Throws astro::Error if it cannot be written: output that is lost on a full disk must not
/// look like a result.
void flush_output();

std::string hex_id(const protocol::HelloReply& robot);

std::vector<std::string> fault_list(std::uint32_t mask);

/// "none" or the names.
std::string faults_in_words(std::uint32_t mask);

/// What a fault means and what to check. "" for a fault that this version does not know.
std::string_view fault_help(Fault fault);

/// "2 h 03 min 10 s", "12.3 s".
std::string duration_in_words(std::uint64_t us);

Json to_json(const Pose2& pose);

/// "x 1.0000 m   y -0.0003 m   heading 0.02 deg".
std::string in_words(const Pose2& pose);

/// "x  1.000 m  y  0.000 m   0.0 deg", for lines that change all the time.
std::string in_short_words(const Pose2& pose);

}  // namespace astro::commands
