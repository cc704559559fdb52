// What comes from a laser scanner (RPLIDAR) at a serial port: measurements in their three forms, and answers before them.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host/truth/scanners/rplidar_turns.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {
namespace {

using namespace truth::rplidar;  // NOLINT(google-build-using-namespace): this file is all RPLIDAR

constexpr std::array kForms{AnswerType::nodes, AnswerType::capsules, AnswerType::dense_capsules};

struct Result {
  std::vector<Node> nodes;
  std::int64_t skipped = 0;

  bool operator==(const Result&) const = default;
};

Result read(AnswerType form, ByteView input, std::size_t piece) {
  NodeReader reader(form);
  Result result;
  for (std::size_t at = 0; at < input.size(); at += piece) {
    const std::vector<Node> nodes = reader.take(input.subspan(at, std::min(piece, input.size() - at)));
    result.nodes.insert(result.nodes.end(), nodes.begin(), nodes.end());
  }
  result.skipped = reader.skipped_bytes();
  require(reader.received() >= static_cast<std::int64_t>(result.nodes.size()), "no measurement is invented");
  require(result.skipped <= static_cast<std::int64_t>(input.size()), "no more bytes are skipped than came");
  return result;
}

void assemble(AnswerType form, ByteView input) {
  NodeReader reader(form);
  TurnAssembler turns(5e-4, 1e-3, {0.15, 12});
  std::int64_t now_us = 0, last_ns = std::numeric_limits<std::int64_t>::min();
  for (std::size_t at = 0; at < input.size(); at += 100) {
    now_us += 10'000;
    const std::vector<Node> nodes =
        reader.take(input.subspan(at, std::min<std::size_t>(100, input.size() - at)));
    turns.add(nodes, reader.received(), std::chrono::microseconds(now_us));
    for (const lidar::Scan& scan : turns.take()) {
      require(scan.time_ns > last_ns, "scans come in order of time");
      last_ns = scan.time_ns;
      require(std::isfinite(scan.first_angle_rad) && scan.angle_step_rad < 0, "a turn goes round clockwise");
      for (const float range_m : scan.ranges_m)
        require(std::isnan(range_m) || (range_m > 0 && range_m < 100), "a beam ends somewhere");
    }
  }
}

}  // namespace

void take(ByteView input) {
  for (const AnswerType form : kForms) {
    require(read(form, input, input.size() + 1) == read(form, input, 7),
            "the pieces in which bytes arrive make no difference");
    assemble(form, input);
    find_descriptor(input, form);
  }
  Bytes requests(input.begin(), input.end());
  while (take_request(requests)) {
  }
}

std::vector<Bytes> seeds() {
  std::vector<Node> nodes;
  for (int i = 0; i < 720; ++i) nodes.push_back({i % 360 * 0.01745, 2 + 0.001 * i, i, i % 360 == 0});
  std::vector<Bytes> all(kForms.size());
  for (const Node& node : nodes) append(all[0], node_bytes(node));
  for (std::size_t form = 1; form < kForms.size(); ++form) {
    const std::size_t count = nodes_of(kForms[form]);
    for (std::size_t at = 0; at + count <= nodes.size(); at += count)
      append(all[form], capsule_bytes(kForms[form], std::span(nodes).subspan(at, count), at == 0));
  }
  all.push_back(request(Command::express_scan, kExpressPayload));
  all.push_back(to_bytes(Descriptor{AnswerType::nodes, 5, true}));
  return all;
}

}  // namespace astro::fuzz
