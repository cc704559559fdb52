#pragma once

#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "host/truth/live/scan_link.hpp"
#include "host/truth/source/source.hpp"

namespace astro::truth {

/// The port in "lidar:PORT"; nothing if the text is meant otherwise.
std::optional<std::string> scanner_port_in(std::string_view text);

/// Mirror images of scans: of a scanner that hangs upside down, or whose beams run the other way round than its scans say.
enum class Mirrored : bool { no, yes };

/// A laser scanner on the robot. It gives scans and no poses: those follow from them after the run. A thread reads it, because times
/// follow from when bytes arrive.
///
/// Start   the constructor returns once the first scan has come. Throws as the link does, and with ScannerProblem::stopped if none
///         comes within five seconds.
/// Run     begin_run() returns once a scan that began after the call has come, and throws if none does within three seconds.
/// Bounds  if nobody takes scans, some hundred of the newest are kept.
/// Errors  begin_run(), poll() and take_scans() throw what the link has thrown in the thread.
class ScannerSource : public Source {
 public:
  explicit ScannerSource(std::unique_ptr<ScanLink> link, Mirrored mirrored = Mirrored::no);

  void begin_run() override;
  std::vector<recording::TruthSample> poll() override;
  std::vector<lidar::Scan> take_scans() override;
  std::string name() const override { return "lidar"; }
  std::string clock() const override { return "host"; }
  std::string description() const override { return description_; }

 private:
  void listen(const std::stop_token& stop);
  lidar::Scan await_scan(std::chrono::microseconds timeout);
  void rethrow();

  std::unique_ptr<ScanLink> link_;  // read by the thread alone, once it runs
  Mirrored mirrored_;
  std::string description_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<lidar::Scan> scans_;  // guarded by the mutex, as the next one
  std::exception_ptr failure_;      // by which the thread has ended
  std::jthread thread_;             // the last member, so that it ends before the others are destroyed
};

}  // namespace astro::truth
