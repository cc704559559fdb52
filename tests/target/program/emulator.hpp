#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/programs/program.hpp"
#include "tests/target/firmware_file.hpp"

namespace astro::target {

/// `astrolabe-emulator` in a folder of its own, with both ports there when constructed.
class EmulatorProgram {
 public:
  explicit EmulatorProgram(const std::vector<std::string>& options = {}) : program_(command(options)) {
    // The cameras come last of what is there from the start; the USB port after them, once it is enumerated.
    const bool ready = support::eventually([&] { return is_there(usb() + ".mocap") && is_there(usb()); });
    if (!ready) throw std::runtime_error("the emulator does not start: " + program_.err());
  }

  std::string serial() const { return (folder_.path() / "serial").string(); }
  std::string usb() const { return (folder_.path() / "usb").string(); }
  /// Where its boot loader takes an image.
  std::string halfkay() const { return serial() + ".halfkay"; }
  std::filesystem::path folder() const { return folder_.path(); }
  support::Program& program() { return program_; }

 private:
  static bool is_there(const std::string& path) { return std::filesystem::exists(path); }
  std::vector<std::string> command(const std::vector<std::string>& options) const {
    std::vector<std::string> words{
        ASTROLABE_EMULATOR_PROGRAM, kImage, "--fast", "--pty", serial(), "--usb-pty", usb()};
    words.insert(words.end(), options.begin(), options.end());
    return words;
  }

  test::TemporaryFolder folder_;
  support::Program program_;
};

}  // namespace astro::target
