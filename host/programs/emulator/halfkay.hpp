#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace astro::emulator {

/// How an image gets into an emulated Teensy that waits in its boot loader: through a FIFO that exists only
/// as long as the object. A program that writes an image into it stands in for teensy_loader_cli:
///
///   cat firmware.hex > robot.halfkay
class HalfKay {
 public:
  /// Throws astro::Error if the FIFO cannot be made.
  explicit HalfKay(std::filesystem::path fifo);
  ~HalfKay();
  HalfKay(const HalfKay&) = delete;
  HalfKay& operator=(const HalfKay&) = delete;

  /// The image, when it was written completely; nothing before. Never blocks.
  std::optional<std::string> receive();

 private:
  std::filesystem::path path_;
  int fd_ = -1;
  std::string received_;
};

}  // namespace astro::emulator
