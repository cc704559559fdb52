#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

namespace astro::support {

/// Addresses of an image's symbols.
inline std::map<std::string, std::uint32_t> elf_symbols(const std::string& elf) {
  FILE* pipe = popen(("arm-none-eabi-nm --defined-only '" + elf + "'").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run arm-none-eabi-nm");
  std::map<std::string, std::uint32_t> symbols;
  std::array<char, 4096> line{};
  while (fgets(line.data(), line.size(), pipe) != nullptr) {
    std::istringstream words(line.data());
    std::string address, kind, name;
    if (words >> address >> kind >> name)
      symbols[name] = static_cast<std::uint32_t>(std::stoul(address, nullptr, 16));
  }
  if (pclose(pipe) != 0) throw std::runtime_error("no symbols in " + elf);
  return symbols;
}

}  // namespace astro::support
