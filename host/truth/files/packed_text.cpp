#include "host/truth/files/packed_text.hpp"

#include <zlib.h>

#include <algorithm>
#include <limits>

#include "host/base/error.hpp"

namespace astro::truth {
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
  /// A file may be several packed parts after each other.
  void next_part() { inflateReset(&stream_); }

 private:
  z_stream stream_{};
};

}  // namespace

bool is_gzip(ByteView bytes) { return bytes.size() > 2 && bytes[0] == 0x1f && bytes[1] == 0x8b; }

std::string unpacked(ByteView bytes, const std::string& file) {
  const std::size_t most = 4 * bytes.size() + (std::size_t{32} << 20);
  std::string text;
  Inflater inflater;
  std::size_t taken = 0;
  while (true) {
    const std::size_t part = std::min<std::size_t>(bytes.size() - taken, std::numeric_limits<uInt>::max());
    inflater->next_in = const_cast<Bytef*>(bytes.data() + taken);  // zlib reads it only
    inflater->avail_in = static_cast<uInt>(part);
    char out[65536];
    inflater->next_out = reinterpret_cast<Bytef*>(out);
    inflater->avail_out = sizeof out;
    const int state = inflater.step();
    taken += part - inflater->avail_in;
    text.append(out, sizeof out - inflater->avail_out);
    if (text.size() > most)
      throw Error("'" + file + "' unpacks to more than " + std::to_string(most >> 20) + " MiB",
                  {Help::unpack_first});
    if (state == Z_STREAM_END && taken == bytes.size()) return text;
    if (state == Z_STREAM_END && is_gzip(bytes.subspan(taken))) {
      inflater.next_part();
    } else if (state == Z_STREAM_END) {
      return text;  // what follows is padding, as from a tape
    } else if (state != Z_OK) {
      throw Error("'" + file + "' is packed with gzip and " +
                      (taken == bytes.size() ? "cut off" : "damaged") + " at byte " + std::to_string(taken),
                  {Help::use_original});
    }
  }
}

}  // namespace astro::truth
