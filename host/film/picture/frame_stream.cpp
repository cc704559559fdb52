#include "host/film/picture/frame_stream.hpp"

#include <charconv>
#include <optional>
#include <utility>
#include <vector>

#include "host/base/error.hpp"

namespace astro::film {
namespace {

std::vector<std::string> words_for(const std::filesystem::path& film, FrameStream::Pictures pictures) {
  std::vector<std::string> words{"ffmpeg",     "-hide_banner", "-nostdin", "-nostats",      "-loglevel",
                                 "level+info", "-threads",     "1",        "-noautorotate", "-copyts"};
  if (pictures == FrameStream::Pictures::key_only) words.insert(words.end(), {"-skip_frame", "nokey"});
  // Rawvideo has no times, so showinfo reports each picture's time in whole units of the time base. The
  // encoder keeps the film's time base (-1). With one unit per picture the muxer would complain about films
  // whose rate differs a little from the stated one.
  for (std::string& word : as_input(film)) words.push_back(std::move(word));
  words.insert(words.end(), {"-map", "0:v:0", "-vf", "showinfo=checksum=0", "-fps_mode", "passthrough",
                             "-enc_time_base", "-1", "-pix_fmt", "gray", "-f", "rawvideo", "pipe:1"});
  return words;
}

/// The whole number that follows `name` and blanks.
std::optional<long long> whole_behind(std::string_view line, std::string_view name) {
  const std::size_t at = line.find(name);
  if (at == std::string_view::npos) return std::nullopt;
  line.remove_prefix(at + name.size());
  while (line.starts_with(' ')) line.remove_prefix(1);
  long long value = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
  if (error != std::errc{}) return std::nullopt;
  return value;
}

}  // namespace

FrameStream::FrameStream(const std::filesystem::path& film, const FilmInfo& info, Pictures pictures)
    : width_(info.width),
      height_(info.height),
      decoder_(words_for(film, pictures), [this](std::string_view line) { take_line(line); }) {}

void FrameStream::take_line(std::string_view line) {
  if (line.find("showinfo") == std::string_view::npos) {
    if (line.starts_with("[rawvideo")) return;  // complains about times, which rawvideo does not write
    if (line.find("[error]") != std::string_view::npos || line.find("[fatal]") != std::string_view::npos)
      complaint_ = line.substr(line.rfind(']') + 1);
    return;
  }
  if (line.find("config in") != std::string_view::npos) {
    const auto above = whole_behind(line, "time_base:");
    const auto below = whole_behind(line, "/");
    if (above && below && *below > 0)
      time_base_s_ = static_cast<double>(*above) / static_cast<double>(*below);
    return;
  }
  if (const auto pts = whole_behind(line, " pts:"))
    stamps_.push_back(
        {static_cast<double>(*pts) * time_base_s_, whole_behind(line, "iskey:").value_or(0) == 1});
}

bool FrameStream::next(GrayFrame& frame) {
  frame.width = width_;
  frame.height = height_;
  frame.pixels.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  if (decoder_.read(frame.pixels) < frame.pixels.size()) return false;
  if (stamps_.empty())
    throw Error(
        "ffmpeg does not report the times of the film's pictures: name the film that the phone recorded (MP4 "
        "or MOV)");
  frame.pts_s = stamps_.front().pts_s;
  frame.key = stamps_.front().key;
  stamps_.pop_front();
  return true;
}

}  // namespace astro::film
