// Intel HEX images, as the emulator loads and `flash` checks them.
#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/formats/files/firmware_image.hpp"
#include "tests/fuzz/input_file.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {
namespace {

std::string record(unsigned address, unsigned kind, const std::vector<unsigned>& data) {
  const auto size = static_cast<unsigned>(data.size());
  unsigned sum = size + (address >> 8U) + (address & 0xFFU) + kind;
  std::string line = fmt::format(":{:02X}{:04X}{:02X}", size, address, kind);
  for (const unsigned byte : data) {
    line += fmt::format("{:02X}", byte);
    sum += byte;
  }
  return line + fmt::format("{:02X}\n", (0x100U - sum % 0x100U) % 0x100U);
}

}  // namespace

void take(ByteView input) {
  static const InputFile file("x.hex");
  try {
    require(read_firmware_image(file.holding(input)).flash.size() == FirmwareImage::kBytes,
            "an image is a flash");
  } catch (const Error&) {
  }
}

std::vector<Bytes> seeds() {
  const std::string upper = record(0, 4, {0x60, 0x00}), end = record(0, 1, {});
  const std::string head = record(0, 0, {0x46, 0x43, 0x46, 0x42}) + record(0x50, 0, {0, 0, 0x20, 0}) +
                           record(0x1000, 0, {0xD1, 0x00, 0x20, 0x43});
  return {bytes_of(upper + head + end), bytes_of(upper + head + record(0x1030, 0, {'A', 's'}) + end),
          bytes_of(upper + record(0, 5, {0x60, 0, 0x10, 0}) + end)};
}

}  // namespace astro::fuzz
