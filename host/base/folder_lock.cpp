#include "host/base/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "host/base/file_problem.hpp"
#include "host/base/system_error.hpp"

namespace astro {

FolderLock::FolderLock(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw Error("cannot make the folder " + folder.string() + ": " + error.message(),
                FileProblem::folder_not_made, {folder.string()});
  descriptor_.reset(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!descriptor_) throw system_error("cannot open the folder " + folder.string(), errno);
  if (::flock(descriptor_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw Error("another program records into '" + folder.string() + "': wait for it or name another folder",
                FileProblem::folder_in_use, {folder.string()});
}

}  // namespace astro
