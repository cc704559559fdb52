#pragma once

#include <filesystem>
#include <string>

#include "host/import/wheels/pose_topics.hpp"
#include "host/truth/files/body_track.hpp"
#include "host/truth/floor/lost_tracking.hpp"

namespace astro::importing {

/// What a person says about files of ground truth; what is not said is recognised.
struct TruthSelection {
  std::string body;         // of recordings of trackers as text
  PoseSelection poses;      // of bags
  std::string length_unit;  // "m", "cm", "mm" in place of what the file says; "" if it is right
};

struct ImportedTruth {
  truth::BodyTrack track;  // in which lost samples are marked
  truth::LostSamples lost;
};

/// The poses of one body in a recording of a tracker as text, also packed with gzip, or in a bag, by the content of
/// the file. Throws as track_in_bag, read_track and unpacked do.
ImportedTruth read_truth(const std::filesystem::path& path, const TruthSelection& selection = {});

}  // namespace astro::importing
