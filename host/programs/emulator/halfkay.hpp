#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace astro::emulator {

/// The way into an emulated Teensy that waits in its boot loader: a FIFO that is there only as long as the
/// object. Whoever writes an image into it stands for teensy_loader_cli:
///
///   cat firmware.hex > robot.halfkay
class HalfKay {
 public:
  /// Throws astro::Error if the FIFO cannot be made.
  explicit HalfKay(std::filesystem::path fifo);
  ~HalfKay();
  HalfKay(const HalfKay&) = delete;
  HalfKay& operator=(const HalfKay&) = delete;

  /// The image, once somebody has written one to its end. Never blocks.
  std::optional<std::string> receive();

 private:
  std::filesystem::path path_;
  int fd_ = -1;
  std::string received_;
};

}  // namespace astro::emulator
