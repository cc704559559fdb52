#include "host/simulation/server/runtime_link.hpp"

#include <string>

namespace astro::simulation {

namespace fs = std::filesystem;

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

}  // namespace astro::simulation
