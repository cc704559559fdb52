#include "host/page/robot/recordings.hpp"

#include <exception>
#include <numeric>
#include <system_error>

#include "host/base/error.hpp"

namespace astro::page {
namespace {

/// Of a recording that is under way, or could not be ended (host/base/files.hpp).
std::string part_of(const std::string& file) { return file + ".part"; }

}  // namespace

Recordings::~Recordings() {
  try {
    if (recording_) end();
  } catch (const std::exception&) {  // what is there of it is kept all the same
  }
  for (const std::string& file : ended_) try {
      place_.keep(place_.folder / file);
    } catch (const std::exception&) {  // the others are kept all the same
    }
}

void Recordings::begin(const recording::RunInfo& info) {
  if (ended_bytes() >= place_.most_bytes)
    throw Error(
        "the recordings take all the room that there is for them: save them, and remove what is saved");
  recording_.emplace(place_.folder, info);
}

void Recordings::add(const protocol::Telemetry& telemetry, const std::vector<recording::TruthSample>& truth) {
  recording_->add(telemetry, truth);
}

std::string Recordings::end() {
  const std::string file = recording_->file();
  try {
    recording_->close();
  } catch (...) {
    recording_.reset();
    if (bytes_of(part_of(file)) > 0) ended_.push_back(part_of(file));
    throw;
  }
  recording_.reset();
  ended_.push_back(file);
  return file;
}

void Recordings::remove(const std::string& file) {
  std::error_code gone;
  if (std::erase(ended_, file) > 0) std::filesystem::remove(place_.folder / file, gone);
}

bool Recordings::full() const {
  return recording_ && ended_bytes() + bytes_of(part_of(recording_->file())) >= place_.most_bytes;
}

std::uint64_t Recordings::bytes_of(const std::string& file) const {
  std::error_code gone;
  const std::uintmax_t bytes = std::filesystem::file_size(place_.folder / file, gone);
  return gone ? 0 : bytes;
}

std::uint64_t Recordings::ended_bytes() const {
  return std::accumulate(ended_.begin(), ended_.end(), std::uint64_t{0},
                         [this](std::uint64_t sum, const std::string& file) { return sum + bytes_of(file); });
}

}  // namespace astro::page
