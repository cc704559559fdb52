#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/base/bytes.hpp"
#include "host/base/error.hpp"

namespace astro::bag {

enum class BagFileKind : std::uint8_t { none, database, mcap, ros1, zstd };

/// What a file is by its first bytes; `none` also if it cannot be read.
BagFileKind bag_file_kind(const std::filesystem::path& path);

/// Whether it is a bag of ROS 1 that is not packed.
inline bool is_ros1_bag(const std::filesystem::path& path) {
  return bag_file_kind(path) == BagFileKind::ros1;
}

/// Throws the astro::Error for the file `name`, which begins like no part of a bag.
[[noreturn]] void refuse_as_bag(const std::string& name);

/// Refuses a file that has the extension of a part of a bag and begins like none, so that nobody takes it for a text.
void require_bag_content(const std::filesystem::path& path);

struct BagFiles {
  std::vector<std::filesystem::path> files;
  std::vector<Remark> warnings;  // of files that metadata.yaml names and that are not there
};

/// The files of a bag in the order of their messages. For a folder they are those that its metadata.yaml names, otherwise all
/// that look like parts of bags, sorted by name with numbers in their order (bag_2 before bag_10). For a file it is the file
/// itself. Only the last part of a path in metadata.yaml counts, because old bags name their folder before it, and because no
/// bag may reach out of its folder. Throws astro::Error naming the path if there is none.
BagFiles bag_files(const std::filesystem::path& path);

}  // namespace astro::bag
