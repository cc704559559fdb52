#pragma once

#include <filesystem>

#include "host/base/byte_source.hpp"

namespace astro::recording {

/// A folder below TMPDIR that goes with the object, for what must be unpacked or copied before it can be read. Throws
/// astro::Error if it cannot be made.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace astro::recording
