#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/target/contract/remote_board.hpp"

namespace astro::target {

/// The puppet image on an emulated Pico in a process of its own (tests/target/rp2040/puppet_server.mjs), a line for each
/// question and each answer.
///
/// With `kUsb` its first port is USB, at a host that has opened it, and its second one the serial port. Without, the serial port
/// is the only one, because the host's enumeration takes half a second of the chip's time.
template <bool kUsb>
class PicoPuppet {
 public:
  static constexpr std::string_view kName = "rp2040";
  static constexpr int kPorts = kUsb ? 2 : 1;
  static constexpr int port_of(int port) { return kUsb ? port : 1; }
  static constexpr bool kHasGyro = false;

  explicit PicoPuppet(int seed) {
    std::array<int, 2> to{}, from{};
    if (pipe2(to.data(), O_CLOEXEC) != 0 || pipe2(from.data(), O_CLOEXEC) != 0)
      throw std::runtime_error("no pipe");
    const std::string number = std::to_string(seed);
    pid_ = fork();
    if (pid_ == 0) {
      dup2(to[0], 0);
      dup2(from[1], 1);
      execlp("node", "node", ASTRO_PICO_RIG_DIR "/puppet_server.mjs", ASTRO_PICO_IMAGE_DIR "/puppet",
             number.c_str(), nullptr);
      _exit(127);
    }
    close(to[0]);
    close(from[1]);
    ask_ = fdopen(to[1], "w");
    answer_ = fdopen(from[0], "r");
    say("start");
    if (kUsb) say("connect");
  }
  ~PicoPuppet() {
    fclose(ask_);  // the end of its input ends it
    fclose(answer_);
    int status = 0;
    waitpid(pid_, &status, 0);
  }
  PicoPuppet(const PicoPuppet&) = delete;
  PicoPuppet& operator=(const PicoPuppet&) = delete;

  /// The words of the answer. Throws if the server has ended or refuses.
  std::vector<std::string> say(const std::string& question) {
    std::fprintf(ask_, "%s\n", question.c_str());
    std::fflush(ask_);
    std::string line;
    for (int c = std::fgetc(answer_); c != '\n'; c = std::fgetc(answer_)) {
      if (c == EOF)
        throw std::runtime_error("the emulated Pico has ended at '" + question.substr(0, 40) + "'");
      line.push_back(static_cast<char>(c));
    }
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    if (words.empty() || words[0] != "ok") throw std::runtime_error("the emulated Pico: " + line);
    return {words.begin() + 1, words.end()};
  }

  std::uint64_t call(Call call, std::uint32_t first = 0, std::uint32_t second = 0) {
    const bool carries = call == Call::write_port || call == Call::program;
    const bool brings = call == Call::read_port || call == Call::read_flash;
    const std::uint32_t back = brings ? second : call == Call::unique_id ? 16 : 0;
    std::ostringstream question;
    question << "call " << static_cast<std::uint32_t>(call) << ' ' << first << ' ' << second << ' ' << back
             << ' ' << (carries ? hex({mailbox_.bytes, second}) : "-");
    const auto words = say(question.str());
    if (words.size() > 1) {
      const auto bytes = bytes_of(words[1]);
      std::copy(bytes.begin(), bytes.end(), mailbox_.bytes);
    }
    return std::stoull(words[0]);
  }
  Mailbox& mailbox() { return mailbox_; }
  bool in_bootloader() { return say("loader")[0] == "1"; }

  static std::string hex(std::span<const std::uint8_t> bytes) {
    constexpr char kDigits[] = "0123456789abcdef";
    std::string text;
    for (const std::uint8_t byte : bytes) text += {kDigits[byte >> 4], kDigits[byte & 15]};
    return text.empty() ? "-" : text;
  }
  static std::vector<std::uint8_t> bytes_of(const std::string& text) {
    std::vector<std::uint8_t> bytes;
    if (text == "-") return bytes;
    for (std::size_t i = 0; i + 1 < text.size(); i += 2)
      bytes.push_back(static_cast<std::uint8_t>(std::stoul(text.substr(i, 2), nullptr, 16)));
    return bytes;
  }

 private:
  pid_t pid_ = -1;
  FILE *ask_ = nullptr, *answer_ = nullptr;
  Mailbox mailbox_{};
};

template <bool kUsb>
using PicoBoard = RemoteBoard<PicoPuppet<kUsb>>;
static_assert(hal::Board<PicoBoard<true>>);

}  // namespace astro::target
