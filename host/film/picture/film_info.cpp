#include "host/film/picture/film_info.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/base/text/numbers.hpp"
#include "host/film/picture/film_program.hpp"
#include "host/film/picture/how_to_film.hpp"

namespace astro::film {
namespace {

constexpr std::size_t kMostSaid = 65'536;

/// Reads a ratio such as "30000/1001" or "30"; 0 if the text is neither.
double ratio_in(const std::string& text) {
  const std::size_t slash = text.find('/');
  const double above = number_in(text.substr(0, slash)).value_or(0);
  const double below = slash == std::string::npos ? 1 : number_in(text.substr(slash + 1)).value_or(0);
  return below > 0 ? above / below : 0;
}

using Fields = std::map<std::string, std::string>;

Fields fields_in(const std::string& text) {
  Fields fields;
  std::istringstream lines(text);
  std::string section;
  for (std::string line; std::getline(lines, line);) {
    if (line == "[FORMAT]") section = "format.";
    // A container that states only its own length says N/A for that of the stream.
    if (const std::size_t sign = line.find('='); sign != std::string::npos && line.substr(sign + 1) != "N/A")
      fields.emplace(section + line.substr(0, sign), line.substr(sign + 1));
  }
  return fields;
}

double number_of(const Fields& fields, const std::string& name) {
  const auto found = fields.find(name);
  const double value = found == fields.end() ? 0 : ratio_in(found->second);
  return std::isfinite(value) && value > -1e9 && value < 1e9 ? value : 0;
}

/// The time from the first picture to the end. If only the container states its length, that begins at time
/// 0, so the start time is subtracted.
double duration_of(const Fields& fields) {
  if (const double own_s = number_of(fields, "duration"); own_s > 0) return own_s;
  return std::max(
      0.0, number_of(fields, "format.duration") - std::max(0.0, number_of(fields, "format.start_time")));
}

/// Whether the file begins like MP4 or MOV. ffprobe goes by the file's name instead.
bool begins_as_film(const std::filesystem::path& film) {
  std::array<char, 8> head{};
  std::ifstream(film, std::ios::binary).read(head.data(), head.size());
  return std::string_view(head.data() + 4, 4) == "ftyp";
}

[[noreturn]] void refuse(const std::filesystem::path& film, const std::string& why) {
  if (why.find("moov atom not found") != std::string::npos && begins_as_film(film))
    throw Error("'" + film.string() +
                "' is a truncated film: its table of pictures, which a camera writes last, is missing" +
                how_to::kTakeOriginal);
  throw Error("'" + film.string() +
                  "' is not a film that ffprobe can read: name the film that the phone recorded (MP4 or MOV)",
              FilmFileProblem::not_a_film, {film.string()});
}

}  // namespace

std::vector<std::string> as_input(const std::filesystem::path& film) {
  constexpr const char* kContainers = "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm,avi,mpegts";
  return {"-protocol_whitelist", "file", "-format_whitelist", kContainers, "-i", "file:" + film.string()};
}

FilmInfo read_film_info(const std::filesystem::path& film) {
  require_file(film);
  std::string said;
  std::vector<std::string> words{
      "ffprobe",
      "-loglevel",
      "error",
      "-select_streams",
      "v:0",
      "-show_entries",
      "stream=codec_name,width,height,avg_frame_rate,nb_frames,duration:stream_side_data="
      "rotation:format=duration,start_time",
      "-of",
      "default"};
  for (std::string& word : as_input(film)) words.push_back(std::move(word));
  FilmProgram probe(std::move(words), [&](std::string_view line) {
    if (said.size() < kMostSaid) said.append(line.substr(0, 400)).append("\n");
  });
  std::array<std::uint8_t, 8192> buffer;
  const std::size_t count = probe.read(buffer);
  const bool good = probe.finish();
  const Fields fields = fields_in(std::string(buffer.begin(), buffer.begin() + static_cast<long>(count)));
  FilmInfo info;
  info.width = static_cast<int>(number_of(fields, "width"));
  info.height = static_cast<int>(number_of(fields, "height"));
  if (!good || info.width <= 0 || info.height <= 0) refuse(film, said);
  info.rotation_deg = static_cast<int>(std::lround(number_of(fields, "rotation")));
  if (fields.contains("codec_name")) info.codec = fields.at("codec_name");
  info.frames_per_s = number_of(fields, "avg_frame_rate");
  info.duration_s = duration_of(fields);
  info.frames = static_cast<std::size_t>(std::max(0.0, number_of(fields, "nb_frames")));
  // No phone has more than 8K, 7680 x 4320. The search for tags takes ten bytes for each pixel.
  constexpr int kLeastSide_px = 64, kMostSide_px = 8192;
  if (info.width < kLeastSide_px || info.height < kLeastSide_px || info.width > kMostSide_px ||
      info.height > kMostSide_px)
    throw Error(
        fmt::format("'{}' has pictures of {} x {} pixels, and those with {} to {} pixels on each side can "
                    "be followed: name the film that the phone recorded (MP4 or MOV)",
                    film.string(), info.width, info.height, kLeastSide_px, kMostSide_px),
        FilmFileProblem::unusual_size,
        {film.string(), std::to_string(info.width), std::to_string(info.height)});
  return info;
}

}  // namespace astro::film
