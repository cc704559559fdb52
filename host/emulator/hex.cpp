#include "host/emulator/hex.hpp"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/emulator/memory.hpp"

namespace astro::emulator {
namespace {

/// The bytes of a record without its colon, its sum checked.
std::vector<std::uint8_t> record(const std::string& line, const std::string& where) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 1; i + 1 < line.size() && std::isxdigit(static_cast<unsigned char>(line[i])) != 0;
       i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(line.substr(i, 2), nullptr, 16)));
  unsigned sum = 0;
  for (const std::uint8_t byte : bytes) sum += byte;
  if (line[0] != ':' || bytes.size() < 5 || bytes.size() != bytes[0] + 5U || sum % 256 != 0)
    throw Error(where + " is no Intel HEX record: build the image again");
  return bytes;
}

std::uint32_t word(std::span<const std::uint8_t> flash, std::size_t offset) {
  std::uint32_t value = 0;
  std::memcpy(&value, flash.data() + offset, sizeof value);
  return value;
}

}  // namespace

void load_hex(const std::filesystem::path& path, std::span<std::uint8_t> flash) {
  std::ifstream file(path);
  if (!file) throw Error(fmt::format("cannot read '{}': build it with ./dev firmware", path.string()));
  std::uint32_t upper = 0;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    const std::string where = fmt::format("{}:{}", path.string(), ++number);
    if (line.empty()) continue;
    const std::vector<std::uint8_t> bytes = record(line, where);
    if (bytes[3] == 4) upper = static_cast<std::uint32_t>(bytes[4] << 8U | bytes[5]) << 16U;
    if (bytes[3] != 0) continue;
    const std::uint32_t address = upper + static_cast<std::uint32_t>(bytes[1] << 8U | bytes[2]);
    if (address < Memory::kFlash || address - Memory::kFlash + bytes[0] > flash.size())
      throw Error(fmt::format("{} lies at 0x{:08X}, outside the flash of a Teensy 4.0", where, address));
    std::memcpy(flash.data() + (address - Memory::kFlash), bytes.data() + 4, bytes[0]);
  }
  if (word(flash, 0) != 0x4246'4346 || word(flash, 0x1000) != 0x4320'00D1)
    throw Error(fmt::format("'{}' is no image for a Teensy 4.0: its header is missing", path.string()));
}

}  // namespace astro::emulator
