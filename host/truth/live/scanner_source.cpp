#include "host/truth/live/scanner_source.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "host/base/blocked_signals.hpp"
#include "host/base/error.hpp"
#include "host/lidar/surface.hpp"
#include "host/truth/scanners/rplidar_driver.hpp"

namespace astro::truth {
namespace {

using namespace std::chrono_literals;
using std::chrono::microseconds;

constexpr std::string_view kScheme = "lidar:";
constexpr microseconds kLook = 20ms;  // the longest that the thread waits for bytes, and until it can end
constexpr microseconds kFirstScan = 5s, kNextScan = 3s;
constexpr std::size_t kMostScansKept = 512;

std::int64_t steady_ns() {
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

std::optional<std::string> scanner_port_in(std::string_view text) {
  if (!text.starts_with(kScheme) || text.size() == kScheme.size()) return std::nullopt;
  return std::string(text.substr(kScheme.size()));
}

ScannerSource::ScannerSource(std::unique_ptr<ScanLink> link, Mirrored mirrored)
    : link_(std::move(link)), mirrored_(mirrored) {
  const std::string what = link_->description();
  {
    const BlockedSignals blocked;
    thread_ = std::jthread([this](const std::stop_token& stop) { listen(stop); });
  }
  const lidar::Scan scan = await_scan(kFirstScan);
  const double turn_s = scan.beam_interval_s * static_cast<double>(scan.ranges_m.size());
  description_ = fmt::format("{}, {} beams", what, scan.ranges_m.size());
  if (turn_s > 0) description_ += fmt::format(" {:.1f} times a second", 1 / turn_s);
}

void ScannerSource::listen(const std::stop_token& stop) {
  try {
    while (!stop.stop_requested()) {
      std::vector<lidar::Scan> scans = link_->poll(kLook);
      if (scans.empty()) continue;
      const std::lock_guard lock(mutex_);
      if (scans_.size() > kMostScansKept) scans_.erase(scans_.begin(), scans_.begin() + kMostScansKept / 2);
      for (lidar::Scan& scan : scans)
        scans_.push_back(mirrored_ == Mirrored::yes ? lidar::mirrored(std::move(scan)) : std::move(scan));
      changed_.notify_one();
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
    changed_.notify_one();
  }
}

/// Discards scans that began before now; a copy of the first that did not.
lidar::Scan ScannerSource::await_scan(microseconds timeout) {
  std::unique_lock lock(mutex_);
  const std::int64_t now_ns = steady_ns();
  changed_.wait_for(lock, timeout, [&] {
    std::erase_if(scans_, [&](const lidar::Scan& scan) { return scan.time_ns < now_ns; });
    return failure_ || !scans_.empty();
  });
  if (failure_) std::rethrow_exception(failure_);
  if (scans_.empty())
    throw Error(
        fmt::format("{} has sent no whole turn for {} s: {}", link_->subject(), timeout / 1s, link_->doubt()),
        rplidar::ScannerProblem::stopped, {link_->subject(), std::to_string(timeout / 1s)});
  return scans_.front();
}

void ScannerSource::begin_run() { await_scan(kNextScan); }

std::vector<recording::TruthSample> ScannerSource::poll() {
  rethrow();
  return {};
}

void ScannerSource::rethrow() {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
}

std::vector<lidar::Scan> ScannerSource::take_scans() {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
  return std::exchange(scans_, {});
}

}  // namespace astro::truth
