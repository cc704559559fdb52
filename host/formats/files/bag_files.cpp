#include "host/formats/files/bag_files.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <set>
#include <string>

#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/base/text/natural_order.hpp"
#include "host/formats/files/bag.hpp"
#include "host/formats/files/bag_damage.hpp"
#include "host/formats/files/compression.hpp"
#include "host/formats/files/mcap_records.hpp"
#include "host/formats/files/ros1_bag_reader.hpp"
#include "host/formats/files/yaml_scalars.hpp"

namespace astro::bag {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kMetadataFile = "metadata.yaml";
constexpr std::size_t kMostFiles = 10'000, kMostMissing = 8;

bool is_named_as_part(const fs::path& path) {
  const fs::path extension = path.extension();
  return extension == ".db3" || extension == ".mcap" || extension == ".zstd";
}

std::vector<fs::path> parts_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (!is_named_as_part(at->path())) continue;
    if (files.size() >= kMostFiles)
      throw Error(folder.string() + " has more than " + std::to_string(kMostFiles) +
                      " parts of a bag in it: name the right file",
                  BagProblem::too_many_files, {folder.string(), std::to_string(kMostFiles)});
    files.push_back(at->path());
  }
  std::ranges::sort(files, [](const fs::path& a, const fs::path& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  return files;
}

/// The file as it is named, or packed or unpacked since the metadata were written; empty if it is not there.
fs::path found(const fs::path& folder, const fs::path& name) {
  fs::path packed = name, unpacked = name;
  packed += ".zstd";
  if (unpacked.extension() == ".zstd") unpacked.replace_extension();
  std::error_code ignored;
  for (const fs::path& variant : {name, packed, unpacked})
    if (fs::is_regular_file(folder / variant, ignored)) return folder / variant;
  return {};
}

BagFiles named_in(const fs::path& metadata, const fs::path& folder) {
  constexpr std::string_view kKey = "rosbag2_bagfile_information/relative_file_paths/";
  const Bytes text = load_file(metadata, kMaxSettingsBytes);
  BagFiles out;
  std::set<std::string> named;
  for (const YamlScalar& scalar : yaml_scalars(as_text(text), metadata.string())) {
    if (!scalar.path.starts_with(kKey)) continue;
    const fs::path name = fs::path(scalar.value).filename();
    if (!named.insert(name.string()).second) continue;  // a file is read once, however often it is named
    if (named.size() > kMostFiles)
      throw Error(metadata.string() + ", line " + std::to_string(scalar.line) + ": this is file " +
                      std::to_string(named.size()) +
                      " of the bag, more than any bag has: name the right file",
                  BagProblem::too_many_files, {metadata.string(), std::to_string(kMostFiles)});
    const fs::path file = found(folder, name);
    if (!file.empty()) {
      out.files.push_back(file);
    } else if (out.warnings.size() < kMostMissing) {
      out.warnings.push_back({metadata.string() + " names " + name.string() + ", which is not there",
                              BagDamage::file_not_there,
                              {metadata.string(), name.string()}});
    }
  }
  return out;
}

}  // namespace

BagFileKind bag_file_kind(const fs::path& path) {
  constexpr std::string_view kDatabase{"SQLite format 3\0", 16};
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return BagFileKind::none;
  std::array<char, kDatabase.size()> start{};
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), start.size());
  const std::string_view text(start.data(), static_cast<std::size_t>(file.gcount()));
  if (text == kDatabase) return BagFileKind::database;
  if (text.starts_with(as_text(bag::mcap::kMagic))) return BagFileKind::mcap;
  if (text.starts_with(kRos1BagMark)) return BagFileKind::ros1;
  return begins_like_zstd(as_bytes(text)) ? BagFileKind::zstd : BagFileKind::none;
}

void refuse_as_bag(const std::string& name) {
  throw Error(name + " is not a bag: it begins like no .db3, .mcap, .bag or .zstd file: name the right file",
              BagProblem::not_a_bag, {name});
}

void require_bag_content(const fs::path& path) {
  std::error_code ignored;
  if (is_named_as_part(path) && fs::is_regular_file(path, ignored) &&
      bag_file_kind(path) == BagFileKind::none)
    refuse_as_bag(path.string());
}

BagFiles bag_files(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    throw Error("there is no " + path.string() + ": check the path", BagProblem::missing, {path.string()});
  if (!fs::is_directory(path, ignored)) return {{path}, {}};
  BagFiles files;
  const fs::path metadata = path / kMetadataFile;
  if (fs::is_regular_file(metadata, ignored)) files = named_in(metadata, path);
  if (files.files.empty()) files.files = parts_in(path);
  if (files.files.empty())
    throw Error(path.string() + " has no part of a bag in it, no .db3 and no .mcap: name the right file",
                BagProblem::no_files, {path.string()});
  return files;
}

}  // namespace astro::bag
