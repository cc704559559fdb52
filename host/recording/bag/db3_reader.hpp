#pragma once

#include <filesystem>

#include "host/recording/bag/topic_table.hpp"

namespace astro::recording {

/// Reads a rosbag2 database (schemas 1 to 4) front to back into `topics`, and adds what is wrong with it to `report`.
/// The file is opened read-only, so that it may lie on a read-only medium; `with_log` is for a copy whose recorder was
/// killed: SQLite then first brings the newest messages from the log into the file.
///
/// Hostile files  tables must be ordinary ones without computed columns, rows must come in rising order, and neither
///                the work nor the size of a value exceeds what a file of that size can hold.
/// Errors         astro::Error naming `name` if it is no database or has no tables of messages and topics.
void read_db3(const std::filesystem::path& path, const std::string& name, bool with_log, TopicTable& topics,
              BagReport& report);

/// The part of a database file that has whole pages; its whole size if it has a damaged header.
std::uint64_t bytes_in_whole_pages(const std::filesystem::path& path);

}  // namespace astro::recording
