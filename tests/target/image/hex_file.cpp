#include "tests/target/image/hex_file.hpp"

#include <fstream>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace astro::target {
namespace {

std::vector<std::uint8_t> record(const std::string& line) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t at = 1; at + 1 < line.size(); at += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(line.substr(at, 2), nullptr, 16)));
  return bytes;
}

}  // namespace

Bytes read_hex(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + " is missing: build the images with ./dev firmware");
  Bytes bytes;
  std::uint32_t upper = 0;
  for (std::string line; std::getline(file, line);) {
    const auto data = record(line);
    if (data.size() < 5 || std::accumulate(data.begin(), data.end(), 0U) % 256 != 0)
      throw std::runtime_error(path + ": bad record " + line);
    const std::uint32_t address = data[1] << 8U | data[2], kind = data[3];
    if (kind == 4) upper = static_cast<std::uint32_t>(data[4] << 8U | data[5]) << 16U;
    for (std::uint32_t i = 0; kind == 0 && i < data[0]; ++i) bytes[upper + address + i] = data.at(4 + i);
  }
  return bytes;
}

std::uint32_t word(const Bytes& bytes, std::uint32_t address) {
  std::uint32_t value = 0;
  for (std::uint32_t i = 0; i < 4; ++i) value |= std::uint32_t{bytes.at(address + i)} << (8 * i);
  return value;
}

std::string image(const std::string& extension, const std::string& name) {
  return ASTRO_IMAGE_DIR "/" + name + "." + extension;
}

}  // namespace astro::target
