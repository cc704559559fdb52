// Reading bags and tables of wheels: megabytes a second of processor time beside their bars, and memory. Packed MCAP counts
// by what is in it, everything else by the size of the file. Fails if a bar is missed.

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <ctime>
#include <filesystem>
#include <fstream>
#include <random>

#include "host/formats/files/bag.hpp"
#include "host/formats/files/sqlite.hpp"
#include "host/formats/messages/stamped_pose.hpp"
#include "host/import/drives/file_inspection.hpp"
#include "host/import/drives/truth_file.hpp"
#include "host/import/drives/wheel_file.hpp"
#include "tests/host/import/drives/file_samples.hpp"

namespace {

using namespace astro;
namespace fs = std::filesystem;

constexpr int kMessages = 1'000'000;

double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// The transforms of a tracker at 240 Hz, with noise in the last digits as a tracker has it.
class Poses {
 public:
  Bytes next() {
    const double noise = std::normal_distribution(0.0, 1e-4)(random_);
    return ros2::encode_tf({{at_ += 4'166'667, "map", "robot", 1 + noise, 2 - noise, noise, 0, 0, noise, 1}});
  }
  std::int64_t at() const { return at_; }

 private:
  std::mt19937_64 random_{1};
  std::int64_t at_ = 1'700'000'000'000'000'000;
};

Bytes mcap_file(const std::string& compression) {
  test::McapBag bag(compression);
  bag.topic(1, "/mocap/tf", test::kTfType);
  Poses poses;
  for (int i = 0; i < kMessages; ++i) {
    const Bytes message = poses.next();
    bag.message(1, poses.at(), message);
    if (bag.open_bytes() > (std::size_t{1} << 20)) bag.end_chunk();
  }
  return bag.closed();
}

void write_database(const fs::path& path) {
  sqlite3* raw = nullptr;
  sqlite3_open(path.c_str(), &raw);
  const bag::Database database(raw);
  sqlite3_exec(
      raw,
      "PRAGMA journal_mode=OFF;PRAGMA synchronous=OFF;CREATE TABLE topics(id INTEGER PRIMARY KEY,name "
      "TEXT,type "
      "TEXT,serialization_format TEXT);CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT "
      "NULL,timestamp INTEGER NOT NULL,data BLOB NOT NULL);CREATE INDEX timestamp_idx ON messages(timestamp);"
      "INSERT INTO topics VALUES(1,'/mocap/tf','tf2_msgs/msg/TFMessage','cdr');BEGIN",
      nullptr, nullptr, nullptr);
  bag::Statement insert(raw, "INSERT INTO messages(topic_id,timestamp,data) VALUES(1,?,?)");
  Poses poses;
  for (int i = 0; i < kMessages; ++i) {
    const Bytes message = poses.next();
    insert.bind(1, poses.at());
    insert.bind(2, ByteView(message));
    insert.step();
    insert.reset();
  }
  sqlite3_exec(raw, "COMMIT", nullptr, nullptr, nullptr);
}

void write_table(const fs::path& path) {
  std::ofstream out(path);
  out << "time_s,left_counts,right_counts\n";
  for (int i = 0; i < 4 * kMessages; ++i)
    out << fmt::format("{}.{:06},{},{}\n", 1000 + i / 1000, i % 1000 * 1000, 7 * i, 8 * i);
}

/// Prints what `work` reads of so many bytes in a second; whether it reaches its bar.
template <class Work>
bool reaches(const char* what, double bar_mbps, double bytes, Work work) {
  const double before_mb = memory_mb(), start_s = cpu_s();
  work();
  const double speed_mbps = bytes / (cpu_s() - start_s) * 1e-6;
  fmt::print("{:34} {:6.0f} MB/s (bar {:.0f}) of {:.0f} MB, {:.0f} MB more memory\n", what, speed_mbps,
             bar_mbps, 1e-6 * bytes, memory_mb() - before_mb);
  return speed_mbps >= bar_mbps;
}

void decode_all(const fs::path& path) {
  int poses = 0;
  bag::BagHandlers handlers;
  handlers.message = [&](const bag::BagTopic& topic, const bag::BagMessage& message) {
    poses += static_cast<int>(ros2::poses_in(topic.type, message.data)->size());
  };
  bag::read_bag(path, handlers);
  if (poses != kMessages) throw std::runtime_error("not all poses were read");
}

/// All that is done with bags: their messages decoded, the file inspected, the poses imported.
bool bag_reaches(const std::string& name, double bar_mbps, double bytes, const fs::path& path) {
  bool good = reaches((name + ", messages decoded").c_str(), bar_mbps, bytes, [&] { decode_all(path); });
  good = reaches((name + ", inspected").c_str(), bar_mbps, bytes, [&] { importing::inspect_file(path); }) &&
         good;
  return reaches((name + ", poses imported").c_str(), bar_mbps, bytes,
                 [&] { importing::read_truth(path); }) &&
         good;
}

}  // namespace

int main() {
  const fs::path folder = fs::temp_directory_path() / "astro-bag-bench";
  fs::create_directories(folder);
  const fs::path stored = folder / "stored.mcap", packed = folder / "packed.mcap",
                 database = folder / "x.db3", table = folder / "x.csv";
  fs::remove(database);
  write_database(database);
  write_table(table);
  const pid_t writer = fork();  // so that the memory of what is written does not count
  if (writer == 0) {
    test::save(stored, mcap_file(""));
    test::save(packed, mcap_file("zstd"));
    _exit(0);
  }
  waitpid(writer, nullptr, 0);
  const auto size = [](const fs::path& path) { return static_cast<double>(fs::file_size(path)); };
  bool good = bag_reaches("MCAP", 100, size(stored), stored);
  good = bag_reaches("MCAP of zstd", 100, size(stored), packed) && good;
  good = bag_reaches("db3", 50, size(database), database) && good;
  good = reaches("CSV of wheels", 50, size(table), [&] { importing::read_wheels(table); }) && good;
  good =
      reaches("CSV of wheels, inspected", 50, size(table), [&] { importing::inspect_file(table); }) && good;
  fs::remove_all(folder);
  return good ? 0 : 1;
}
