#pragma once

#include <filesystem>

#include "host/base/descriptor.hpp"

namespace astro {

/// Locks a folder for this program for as long as the object lives; nothing is left behind, however the
/// program ends. Creates the folder if needed. On a file system without locks it does nothing.
///
/// Errors  astro::Error naming the folder: in use by another program, or it cannot be made or opened.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);

 private:
  Descriptor descriptor_;
};

}  // namespace astro
