#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/calibration/end_poses/end_pose_csv.hpp"
#include "host/formats/files/bag.hpp"
#include "host/import/bags/pose_topics.hpp"
#include "host/import/bags/wheel_sources.hpp"
#include "host/import/drives/robot_geometry.hpp"
#include "host/import/drives/truth_file.hpp"
#include "host/import/wheels/joint_names.hpp"
#include "host/import/wheels/wheel_csv.hpp"
#include "host/recording/run.hpp"
#include "host/truth/floor/inspection.hpp"

/// What a file of another program contains, before anything is done with it.
namespace astro::importing {

struct TopicInspection {
  bag::BagTopic topic;
  double rate_hz = 0;        // from the first to the last message
  double longest_gap_s = 0;  // between messages
};

struct BagInspection {
  bag::BagReport report;
  std::vector<TopicInspection> topics;
  std::vector<PoseStream> poses;      // ground truth, or a robot's own odometry
  std::optional<PoseStream> truth;    // the one that is taken if none is named; none if that is unclear
  std::vector<std::string> joints;    // of all messages of joints, at most 1000
  std::optional<JointPair> wheels;    // which of them are the wheels, if their names show it
  std::vector<WheelSource> sources;   // of wheels
  std::optional<WheelSource> source;  // the one that is taken if none is named; none if that is unclear
  bool ros1 = false;
  std::optional<recording::RunInfo> run;  // the file is a recording of this project
};

struct WheelInspection {
  WheelTrack track;
  double rate_hz = 0, duration_s = 0, longest_gap_s = 0;
  double left = 0, right = 0;  // travel from the first to the last sample, in the track's unit
  bool end_as_they_begin =
      false;  // both wheels, although they turned: perhaps the rows are travel per interval
};

/// One of these is set; of a table that holds both wheels and poses, two are.
struct FileInspection {
  std::optional<BagInspection> bag;
  std::optional<truth::Inspection> tracker;
  std::optional<WheelInspection> wheels;
  std::optional<RobotGeometry> robot;
  std::optional<calibration::EndPoseTable> end_poses;
};

/// Precondition: the track has a sample.
WheelInspection inspect_wheels(WheelTrack track);

/// Recognises the kind of a file by its content, but that of settings (.toml, .yaml, .yml) by its extension.
/// `table` describes wheels without column names, `truth.columns` a table of ground truth. `truth.poses` selects the one
/// stream of poses of a bag that is inspected as a tracker's recording, which takes 72 bytes of memory for each
/// pose; without it a bag of any size is read in constant memory.
///
/// Throws astro::Error naming the file if it is none of these, and what the readers throw.
FileInspection inspect_file(const std::filesystem::path& path, const WheelTable& table = {},
                            const TruthSelection& truth = {});

}  // namespace astro::importing
