#include "host/formats/files/firmware_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <fstream>
#include <string_view>

#include "host/base/bytes.hpp"
#include "host/base/error.hpp"

namespace astro {
namespace {

// Where hal/teensy40/core puts the words that make a file an image, and name and version of the firmware.
constexpr std::size_t kConfigurationAt = 0, kVectorTableAt = 0x1000, kInfoAt = 0x1030;
constexpr std::uint32_t kConfigurationTag = 0x4246'4346, kVectorTableTag = 0x4320'00D1;
constexpr std::string_view kInfoTag = "Astrolabe";
constexpr std::size_t kInfoTagBytes = 12;

enum Kind : std::uint8_t { kData = 0, kEnd = 1, kStartSegment = 3, kUpperHalf = 4, kStart = 5 };

constexpr std::size_t kFlashBytesAt = 0x50;  // of the configuration: how large the flash is
constexpr std::uint32_t kFlashBytes = 0x20'0000;

// The whole flash takes 5.6 MB of Intel HEX.
constexpr std::uintmax_t kMostHexBytes = std::uintmax_t{16} << 20;
constexpr std::size_t kLongestRecord = 1 + 2 * (5 + 255);

/// The bytes of a record without its colon, its sum checked.
std::vector<std::uint8_t> record(const std::string& line, const std::string& file, int number) {
  std::vector<std::uint8_t> bytes;
  const auto digit = [&](std::size_t i) {
    return i < line.size() && std::isxdigit(static_cast<unsigned char>(line[i])) != 0;
  };
  for (std::size_t i = 1; i < kLongestRecord && digit(i) && digit(i + 1); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(line.substr(i, 2), nullptr, 16)));
  unsigned sum = 0;
  for (const std::uint8_t byte : bytes) sum += byte;
  if (line[0] != ':' || bytes.size() < 5 || bytes.size() != bytes[0] + 5U || sum % 256 != 0 ||
      (bytes[3] == kUpperHalf && bytes[0] != 2))
    throw Error(fmt::format("{}:{} is no Intel HEX record: build the image again", file, number),
                ImageProblem::not_intel_hex, {file, std::to_string(number)});
  return bytes;
}

std::uint32_t word(const std::vector<std::uint8_t>& flash, std::size_t offset) {
  return load<std::uint32_t>(flash, offset);
}

std::string version_in(const std::uint8_t* info) {
  if (!std::equal(kInfoTag.begin(), kInfoTag.end(), info)) return "";
  const std::uint8_t* version = info + kInfoTagBytes;
  return fmt::format("{}.{}.{}", version[0], version[1], version[2]);
}

std::string board_in(const std::uint8_t* info) {
  constexpr std::size_t kBytesAt = 15, kBoardAt = 16, kBoardBytes = 16;
  if (info[kBytesAt] < kBoardAt + kBoardBytes) return "";
  const std::uint8_t *board = info + kBoardAt, *end = std::find(board, board + kBoardBytes, 0);
  const bool printable = std::all_of(board, end, [](std::uint8_t c) { return c > ' ' && c < 0x7F; });
  return printable ? std::string(board, end) : "";
}

}  // namespace

void read_image_info(FirmwareImage& image, std::size_t at) {
  image.version = version_in(image.flash.data() + at);
  if (!image.version.empty()) image.board = board_in(image.flash.data() + at);
}

FirmwareImage read_firmware_image(const std::filesystem::path& hex) {
  std::error_code missing;
  const bool regular =
      std::filesystem::is_regular_file(hex, missing);  // to open a pipe would wait for its writer
  std::ifstream file;
  if (regular) file.open(hex);
  if (!regular || !file)
    throw Error(fmt::format("cannot read '{}'", hex.string()), ImageProblem::unreadable, {hex.string()});
  if (std::filesystem::file_size(hex, missing) > kMostHexBytes)
    throw Error(fmt::format("'{}' is larger than any image for a Teensy 4.0", hex.string()),
                ImageProblem::too_large, {hex.string()});
  FirmwareImage image{std::vector<std::uint8_t>(FirmwareImage::kBytes, 0xFF), "", ""};
  std::uint32_t upper = 0;
  int number = 0;
  bool ended = false;
  for (std::string line; !ended && std::getline(file, line);) {
    const std::string where = fmt::format("{}:{}", hex.string(), ++number);
    if (line.empty()) continue;
    const std::vector<std::uint8_t> bytes = record(line, hex.string(), number);
    ended = bytes[3] == kEnd;
    if (bytes[3] == kUpperHalf) upper = static_cast<std::uint32_t>(bytes[4] << 8U | bytes[5]) << 16U;
    if (bytes[3] == kStartSegment || bytes[3] == kStart || bytes[3] == kUpperHalf || ended) continue;
    if (bytes[3] != kData) throw Error(where + " is a record of a kind that no image for a Teensy has");
    const std::uint32_t address = upper + static_cast<std::uint32_t>(bytes[1] << 8U | bytes[2]);
    if (address < FirmwareImage::kBase || address - FirmwareImage::kBase + bytes[0] > image.flash.size())
      throw Error(
          fmt::format("{} lies at 0x{:08X}, where a Teensy 4.0 has no program memory", where, address));
    std::memcpy(image.flash.data() + (address - FirmwareImage::kBase), bytes.data() + 4, bytes[0]);
  }
  if (!ended) throw Error(fmt::format("'{}' has no end: build the image again", hex.string()));
  if (word(image.flash, kConfigurationAt) != kConfigurationTag ||
      word(image.flash, kVectorTableAt) != kVectorTableTag || word(image.flash, kFlashBytesAt) != kFlashBytes)
    throw Error(fmt::format("'{}' is no image for a Teensy 4.0", hex.string()), ImageProblem::of_other_board,
                {hex.string()});
  read_image_info(image, kInfoAt);
  return image;
}

}  // namespace astro
