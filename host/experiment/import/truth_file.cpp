#include "host/experiment/import/truth_file.hpp"

#include "host/base/bytes.hpp"
#include "host/experiment/import/text_file.hpp"
#include "host/recording/bag/bag.hpp"
#include "host/truth/bags/bag_truth.hpp"
#include "host/truth/files/rotations.hpp"
#include "host/truth/files/tracker_file.hpp"

namespace astro::experiment {
namespace {

truth::BodyTrack read(const std::filesystem::path& path, const TruthSelection& selection) {
  if (recording::is_bag(path)) return truth::track_in_bag(path, selection.poses);
  const Bytes text = text_of_file(path);
  return truth::read_track(as_text(text), path.string(), selection.body);
}

void change_unit(truth::BodyTrack& track, const std::string& unit) {
  const double stated = truth::metres_per(track.facts.length_unit).value_or(1);
  const double factor = truth::metres_per(unit).value() / stated;
  for (truth::TrackedPose& sample : track.samples) {
    sample.pose.x_m *= factor;
    sample.pose.y_m *= factor;
    sample.pose.z_m *= factor;
  }
  track.facts.length_unit = unit;
}

}  // namespace

ImportedTruth read_truth(const std::filesystem::path& path, const TruthSelection& selection) {
  ImportedTruth truth{read(path, selection), {}};
  if (!selection.length_unit.empty()) change_unit(truth.track, selection.length_unit);
  truth.lost = truth::mark_lost(truth.track);
  return truth;
}

}  // namespace astro::experiment
