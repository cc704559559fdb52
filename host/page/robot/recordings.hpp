#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/page/robot/watched_recording.hpp"

namespace astro::page {

/// Where recordings are written, and what becomes of those that no page has removed.
struct RecordingPlace {
  std::filesystem::path folder{};
  /// Of all that no page has removed, together: in a browser they are in memory. At 1 kHz this is more than half an hour.
  std::uint64_t most_bytes = 512'000'000;
  /// Receives each recording that no page has removed, before the folder may go.
  std::function<void(const std::filesystem::path&)> keep = [](const std::filesystem::path&) {};
};

/// The recording that is under way, and those that have ended and that no page has removed. What was driven cannot be driven
/// again, so whatever ends a recording, it stays until a page says that a person has it, or does not want it.
class Recordings {
 public:
  explicit Recordings(RecordingPlace place) : place_(std::move(place)) {}
  /// Ends the one under way, and gives all to RecordingPlace::keep.
  ~Recordings();
  Recordings(const Recordings&) = delete;
  Recordings& operator=(const Recordings&) = delete;

  /// Throws astro::Error if it cannot be written, or if the others leave no room.
  void begin(const recording::RunInfo& info);
  /// Throws nothing, as WatchedRecording::add.
  void add(const protocol::Telemetry& telemetry, const std::vector<recording::TruthSample>& truth);
  /// Ends the one under way; its file. Throws astro::Error if it could not be written as a whole: what is there of it stays, too.
  std::string end();
  /// Nothing happens if there is none of this name.
  void remove(const std::string& file);

  bool under_way() const { return recording_.has_value(); }
  /// Whether the one under way leaves no room for more of it.
  bool full() const;
  /// The file under way, below the folder, which has this name once it has ended; "" if there is none.
  std::string file() const { return recording_ ? recording_->file() : ""; }
  const std::vector<std::string>& ended() const { return ended_; }

 private:
  std::uint64_t bytes_of(const std::string& file) const;
  std::uint64_t ended_bytes() const;

  RecordingPlace place_;
  std::optional<WatchedRecording> recording_;
  std::vector<std::string> ended_;
};

}  // namespace astro::page
