#pragma once

#include <emscripten/val.h>

#include <string>

#include "host/robot/port/transport.hpp"

namespace astro::page {

/// A robot's serial port that the page holds open, from the worker in which the module runs. The page gives the module an object
/// `serial` for it (host/page/front/src/serial/serial_line.ts), whose calls wait as long as they are told.
class PagePort final : public robot::Transport {
 public:
  /// `name`: as the page calls the port. Throws Error that says why it cannot be opened.
  explicit PagePort(std::string name);
  ~PagePort() override;

  /// What the page sends is queued there, so nobody waits.
  void write(std::span<const std::uint8_t> bytes) override;
  std::size_t read(std::span<std::uint8_t> into, microseconds timeout) override;
  microseconds now() const override;
  void reopen(microseconds timeout) override;
  const std::string& name() const override { return name_; }

  /// Takes the questions that came while the module works, if the page can ask any; see RobotCalls::Meanwhile.
  static void take_questions();

 private:
  [[noreturn]] void lose() const;
  /// "" once it is open; tried once.
  std::string why_not_opened();

  std::string name_;
  emscripten::val line_;
};

}  // namespace astro::page
