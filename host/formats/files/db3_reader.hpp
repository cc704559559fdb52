#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "host/formats/files/topic_table.hpp"

namespace astro::bag {

/// The database of a bag, or a copy of it.
struct Db3File {
  std::filesystem::path path;
  std::string name;                // of the bag's own file
  std::uint64_t stored_bytes = 0;  // of the bag's own file, which is smaller than `path` if it was packed
  /// A copy whose recorder was killed: SQLite first brings the newest messages from the log beside it into the file.
  bool with_log = false;
};

/// Reads a rosbag2 database (schemas 1 to 4) front to back into `topics`, and adds what is wrong with it to `report`.
/// The file is opened read-only, so that it may lie on a read-only medium, unless it has a log.
///
/// Hostile files  tables must be ordinary ones without computed columns, rows must come in rising order, and neither
///                the work nor the size of a value exceeds what a file of that size can hold,
///                and 24 MiB more if it was packed.
/// Errors         astro::Error with the file's name if it is no database or has no tables of messages and topics.
void read_db3(const Db3File& file, TopicTable& topics, BagReport& report);

/// The part of a database file that has whole pages; its whole size if it has a damaged header.
std::uint64_t bytes_in_whole_pages(const std::filesystem::path& path);

}  // namespace astro::bag
