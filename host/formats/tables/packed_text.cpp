#include "host/formats/tables/packed_text.hpp"

#include <zlib.h>

#include <algorithm>
#include <utility>

#include "host/base/error.hpp"

namespace astro::tables {
namespace {

constexpr int kGzipWindow = 16 + MAX_WBITS;  // zlib's way to say: gzip's header, the largest window

class Inflater {
 public:
  Inflater() { inflateInit2(&stream_, kGzipWindow); }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  z_stream* operator->() { return &stream_; }
  int step() { return inflate(&stream_, Z_NO_FLUSH); }
  /// A file may consist of several packed parts, one after the other.
  void next_part() { inflateReset(&stream_); }

 private:
  z_stream stream_{};
};

/// Collects a text, unless it would take too much memory together with its poses, or these when they are put
/// on the floor.
class BoundedText {
  // A line becomes a pose, which is put on the floor.
  static constexpr std::size_t kBytesOfPose = 72, kBytesOnFloor = 152;

 public:
  explicit BoundedText(std::size_t most_bytes) : most_(most_bytes) {
    text_.reserve(most_);  // memory that is not written to is not taken; a text that grows would be copied
  }

  /// False if it would take more than it may.
  bool add(ByteView piece) {
    lines_ += static_cast<std::size_t>(std::count(piece.begin(), piece.end(), std::uint8_t{'\n'}));
    if (text_.size() + piece.size() + kBytesOfPose * lines_ > most_) return false;
    if (kBytesOnFloor * lines_ > most_) return false;
    append(text_, piece);
    return true;
  }
  Bytes take() { return std::move(text_); }

 private:
  std::size_t most_, lines_ = 0;
  Bytes text_;
};

class Unpacking {
 public:
  Unpacking(ByteSource& file, const std::string& name)
      : file_(file),
        name_(name),
        most_(static_cast<std::size_t>(4 * file.size() + kFreeBytes)),
        text_(most_) {}

  Bytes text() {
    while (true) {
      const int state = step();
      if (state == Z_STREAM_END && !begins_part()) return text_.take();  // padding may follow, as from a tape
      if (state == Z_STREAM_END) {
        inflater_.next_part();
      } else if (state != Z_OK) {
        const bool cut = taken_ == file_.size();
        throw Error("'" + name_ + "' is packed with gzip and " + (cut ? "cut off" : "damaged") + " at byte " +
                        std::to_string(taken_) + "; use the original",
                    cut ? PackedProblem::cut_off : PackedProblem::damaged, {name_, std::to_string(taken_)});
      }
    }
  }

 private:
  static constexpr std::size_t kFreeBytes = std::size_t{56} << 20, kPieceBytes = 65'536;

  ByteView packed_at(std::uint64_t at, std::size_t most) {
    return file_.read(at, static_cast<std::size_t>(std::min<std::uint64_t>(file_.size() - at, most)));
  }
  bool begins_part() { return is_gzip(packed_at(taken_, 3)); }

  /// Expands one piece; returns zlib's state.
  int step() {
    const ByteView packed = packed_at(taken_, kPieceBytes);
    inflater_->next_in = const_cast<Bytef*>(packed.data());  // zlib reads it only
    inflater_->avail_in = static_cast<uInt>(packed.size());
    std::uint8_t out[kPieceBytes];
    inflater_->next_out = out;
    inflater_->avail_out = sizeof out;
    const int state = inflater_.step();
    taken_ += packed.size() - inflater_->avail_in;
    if (!text_.add(ByteView(out).first(sizeof out - inflater_->avail_out)))
      throw Error("'" + name_ + "' unpacks to more than can be held: with its poses " +
                      std::to_string(most_ >> 20U) + " MiB: unpack it with gunzip first",
                  PackedProblem::too_large, {name_, std::to_string(most_ >> 20U)});
    return state;
  }

  ByteSource& file_;
  const std::string& name_;
  std::size_t most_;
  BoundedText text_;
  Inflater inflater_;
  std::uint64_t taken_ = 0;
};

}  // namespace

bool is_gzip(ByteView bytes) { return bytes.size() > 2 && bytes[0] == 0x1f && bytes[1] == 0x8b; }

Bytes unpacked(ByteSource& file, const std::string& name) { return Unpacking(file, name).text(); }

}  // namespace astro::tables
