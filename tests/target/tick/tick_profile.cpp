#include "tests/target/tick/tick_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "tests/support/base/temporary_folder.hpp"
#include "tests/target/image/binutils.hpp"

namespace astro::target {
namespace {

constexpr int kTick = 16 + 122;

struct Rule {
  const char* name;
  TickProfile::Part part;
};
// The first that matches, from the innermost function outwards.
constexpr Rule kRules[] = {
    {"Motors::fault", TickProfile::safety},
    {"Motors::", TickProfile::pwm},
    {"to_duty", TickProfile::pwm},
    {"Encoders::read", TickProfile::encoders},
    {"Clock::now_us", TickProfile::clock},
    {"Battery::", TickProfile::battery},
    {"I2c::", TickProfile::gyro},
    {"i2c::Gyro", TickProfile::gyro},
    {"GyroHeading", TickProfile::gyro},
    {"HeadingFilter", TickProfile::gyro},
    {"SlipWatch", TickProfile::gyro},
    {"follow_gyro", TickProfile::gyro},
    {"SpeedObserver", TickProfile::speed},
    {"Wheels::read", TickProfile::speed},
    {"Odometry::", TickProfile::odometry},
    {"EffectiveBase::inverse", TickProfile::odometry},
    {"EffectiveBase::widening", TickProfile::control},
    {"PathFollower", TickProfile::motion},
    {"Trapezoid", TickProfile::motion},
    {"Drive::set_point", TickProfile::motion},
    {"SegmentPath::", TickProfile::motion},
    {"reduced", TickProfile::motion},
    {"Drive::follow", TickProfile::motion},
    {"TwistRamp", TickProfile::motion},
    {"Supervisor::", TickProfile::safety},
    {"FaultLatch", TickProfile::safety},
    {"WheelController", TickProfile::control},
    {"Wheels::control", TickProfile::control},
    {"Drive::output", TickProfile::control},
};

TickProfile::Part part_of(const std::vector<std::string>& frames) {
  for (const std::string& frame : frames)
    for (const Rule& rule : kRules)
      if (frame.find(rule.name) != std::string::npos) return rule.part;
  return TickProfile::rest;
}

/// The part of each halfword of code, by the debugger's knowledge of what was inlined where.
std::vector<TickProfile::Part> map_code(const std::string& elf) {
  constexpr std::uint32_t kBytes = 64 * 1024;
  const test::TemporaryFolder folder;
  const std::string list = folder.path() / "addresses";
  {
    std::ofstream file(list);
    for (std::uint32_t address = 0x20; address < kBytes; address += 2) file << fmt::format("{:x}\n", address);
  }
  std::istringstream lines(output_of("arm-none-eabi-addr2line -a -f -i -C -e '" + elf + "' @" + list));
  std::vector<TickProfile::Part> parts(kBytes / 2, TickProfile::rest);
  std::vector<std::string> frames;
  std::size_t current = 0;
  for (std::string line, place; std::getline(lines, line);) {
    if (line.starts_with("0x")) {
      if (current != 0) parts[current / 2] = part_of(frames);
      current = std::stoul(line, nullptr, 16);
      frames.clear();
    } else {
      frames.push_back(line);
      std::getline(lines, place);
    }
  }
  return parts;
}

}  // namespace

TickProfile::TickProfile(emulator::Teensy& teensy, const std::string& elf)
    : teensy_(teensy), part_of_(map_code(elf)) {
  auto& cpu = teensy_.chip().cpu();
  cpu.trace = [this, &cpu](std::uint32_t address, std::uint32_t instructions) {
    const bool tick = (cpu.get(UC_ARM_REG_IPSR) & 0x1FF) == kTick;
    if (in_tick_ && !tick) finish();
    in_tick_ = tick;
    if (!tick) return;
    const Counts& counts = counts_of(address, instructions);
    for (std::size_t i = 0; i < kParts; ++i) now_[i] += counts[i];
  };
}

const TickProfile::Counts& TickProfile::counts_of(std::uint32_t address, std::uint32_t instructions) {
  const auto [entry, fresh] = blocks_.try_emplace({address, instructions});
  if (!fresh) return entry->second;
  for (std::uint32_t i = 0; i < instructions; ++i) {
    ++entry->second[address / 2 < part_of_.size() ? part_of_[address / 2] : rest];
    const auto code = teensy_.chip().memory().at(address, 2);
    address += code[1] >= 0xE8 ? 4 : 2;
  }
  return entry->second;
}

void TickProfile::finish() {
  std::array<std::uint32_t, kParts + 2> row{};
  for (std::size_t i = 0; i < kParts; ++i) {
    row[i] = now_[i];
    row[kParts] += now_[i];
  }
  row[kParts + 1] = now_[control] + now_[odometry] + now_[safety];
  if (row[kParts] > worst_[kParts]) longest_ = row;
  for (std::size_t i = 0; i < row.size(); ++i) {
    worst_[i] = std::max(worst_[i], row[i]);
    sum_[i] += row[i];
  }
  ++ticks_;
  now_ = {};
}

TickProfile::Cost TickProfile::cost(std::size_t row) const {
  return {worst_[row], ticks_ == 0 ? 0 : static_cast<double>(sum_[row]) / static_cast<double>(ticks_)};
}

void TickProfile::print(std::uint32_t bar) const {
  fmt::print("instructions of {} control ticks   worst     mean   in the longest\n", ticks_);
  for (std::size_t i = 0; i < kParts; ++i)
    fmt::print("  {:<32} {:>6} {:>8.1f} {:>7}\n", kNames[i], cost(i).worst, cost(i).mean, longest_[i]);
  fmt::print("  {:<32} {:>6} {:>8.1f}\n", "whole tick", whole().worst, whole().mean);
  fmt::print("  {:<32} {:>6} {:>8.1f}   of {}\n", "control + odometry + safety", budgeted().worst,
             budgeted().mean, bar);
}

}  // namespace astro::target
