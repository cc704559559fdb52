#include "host/truth/live/rplidar_link.hpp"

#include <fmt/format.h>

#include <utility>

#include "host/truth/live/scanner_port.hpp"

namespace astro::truth {

RplidarLink::RplidarLink(const std::string& port) : RplidarLink(std::make_unique<ScannerPort>(port)) {}

RplidarLink::RplidarLink(std::unique_ptr<rplidar::Line> line)
    : port_(line->name()), driver_(std::move(line)) {}

std::string RplidarLink::description() const {
  return fmt::format("RPLIDAR {} at {} baud", driver_.info().name(), driver_.baud());
}

}  // namespace astro::truth
