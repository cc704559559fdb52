// Tables of wheels, and the parameters of controllers (YAML). The first byte says which of them the rest is.
#include <optional>

#include "host/base/error.hpp"
#include "host/import/wheels/diff_drive_yaml.hpp"
#include "host/import/wheels/wheel_csv.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {

void take(ByteView input) {
  if (input.empty()) return;
  const ByteView rest = input.subspan(1);
  try {
    if (input[0] % 2 == 0) {
      importing::diff_drive_parameters(text_of(rest), "x.yaml");
      return;
    }
    const importing::WheelTrack track =
        importing::wheels_in_table(text_of(rest), "x.csv",
                                   {(input[0] & 2) != 0 ? "time_s,left_m,right_m" : "", (input[0] & 4) != 0,
                                    (input[0] & 8) != 0 ? std::optional(100.0) : std::nullopt});
    for (std::size_t i = 1; i < track.samples.size(); ++i)
      require(track.samples[i].time_ns > track.samples[i - 1].time_ns, "times increase");
  } catch (const Error&) {
  }
}

std::vector<Bytes> seeds() {
  std::vector<Bytes> all{
      bytes_of("0a:\n  ros__parameters:\n    left_wheel_names: [\"l\"]\n    wheel_radius: "
               "0.05\n    wheel_separation: &x 0.3\n"),
      bytes_of("1time_s,left_counts,right_counts\n0.5,65000,2\n0.75,3e2,-4\n"),
      bytes_of("3\xEF\xBB\xBF"
               "1.25 2 3\r\n1.5 4 5\r\n"),
      bytes_of("5time_ns;delta_left_deg;delta_right_deg\n1;2;3\n2;3;\n"),
      bytes_of("1sep=;\n# a log\nZeit;t.sec;t.nanosec;wFL;wFR;wRL;wRR\n;s;ns;rpm;rpm;rpm;rpm\n"
               "1;2;3;4,5;6;7;8\n1;2;4;4,5;6;7;8\n"),
      bytes_of("12024-05-01 23:59:59.5\tencL\tencR\n"),
      bytes_of("9time_s left_counts right_counts\n1 98 0\n2 1 99\n")};
  return all;
}

}  // namespace astro::fuzz
