#include "host/commands/robot/image_search.hpp"

#include <fmt/format.h>

#include "host/base/error.hpp"

namespace astro::commands {

namespace fs = std::filesystem;

fs::path find_image(std::string_view board, const fs::path& build, const fs::path& share) {
  if (board != "teensy40" && board != "rp2040")
    throw Error(
        fmt::format("the robot runs on a '{}', for which there is no firmware to load: it loads into "
                    "a Teensy 4.0 and a Pico",
                    board));
  const std::string name = fmt::format("astrolabe-{}.{}", board, board == "rp2040" ? "uf2" : "hex");
  const fs::path built = build / board / "bin" / name, installed = share / name;
  for (const fs::path& image : {built, installed})
    if (std::error_code unreadable; fs::is_regular_file(image, unreadable)) return image;
  throw Error(fmt::format(
      "there is no firmware for the board '{0}', neither '{1}' nor '{2}': name a file, or build one "
      "with './dev firmware {0}'",
      board, built.string(), installed.string()));
}

fs::path find_image(std::string_view board) {
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  return find_image(board, "build", program.parent_path().parent_path() / "share/astrolabe/firmware");
}

}  // namespace astro::commands
