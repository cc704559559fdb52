#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

namespace astro::target {

/// The bytes of an Intel HEX file by address: what a boot loader would write.
inline std::map<std::uint32_t, std::uint8_t> read_hex(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + " is missing: build the images with ./dev firmware");
  std::map<std::uint32_t, std::uint8_t> bytes;
  std::uint32_t upper = 0;
  for (std::string line; std::getline(file, line);) {
    const auto byte = [&](std::size_t i) {
      return static_cast<std::uint8_t>(std::stoul(line.substr(1 + 2 * i, 2), nullptr, 16));
    };
    const std::uint32_t count = byte(0), address = byte(1) << 8U | byte(2), kind = byte(3);
    if (kind == 4) upper = static_cast<std::uint32_t>(byte(4) << 8U | byte(5)) << 16U;
    for (std::uint32_t i = 0; kind == 0 && i < count; ++i) bytes[upper + address + i] = byte(4 + i);
  }
  return bytes;
}

inline std::uint32_t word(const std::map<std::uint32_t, std::uint8_t>& bytes, std::uint32_t address) {
  std::uint32_t value = 0;
  for (std::uint32_t i = 0; i < 4; ++i) value |= std::uint32_t{bytes.at(address + i)} << (8 * i);
  return value;
}

inline std::string image(const char* extension) {
  return std::string(ASTRO_IMAGE_DIR "/astrolabe-teensy40.") + extension;
}

}  // namespace astro::target
