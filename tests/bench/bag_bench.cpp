// Reading bags and tables of wheels: megabytes a second of processor time beside their bars, and memory. Fails if a bar
// is missed.

#include <fmt/format.h>
#include <sys/resource.h>

#include <ctime>
#include <filesystem>
#include <fstream>
#include <random>

#include "host/recording/bag/bag.hpp"
#include "host/recording/bag/sqlite.hpp"
#include "host/recording/foreign/wheel_csv.hpp"
#include "host/recording/mcap/writer.hpp"
#include "host/ros2/stamped_pose.hpp"

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

void write_mcap(const fs::path& path) {
  std::ofstream out(path, std::ios::binary);
  recording::McapWriter writer(
      [&](ByteView bytes) {
        out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
      },
      {"ros2", "bench"});
  const auto channel =
      writer.add_channel(writer.add_schema("tf2_msgs/msg/TFMessage", "ros2msg", ""), "/tf", "cdr", {});
  Poses poses;
  for (int i = 0; i < kMessages; ++i) {
    const Bytes message = poses.next();
    writer.write(channel, static_cast<std::uint64_t>(poses.at()), message);
  }
  writer.close();
}

void write_database(const fs::path& path) {
  sqlite3* raw = nullptr;
  sqlite3_open(path.c_str(), &raw);
  const recording::Database database(raw);
  sqlite3_exec(
      raw,
      "PRAGMA journal_mode=OFF;PRAGMA synchronous=OFF;CREATE TABLE topics(id INTEGER PRIMARY KEY,name "
      "TEXT,type "
      "TEXT,serialization_format TEXT);CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT "
      "NULL,timestamp INTEGER NOT NULL,data BLOB NOT NULL);CREATE INDEX timestamp_idx ON messages(timestamp);"
      "INSERT INTO topics VALUES(1,'/tf','tf2_msgs/msg/TFMessage','cdr');BEGIN",
      nullptr, nullptr, nullptr);
  recording::Statement insert(raw, "INSERT INTO messages(topic_id,timestamp,data) VALUES(1,?,?)");
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

/// Prints the figure; whether it reaches its bar.
template <class Read>
bool reaches(const char* what, double bar_mbps, const fs::path& path, Read read) {
  const double start_s = cpu_s();
  const auto bytes = static_cast<double>(read());
  const double speed_mbps = bytes / (cpu_s() - start_s) * 1e-6;
  fmt::print("{:32} {:7.0f} MB/s (bar {:.0f}), file {:.0f} MB, most memory so far {:.0f} MB\n", what,
             speed_mbps, bar_mbps, static_cast<double>(fs::file_size(path)) * 1e-6, memory_mb());
  return speed_mbps >= bar_mbps;
}

/// The bytes of all messages whose poses were decoded.
std::uint64_t decode_all(const fs::path& path) {
  std::uint64_t bytes = 0, poses = 0;
  recording::BagHandlers handlers;
  handlers.message = [&](const recording::BagTopic& topic, const recording::BagMessage& message) {
    bytes += message.data.size();
    poses += ros2::poses_in(topic.type, message.data)->size();
  };
  recording::read_bag(path, handlers);
  if (poses != kMessages) throw std::runtime_error("not all poses were read");
  return bytes;
}

}  // namespace

int main() {
  const fs::path folder = fs::temp_directory_path() / "astro-bag-bench";
  fs::create_directories(folder);
  const fs::path mcap = folder / "x.mcap", database = folder / "x.db3", table = folder / "x.csv";
  fs::remove(database);
  write_mcap(mcap);
  write_database(database);
  write_table(table);
  const double before_mb = memory_mb();
  // Bytes of messages, not of the file: an MCAP file is compressed.
  bool good = reaches("MCAP, messages decoded", 100, mcap, [&] { return decode_all(mcap); });
  good = reaches("db3, messages decoded", 50, database, [&] { return decode_all(database); }) && good;
  good = reaches("db3, file counted", 50, database,
                 [&] {
                   recording::read_bag(database);
                   return fs::file_size(database);
                 }) &&
         good;
  const double bags_mb = memory_mb() - before_mb;
  fmt::print("bags took {:.0f} MB of memory (bar 32)\n", bags_mb);
  good = reaches("CSV of wheels", 50, table,
                 [&] {
                   FileSource source(table);
                   recording::wheels_in_table(source, table.string());
                   return fs::file_size(table);
                 }) &&
         good;
  fs::remove_all(folder);
  return good && bags_mb <= 32 ? 0 : 1;
}
