#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "host/formats/files/topic_table.hpp"

/// Bags of ROS 1, format 2.0: a line of text, then records. A record is the length of its head (u32), fields
/// ("name=value", each behind its length), the length of its data (u32), and the data. Chunks hold records of
/// connections and messages; what is behind the last chunk is an index. All numbers are little-endian.
///
/// Source  http://wiki.ros.org/Bags/Format/2.0
namespace astro::bag {

inline constexpr std::string_view kRos1BagMark = "#ROSBAG V";

struct Ros1BagFile {
  std::filesystem::path path;
  std::string name;                // of the bag's own file
  std::uint64_t stored_bytes = 0;  // of the bag's own file, which is smaller than `path` if it was packed
};

/// Reads a bag front to back into `topics`, and adds what is wrong with it to `report`. It needs no index, so
/// that the file of a recorder that was killed is read up to its last whole record: a chunk that is not
/// compressed is read like the file around it, and of a compressed one that was cut nothing is read. Messages
/// become CDR (topic_table.hpp).
///
/// Hostile files  a record or an expanded chunk has no more than 32 MiB, or the size of the file if that is
///                more, and all chunks together expand to no more than 64 MiB and 256 times the file.
/// Errors         astro::Error with the file's name if it is of another version.
void read_ros1_bag(const Ros1BagFile& file, TopicTable& topics, BagReport& report);

}  // namespace astro::bag
