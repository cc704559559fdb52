#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace astro::target {

/// What a boot loader would write: bytes by address.
using Bytes = std::map<std::uint32_t, std::uint8_t>;

/// Reads an Intel HEX file. Throws if it is missing, or a line's sum is wrong.
Bytes read_hex(const std::string& path);

std::uint32_t word(const Bytes& bytes, std::uint32_t address);

/// The file of an image: image("elf"), image("hex", "blink").
std::string image(const std::string& extension, const std::string& name = "astrolabe-teensy40");

}  // namespace astro::target
