// Tables that people type or trackers export: end poses of one direction or both, and ground truth of a run.
#include "host/base/error.hpp"
#include "host/calibration/end_poses/end_pose_csv.hpp"
#include "host/truth/files/file_source.hpp"
#include "tests/fuzz/input_file.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {
namespace {

template <class Read>
void reading(Read read) {
  try {
    read();
  } catch (const Error&) {
  }
}

recording::Run standing_for_three_seconds() {
  recording::Run run;
  run.info.kind = "line";
  for (int i = 0; i < 30; ++i) run.odometry.push_back({100'000 * i, 0, 0, 0, 0, 0, 0, 0});
  return run;
}

}  // namespace

void take(ByteView input) {
  const std::string_view text = text_of(input);
  reading([&] { require(!calibration::read_end_poses(text, "x.csv").poses.empty(), "a table has rows"); });
  static const recording::Run run = standing_for_three_seconds();
  static const InputFile file(truth::truth_file_name(run.info));
  file.holding(input);
  truth::FileSource source(file.folder(), [](const truth::Question& question) -> std::string {
    throw Error(question.occasion.sentence + question.text);
  });
  reading([&] {
    const auto samples = source.complete(run);
    for (const recording::TruthSample& sample : *samples)
      require(sample.time_us >= 0 && sample.time_us <= 2'900'000, "truth lies within its run");
  });
}

std::vector<Bytes> seeds() {
  return {bytes_of("ex_mm,ey_mm,etheta_rad\n300,-250,0.17\n310,-260,0.18\n"),
          bytes_of("run,direction,x_err_m,y_err_m,heading_err_deg\n1,cw,0.3,-0.2,1\n2,ccw,\"0.3\",-0.2,\r\n"),
          bytes_of("\xEF\xBB\xBFx_m,y_m,theta_deg\n0,0,0\n0.5,0.1,3\n1,0.2,6\n"), bytes_of("a;b\n1,5;2\n")};
}

}  // namespace astro::fuzz
