#include "host/import/drives/truth_file.hpp"

#include <vector>

#include "host/base/bytes.hpp"
#include "host/formats/files/bag.hpp"
#include "host/formats/tables/text_file.hpp"
#include "host/formats/tables/units.hpp"
#include "host/import/drives/bag_truth.hpp"
#include "host/import/drives/robot_geometry.hpp"
#include "host/truth/files/tracker_file.hpp"

namespace astro::importing {
namespace {

truth::BodyTrack read(const std::filesystem::path& path, const TruthSelection& selection) {
  if (bag::is_bag(path)) return track_in_bag(path, selection.poses);
  const Bytes text = tables::text_of_file(path);
  return truth::read_track(as_text(text), path.string(), selection.body, selection.columns);
}

void change_unit(truth::BodyTrack& track, const std::string& unit) {
  const double stated = tables::metres_per(track.facts.length_unit).value_or(1);
  const double factor = tables::metres_per(unit).value() / stated;
  for (truth::TrackedPose& sample : track.samples) {
    sample.pose.x_m *= factor;
    sample.pose.y_m *= factor;
    sample.pose.z_m *= factor;
  }
  track.facts.length_unit = unit;
  std::erase_if(track.facts.remarks, [](const Remark& remark) {
    return remark.kind == Kind(truth::TrackRemark::length_unit_assumed);
  });
}

}  // namespace

ImportedTruth read_truth(const std::filesystem::path& path, const TruthSelection& selection) {
  ImportedTruth truth{read(path, selection), {}};
  if (const std::size_t poses = truth.track.samples.size(); poses < 2)
    throw Error("'" + path.string() + "' has " + (poses == 0 ? "no poses" : "a single pose") +
                    ": the ground truth of a drive follows it from its start to its end",
                ImportProblem::no_poses, {path.string(), std::to_string(poses)});
  if (!selection.length_unit.empty()) change_unit(truth.track, selection.length_unit);
  truth.lost = truth::mark_lost(truth.track);
  return truth;
}

}  // namespace astro::importing
