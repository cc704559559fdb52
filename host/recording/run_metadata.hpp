#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "host/formats/files/mcap_records.hpp"
#include "host/recording/run.hpp"

/// What a recording says about its run: the MCAP Metadata record "astrolabe.run", a map of strings. Numbers
/// are shortest decimals, so they read back bit for bit; parameters have keys "parameter.<name>".
namespace astro::recording {

inline constexpr std::string_view kRunRecordName = "astrolabe.run";

/// RunInfo and what the messages cannot hold: a quaternion does not hold whole turns of a heading, so the
/// first finite heading of each stream is here. Absent in a recording that was cut off.
struct RunRecord {
  RunInfo info;
  std::optional<double> first_odometry_heading_rad, first_truth_heading_rad;
};

bag::mcap::Map to_map(const RunRecord& record);

/// Missing keys keep their defaults and unknown keys are ignored. Throws astro::Error naming `file` if a
/// value does not have the type of its key or the recording has a newer format.
RunRecord run_record(const bag::mcap::Map& map, const std::string& file);

/// The name of a run in messages: "run square cw 3 (before)", without the parts that it lacks.
std::string run_name(const RunInfo& info);

}  // namespace astro::recording
