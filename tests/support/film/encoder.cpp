#include "tests/support/film/encoder.hpp"

#include <cmath>
#include <csignal>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/film/raw_video.hpp"

namespace astro::support::film {
namespace {

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char letter : word) text += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return text + "'";
}

std::string command_line(const std::filesystem::path& mp4, double fps, const Codec& codec) {
  const std::string rate = codec.mbit_per_s > 0
                               ? "-b:v " + std::to_string(std::lround(codec.mbit_per_s * 1e6)) + " -bf 2"
                               : std::string("-qp 0");
  return "ffmpeg -nostdin -loglevel error -y -f matroska -i pipe:0 -an -c:v libx264 -preset " +
         std::string(codec.preset) + " " + rate + " -g " + std::to_string(std::lround(fps)) +
         " -threads 1 -pix_fmt yuv420p -fps_mode passthrough -enc_time_base 1:90000 "
         "-video_track_timescale 90000 " +
         quoted(mp4.string());
}

}  // namespace

Encoder::Encoder(const std::filesystem::path& mp4, int width_px, int height_px, double fps,
                 const Codec& codec)
    : mp4_(mp4), colour_bytes_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) / 2) {
  std::signal(SIGPIPE, SIG_IGN);  // a child that ended early is an error of write
  pipe_ = popen(command_line(mp4, fps, codec).c_str(), "w");
  if (pipe_ == nullptr) throw std::runtime_error("ffmpeg cannot be started");
  write(raw_video_header(width_px, height_px, fps));
}

Encoder::~Encoder() {
  if (pipe_ != nullptr) pclose(pipe_);
}

void Encoder::add(double pts_s, std::span<const std::uint8_t> brightness) {
  static const std::vector<std::uint8_t> no_colour(std::size_t{1} << 22, 128);
  write(raw_video_frame_header(std::llround(pts_s * 1e6), brightness.size() + colour_bytes_));
  write(brightness);
  write(std::span(no_colour).first(colour_bytes_));
}

void Encoder::finish() {
  const int status = pclose(pipe_);
  pipe_ = nullptr;
  if (status != 0) throw std::runtime_error("ffmpeg did not write " + mp4_.string());
}

void Encoder::write(std::span<const std::uint8_t> bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), pipe_) != bytes.size())
    throw std::runtime_error("ffmpeg ended early: " + mp4_.string());
}

}  // namespace astro::support::film
