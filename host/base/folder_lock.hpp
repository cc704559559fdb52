#pragma once

#include <filesystem>

namespace astro::recording {

/// Holds a folder for one program at a time, for as long as it lives; nothing is left behind, however the
/// program ends. Makes the folder if needed. A file system that knows no locks does not lock.
///
/// Errors  astro::Error naming the folder: in use by another program, or it cannot be made or opened.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace astro::recording
