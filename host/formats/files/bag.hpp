#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/base/bytes.hpp"
#include "host/base/error.hpp"
#include "host/formats/cdr/message_layout.hpp"

/// Bags, the recordings of ROS: those of ROS 2 in either of their two storages, and those of ROS 1, whatever
/// their compression, read in one pass from front to back in constant memory.
namespace astro::bag {

/// Why something is no bag or cannot become one. Values: the file or the folder; then of no_such_table and
/// computed_columns the table, of too_many_files how many a bag may have, of old_version the version.
enum class BagProblem {
  missing,
  not_a_bag,
  no_files,
  too_many_files,
  unreadable_database,
  no_such_table,
  computed_columns,
  old_version,
  folder_not_empty
};

/// A topic of ROS 1 has the name that its type has in ROS 2, and its messages are passed on as CDR; only if
/// its definition cannot be read, they stay as they are and the encoding is "ros1".
struct BagTopic {
  std::string name, type;  // "/tf", "tf2_msgs/msg/TFMessage"
  std::string encoding;    // of the messages: "cdr" for those of ROS
  std::uint64_t messages = 0;
  std::int64_t first_ns = 0, last_ns = 0;                  // the least and the greatest log time
  std::shared_ptr<const ros2::MessageLayout> layout = {};  // null if the bag does not define the type

  bool operator==(const BagTopic& other) const {
    return name == other.name && type == other.type && encoding == other.encoding &&
           messages == other.messages && first_ns == other.first_ns && last_ns == other.last_ns;
  }
};

/// One message. The log time is when the recorder received it; most messages have a stamp of their publisher inside.
struct BagMessage {
  std::int64_t log_time_ns = 0;
  ByteView data;  // valid during the call
};

struct BagHandlers {
  /// Which topics' messages are passed on; if it is empty, all are. Asked at least once for each topic.
  std::function<bool(const BagTopic&)> wants;
  /// Called in the order of the file. If it is empty, messages are only counted.
  std::function<void(const BagTopic&, const BagMessage&)> message;
};

struct BagReport {
  std::vector<std::filesystem::path> files;  // in the order in which they were read
  std::vector<BagTopic> topics;              // in the order of the file
  bool truncated = false;                    // an end is missing; what is before it was read
  bool damaged = false;                      // something inside is wrong and was left out
  /// The first few reasons. Each names the file, which is also its first value. The kind is a BagDamage or an McapProblem.
  std::vector<Remark> warnings;
};

/// Whether the path looks like a bag by its content: a file that begins like an SQLite database, an MCAP
/// file, a bag of ROS 1 or zstd, or a folder that has parts of bags of ROS 2.
bool is_bag(const std::filesystem::path& path);

/// Reads a `.db3`, `.mcap` or ROS 1 `.bag` file, one of those compressed as a whole (`.zstd`), or a folder
/// with any number of the first two and perhaps a metadata.yaml, which then tells their order. Messages that
/// are compressed one by one are expanded. Temporary files are made below TMPDIR for files compressed as a
/// whole, and for databases whose recorder was killed (they have a non-empty -wal or -journal beside them);
/// the bag itself is never written to.
///
/// Limits  nothing expands to more than 256 times its file and 64 MiB.
/// Errors  astro::Error naming the file if it does not exist, cannot be read or is no bag. What the handlers throw
///         passes through.
BagReport read_bag(const std::filesystem::path& path, const BagHandlers& handlers = {});

}  // namespace astro::bag
