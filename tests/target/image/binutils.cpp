#include "tests/target/image/binutils.hpp"

#include <cxxabi.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <stdexcept>

namespace astro::target {

std::string output_of(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  std::string text;
  std::array<char, 65536> block{};
  while (const std::size_t count = fread(block.data(), 1, block.size(), pipe))
    text.append(block.data(), count);
  if (pclose(pipe) != 0) throw std::runtime_error("failed: " + command);
  return text;
}

std::string readable(const std::string& linker_name) {
  if (!linker_name.starts_with("_Z")) return linker_name;  // "f" would be a float
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> name(
      abi::__cxa_demangle(linker_name.c_str(), nullptr, nullptr, &status), std::free);
  if (status != 0) return linker_name;
  const std::string text = name.get();
  return text.substr(0, text.find(" [clone"));
}

Control::Control() {
  std::string pattern = std::filesystem::temp_directory_path() / "astrolabe-image-XXXXXX";
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make " + pattern);
  folder_ = pattern;
}

Control::~Control() { std::filesystem::remove_all(folder_); }

std::string Control::program(const std::string& source, const std::string& flags) const {
  const std::string path = folder_ / "control.cpp", elf = folder_ / "control.elf";
  std::ofstream(path) << source;
  output_of(
      "arm-none-eabi-g++ -mcpu=cortex-m7 -mthumb -O2 -fno-unwind-tables -nostartfiles --specs=nosys.specs " +
      flags + " -Wl,--emit-relocs -Wl,--entry=begin -Wl,--unresolved-symbols=ignore-all -o '" + elf + "' '" +
      path + "' 2>&1");
  return elf;
}

}  // namespace astro::target
