#include "host/formats/files/uf2_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string_view>

#include "host/base/bytes.hpp"
#include "host/base/error.hpp"

namespace astro {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMagic = 0x0A32'4655, kSecondMagic = 0x9E5D'5157, kLastMagic = 0x0AB1'6F30;
constexpr std::uint32_t kFamilyPresent = 0x2000, kRp2040 = 0xE48B'FF56;
constexpr std::uint32_t kFlash = 0x1000'0000, kPayload = 256;
constexpr std::size_t kBlock = 512, kDataAt = 32;
constexpr std::size_t kRp2040InfoAt = 0x140, kStageBytes = 252;
constexpr std::uintmax_t kMostBytes = FirmwareImage::kBytes / kPayload * kBlock;

/// Of the second stage, as the RP2040's boot ROM computes it: the usual polynomial, the highest bit first.
std::uint32_t stage_sum(ByteView bytes) {
  std::uint32_t sum = ~0U;
  for (const std::uint8_t byte : bytes)
    for (int bit = 7; bit >= 0; --bit) {
      const bool carry = (sum >> 31) != (byte >> bit & 1U);
      sum = sum << 1 ^ (carry ? 0x04C1'1DB7U : 0U);
    }
  return sum;
}

Bytes read(const fs::path& path) {
  std::error_code missing;
  const bool regular = fs::is_regular_file(path, missing);  // to open a pipe would wait for its writer
  std::ifstream file;
  if (regular) file.open(path, std::ios::binary);
  if (!regular || !file)
    throw Error(fmt::format("cannot read '{}'", path.string()), Uf2Problem::unreadable, {path.string()});
  const std::uintmax_t size = fs::file_size(path, missing);
  if (size > kMostBytes)
    throw Error(fmt::format("'{}' is larger than any image for an RP2040", path.string()),
                Uf2Problem::too_large, {path.string()});
  Bytes bytes(size);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

/// Copies one block to its place.
void take(ByteView block, std::size_t number, std::size_t count, const std::string& file,
          FirmwareImage& image) {
  const auto word = [&](std::size_t index) { return load<std::uint32_t>(block, 4 * index); };
  const bool sound = word(0) == kMagic && word(1) == kSecondMagic && word(127) == kLastMagic &&
                     word(4) == kPayload && word(5) == number && word(6) == count;
  if (!sound)
    throw Error(fmt::format("block {} of '{}' is no block of UF2 for an RP2040: build the image again",
                            number + 1, file),
                Uf2Problem::damaged, {file, std::to_string(number + 1)});
  const std::uint32_t at = word(3) - kFlash;
  const bool fits = at % kPayload == 0 && at <= FirmwareImage::kBytes - kPayload;
  if (word(2) != kFamilyPresent || word(7) != kRp2040 || !fits)
    throw Error(fmt::format("'{}' is no image for an RP2040", file), Uf2Problem::of_other_board, {file});
  std::copy_n(block.begin() + kDataAt, kPayload, image.flash.begin() + at);
}

}  // namespace

bool begins_as_uf2(const fs::path& path) {
  std::error_code missing;
  if (!fs::is_regular_file(path, missing)) return false;
  std::ifstream file(path, std::ios::binary);
  Bytes start(4);
  return file.read(reinterpret_cast<char*>(start.data()), 4) && load<std::uint32_t>(start, 0) == kMagic;
}

FirmwareImage read_uf2_image(const fs::path& path) {
  const Bytes bytes = read(path);
  const std::string file = path.string();
  const std::size_t count = bytes.size() / kBlock;
  if (count == 0 || bytes.size() % kBlock != 0)
    throw Error(fmt::format("'{}' ends within a block of UF2: build or copy it again", file),
                Uf2Problem::damaged, {file, std::to_string(count + 1)});
  FirmwareImage image{Bytes(FirmwareImage::kBytes, 0xFF), "", ""};
  for (std::size_t number = 0; number < count; ++number)
    take(ByteView(bytes).subspan(number * kBlock, kBlock), number, count, file, image);
  if (stage_sum(ByteView(image.flash).first(kStageBytes)) != load<std::uint32_t>(image.flash, kStageBytes))
    throw Error(
        fmt::format("'{}' is damaged, the check sum of its first 252 bytes is wrong: build or copy it again",
                    file),
        Uf2Problem::damaged, {file, "1"});
  read_image_info(image, kRp2040InfoAt);
  return image;
}

}  // namespace astro
