#pragma once

#include <stdlib.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace astro::test {

/// A folder that goes with the object. In memory where the system has such a place and lets programs run from it: on a disk to
/// which others write much, to make a file can take half a minute.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_(place() + "/astrolabe-test-XXXXXX") {
    if (::mkdtemp(path_.data()) == nullptr) throw std::runtime_error("cannot make a folder below " + place());
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::filesystem::path path() const { return path_; }

 private:
  static std::string place() {
    constexpr const char* kMemory = "/dev/shm";
    struct statvfs about {};
    const bool usable = ::statvfs(kMemory, &about) == 0 && (about.f_flag & (ST_NOEXEC | ST_RDONLY)) == 0;
    return usable && ::access(kMemory, W_OK | X_OK) == 0 ? kMemory : "/tmp";
  }

  std::string path_;
};

}  // namespace astro::test
