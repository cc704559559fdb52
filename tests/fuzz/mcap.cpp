// Recordings: the container with all that it holds, and a run put together from it. The first byte says
// whether the rest is a file, or the content of a chunk of an otherwise intact file, behind its checksums.
#include "host/base/error.hpp"
#include "host/formats/files/mcap_reader.hpp"
#include "host/formats/files/mcap_writer.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/recording/run_file.hpp"
#include "host/recording/run_metadata.hpp"
#include "host/recording/sample_messages.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {
namespace {

using namespace bag;        // NOLINT(google-build-using-namespace): this file is all recordings
using namespace recording;  // NOLINT(google-build-using-namespace): this file is all recordings
using fuzz::Bytes;
using fuzz::ByteView;

Bytes file_around(ByteView chunk) {
  Bytes file(std::begin(mcap::kMagic), std::end(mcap::kMagic));
  mcap::append_record(file, mcap::Op::header, mcap::encode(mcap::Header{"ros2", "fuzz"}));
  mcap::append_record(file, mcap::Op::metadata,
                      mcap::encode(mcap::Metadata{std::string(kRunRecordName), to_map(RunRecord{})}));
  mcap::append_record(file, mcap::Op::chunk, mcap::encode(mcap::Chunk{0, 0, chunk.size(), 0, "", chunk}));
  return file;
}

void read(ByteView file) {
  McapHandlers handlers;
  handlers.message = [](const mcap::Channel&, const mcap::Schema*, const mcap::Message&) {};
  handlers.metadata = [](const mcap::Metadata&) {};
  read_mcap(file, handlers);
  try {
    const Run run = run_from_bytes(file, "x.mcap");
    require(run.odometry.size() <= file.size() * 256, "no more samples than bytes of chunks");
  } catch (const Error&) {
  }
}

Run small_run() {
  Run run;
  run.info.kind = "line";
  for (int i = 0; i < 5; ++i) {
    run.odometry.push_back({1000 * i, 0.1 * i, 0, 0.01 * i, 0.1, 0, 100 * i, 100 * i});
    run.truth.push_back({1000 * i, 0.1 * i, 0, 0.01 * i, true});
  }
  return run;
}

Bytes chunk_of(const Run& run) {
  Bytes chunk;
  const auto topic = [&](std::uint16_t id, const char* name, const ros2::RosType& type) {
    mcap::append_record(chunk, mcap::Op::schema,
                        mcap::encode(mcap::Schema{id, std::string(type.name), "ros2msg", "x"}));
    mcap::append_record(chunk, mcap::Op::channel, mcap::encode(mcap::Channel{id, id, name, "cdr", {}}));
  };
  topic(1, "/odom", ros2::odometry_type());
  topic(2, "/wheel_counts", recording::wheel_counts_type());
  topic(3, "/truth", ros2::pose_stamped_type());
  const auto message = [&](std::uint16_t channel, const Bytes& data) {
    mcap::append_message(chunk, {channel, 0, 0, 0, data});
  };
  for (const OdometrySample& sample : run.odometry) {
    message(1, recording::encode_odometry(sample));
    message(2, recording::encode_counts({sample.time_us, sample.left_counts, sample.right_counts}));
  }
  for (const TruthSample& sample : run.truth) message(3, recording::encode_truth(sample));
  return chunk;
}

}  // namespace

void take(ByteView input) {
  if (input.empty()) return;
  const ByteView rest = input.subspan(1);
  if (input[0] % 2 == 0) return read(rest);
  const Bytes file = file_around(rest);
  read(file);
}

std::vector<Bytes> seeds() {
  const Run run = small_run();
  std::vector<Bytes> all(2);
  all[0].push_back(0);
  McapWriter writer([&](ByteView bytes) { all[0].insert(all[0].end(), bytes.begin(), bytes.end()); },
                    {"ros2", "fuzz"});
  const auto schema = writer.add_schema(ros2::odometry_type().name, "ros2msg", "x");
  const auto channel = writer.add_channel(schema, "/odom", "cdr", {{"key", "value"}});
  writer.write_metadata({std::string(kRunRecordName), to_map({run.info, {}, {}})});
  for (const OdometrySample& sample : run.odometry)
    writer.write(channel, 0, recording::encode_odometry(sample));
  writer.close();
  all[1] = chunk_of(run);
  all[1].insert(all[1].begin(), 1);
  all.push_back(file_around(chunk_of(run)));
  all.back().insert(all.back().begin(), 0);
  return all;
}

}  // namespace astro::fuzz
