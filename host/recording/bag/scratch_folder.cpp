#include "host/recording/bag/scratch_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "host/base/error.hpp"

namespace astro::recording {
namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  std::string pattern = (parent / "bag-XXXXXX").string();
  if (error || ::mkdtemp(pattern.data()) == nullptr) {
    if (!error) error = {errno, std::generic_category()};
    throw Error("cannot make a temporary folder in " + parent.string() + ": " + error.message(),
                {Help::check_permissions_and_disk});
  }
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace astro::recording
