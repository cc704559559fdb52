#pragma once

#include <filesystem>
#include <string>

#include "host/import/bags/pose_topics.hpp"
#include "host/truth/files/body_track.hpp"
#include "host/truth/floor/lost_tracking.hpp"

namespace astro::importing {

/// What a person states about files of ground truth; all else is recognised.
struct TruthSelection {
  std::string body = {};         // in text recordings of trackers
  std::string columns = {};      // of a table (host/formats/tables/stated_columns.hpp); "": as its names say
  PoseSelection poses = {};      // in bags
  std::string length_unit = {};  // "m", "cm", "mm": overrides the unit in the file; "": does not
};

struct ImportedTruth {
  truth::BodyTrack track;  // in which lost samples are marked
  truth::LostSamples lost;
};

/// The poses of one body in a text recording of a tracker (also compressed with gzip) or in a bag; the
/// content shows which it is. Throws as track_in_bag, read_track and unpacked do.
ImportedTruth read_truth(const std::filesystem::path& path, const TruthSelection& selection = {});

}  // namespace astro::importing
