#include "host/cli/runtime_link.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "host/base/error.hpp"
#include "host/link/ports.hpp"

namespace astro::cli {

namespace fs = std::filesystem;

fs::path make_runtime_folder() {
  const fs::path folder = link::runtime_folder();
  if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST)
    throw Error("the folder '" + folder.string() + "' cannot be made: " + std::strerror(errno) +
                "; set XDG_RUNTIME_DIR to a folder of yours");
  struct stat about {};
  if (lstat(folder.c_str(), &about) != 0 || !S_ISDIR(about.st_mode) || about.st_uid != geteuid())
    throw Error("'" + folder.string() + "' is not a folder of yours: set XDG_RUNTIME_DIR to one");
  return folder;
}

RuntimeLink::RuntimeLink(const fs::path& folder, const fs::path& pty) : target_(fs::absolute(pty)) {
  std::error_code error;
  if (fs::equivalent(target_.parent_path(), folder, error) && pty.extension() == ".pty") return;
  constexpr int kNames = 100;
  for (int i = 1; i <= kNames; ++i) {
    const std::string number = i == 1 ? "" : "-" + std::to_string(i);
    const fs::path link = folder / (pty.stem().string() + number + ".pty");
    if (fs::is_symlink(link, error) && !fs::exists(link, error)) fs::remove(link, error);  // a dead one's
    fs::create_symlink(target_, link, error);
    if (error == std::errc::file_exists) continue;
    if (!error) link_ = link;
    return;
  }
}

RuntimeLink::~RuntimeLink() {
  std::error_code error;
  if (!link_.empty() && fs::read_symlink(link_, error) == target_) fs::remove(link_, error);
}

}  // namespace astro::cli
