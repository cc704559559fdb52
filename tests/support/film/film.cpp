#include "tests/support/film/film.hpp"

#include <cmath>
#include <csignal>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/bytes.hpp"

namespace astro::support::film {

namespace {

// Uncompressed video with a stamp for each picture, as a stream that ffmpeg reads from a pipe: just enough Matroska (RFC 9559,
// RFC 8794). Pictures are I420: brightness, then two planes of colour of half the width and height.

void append_big_endian(Bytes& bytes, std::uint64_t value, int count) {
  for (int byte = count - 1; byte >= 0; --byte)
    bytes.push_back(static_cast<std::uint8_t>(value >> (8 * byte)));
}

/// Ids carry their own length: 1A45DFA3 has four bytes.
void append_id(Bytes& bytes, std::uint32_t id) {
  append_big_endian(bytes, id, id > 0xFFFFFF ? 4 : id > 0xFFFF ? 3 : id > 0xFF ? 2 : 1);
}

/// Always eight bytes long.
void append_size(Bytes& bytes, std::uint64_t size) {
  append_big_endian(bytes, (std::uint64_t{1} << 56) | size, 8);
}
constexpr std::uint64_t kUnknownSize = (std::uint64_t{1} << 56) - 1;

Bytes element(std::uint32_t id, ByteView content) {
  Bytes bytes;
  append_id(bytes, id);
  append_size(bytes, content.size());
  append(bytes, content);
  return bytes;
}

Bytes number(std::uint32_t id, std::uint64_t value) {
  Bytes content;
  append_big_endian(content, value, 8);
  return element(id, content);
}

Bytes text(std::uint32_t id, std::string_view words) { return element(id, as_bytes(words)); }

Bytes master(std::uint32_t id, std::initializer_list<Bytes> children) {
  Bytes content;
  for (const Bytes& child : children) append(content, child);
  return element(id, content);
}

Bytes raw_video_header(int width_px, int height_px, double fps) {
  Bytes bytes =
      master(0x1A45DFA3, {number(0x4286, 1), number(0x42F7, 1), number(0x42F2, 4), number(0x42F3, 8),
                          text(0x4282, "matroska"), number(0x4287, 4), number(0x4285, 2)});
  append_id(bytes, 0x18538067);  // the segment, which has no end
  append_size(bytes, kUnknownSize);
  append(bytes, master(0x1549A966, {number(0x2AD7B1, 1000), text(0x4D80, "tests"), text(0x5741, "tests")}));
  const auto interval_ns = static_cast<std::uint64_t>(std::llround(1e9 / fps));
  const Bytes video =
      master(0xE0, {number(0xB0, static_cast<std::uint64_t>(width_px)),
                    number(0xBA, static_cast<std::uint64_t>(height_px)), text(0x2EB524, "I420")});
  append(bytes, master(0x1654AE6B,
                       {master(0xAE, {number(0xD7, 1), number(0x73C5, 1), number(0x83, 1),
                                      number(0x23E383, interval_ns), text(0x86, "V_UNCOMPRESSED"), video})}));
  return bytes;
}

/// What comes before the bytes of a picture.
Bytes raw_video_frame_header(std::int64_t pts_us, std::size_t picture_bytes) {
  // A cluster for each picture, because a block's own stamp has only 16 bits.
  const Bytes stamp = number(0xE7, static_cast<std::uint64_t>(pts_us));
  constexpr std::uint8_t kBlock[] = {0x81, 0, 0, 0x80};  // track 1, at the cluster's stamp, a key frame
  Bytes block;
  append_id(block, 0xA3);
  append_size(block, sizeof kBlock + picture_bytes);
  append(block, ByteView(kBlock));
  Bytes bytes;
  append_id(bytes, 0x1F43B675);
  append_size(bytes, stamp.size() + block.size() + picture_bytes);
  append(bytes, stamp);
  append(bytes, block);
  return bytes;
}

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

TrueFrame true_frame(const FilmSetup& setup, const FrameTime& time) {
  const FilmedRobot& robot = setup.scene.robots.front();
  const Camera camera = setup.camera(time.pts_s);
  TrueFrame frame{time, robot.tag_at(time.robot_s), 0, time.robot_s, {}};
  for (int round = 0; round < 5;
       ++round) {  // the tag moves by less than a row in a row's time: converges at once
    frame.at_row = robot.tag_at(frame.row_s);
    frame.row = seen_at(setup.lens, camera, {frame.at_row.x_m, frame.at_row.y_m, robot.height_m}).v;
    frame.row_s = setup.shutter.row_s(time.robot_s, frame.row, setup.lens.height_px);
  }
  return frame;
}

std::vector<TrueFrame> make_film(const FilmSetup& setup, const std::filesystem::path& mp4) {
  Renderer renderer(setup.scene, setup.lens, setup.blur_px, setup.sensor, setup.seed);
  Encoder encoder(mp4, setup.lens.width_px, setup.lens.height_px, setup.clock.fps, setup.codec);
  std::vector<std::uint8_t> picture(static_cast<std::size_t>(setup.lens.width_px) *
                                    static_cast<std::size_t>(setup.lens.height_px));
  std::vector<TrueFrame> truth;
  for (const FrameTime& time : frame_times(setup.clock, setup.begin_s, setup.end_s, setup.cut)) {
    renderer.render(setup.camera(time.pts_s), setup.shutter, time.robot_s, picture.data());
    encoder.add(time.pts_s, picture);
    truth.push_back(true_frame(setup, time));
  }
  encoder.finish();
  return truth;
}

}  // namespace astro::support::film
