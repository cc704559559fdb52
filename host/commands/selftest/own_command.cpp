#include "host/commands/selftest/own_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "host/base/error.hpp"
#include "host/base/interrupted.hpp"
#include "host/base/system_error.hpp"
#include "host/console/interrupt.hpp"

namespace astro::commands {
namespace {

using std::chrono::steady_clock;

/// Without the name of the program, which the sentence that it becomes part of does not need.
std::string last_of(const std::vector<std::string>& lines) {
  constexpr std::string_view kName = "astrolabe: ";
  if (lines.empty()) return "it said nothing";
  return lines.back().starts_with(kName) ? lines.back().substr(kName.size()) : lines.back();
}

}  // namespace

OwnCommand::OwnCommand(const std::vector<std::string>& words) : name_(words.front()) {
  std::vector<std::string> command{"/proc/self/exe"};
  command.insert(command.end(), words.begin(), words.end());
  const int failed = process_.start(command, ChildProcess::Output::bytes,
                                    [this](std::string_view line) { said_.emplace_back(line); });
  if (failed != 0) throw Error(fmt::format("'{}' cannot be started: {}", name_, system_reason(failed)));
}

void OwnCommand::listen(steady_clock::time_point end) {
  if (console::interrupted()) throw Interrupted("interrupted");
  if (steady_clock::now() > end) throw Error(fmt::format("'{}' takes too long: {}", name_, last_of(said_)));
  process_.wait(std::chrono::milliseconds(20));
  // The output is not waited for alone, so it may have nothing yet; read() then returns 0.
  std::array<std::uint8_t, 65536> bytes;
  while (process_.writes_bytes()) {
    const std::size_t count = process_.read(bytes);
    output_.append(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
    if (count == 0) break;
  }
}

std::string OwnCommand::line_with(std::string_view text, std::chrono::seconds limit) {
  const auto end = steady_clock::now() + limit;
  while (true) {
    const auto found =
        std::ranges::find_if(said_, [&](const std::string& line) { return line.find(text) != line.npos; });
    if (found != said_.end()) return *found;
    if (!process_.writes_lines()) throw Error(fmt::format("'{}' does not run: {}", name_, last_of(said_)));
    listen(end);
  }
}

std::string OwnCommand::first_line(std::chrono::seconds limit) {
  const auto end = steady_clock::now() + limit;
  while (output_.find('\n') == output_.npos) {
    if (!process_.writes_bytes()) throw Error(fmt::format("'{}' ends: {}", name_, last_of(said_)));
    listen(end);
  }
  return output_.substr(0, output_.find('\n'));
}

std::string OwnCommand::output(std::chrono::seconds limit) {
  const auto end = steady_clock::now() + limit;
  while (process_.writes_lines() || process_.writes_bytes()) listen(end);
  if (process_.finish(std::chrono::seconds(5)) != 0) throw Error(last_of(said_));
  return output_;
}

void OwnCommand::end() {
  process_.terminate();
  if (process_.finish(std::chrono::seconds(10)) != 0)
    throw Error(fmt::format("'{}' does not end as it should: {}", name_, last_of(said_)));
}

}  // namespace astro::commands
