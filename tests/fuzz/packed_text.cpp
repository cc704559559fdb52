// Text that was packed with gzip, or is in UTF-16.
#include "host/formats/tables/packed_text.hpp"

#include "host/base/error.hpp"
#include "host/formats/tables/text_file.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/host/import/drives/file_samples.hpp"
#include "tests/host/truth/files/own_recordings.hpp"

namespace astro::fuzz {

void take(ByteView input) {
  const Bytes recoded = tables::in_utf8(Bytes(input.begin(), input.end()));
  require(recoded.size() <= 2 * input.size(), "a text in UTF-16 grows by half at most");
  MemorySource source(input);
  try {
    const Bytes text = tables::unpacked(source, "x.gz");
    require(text.size() <= 4 * input.size() + (std::size_t{56} << 20), "a text is no longer than allowed");
  } catch (const Error&) {
  }
}

std::vector<Bytes> seeds() {
  Bytes parts = support::gzip(test::kMotive);
  append(parts, ByteView(support::gzip(test::kTum)));
  return {parts, bytes_of({"\xFF\xFEt\0,\0\xB5\0\n\0", 10}), bytes_of({"\0a\0;\xD8\x3D\xDE\0", 8}),
          support::gzip(""), support::gzip(std::string(100'000, '\n'))};
}

}  // namespace astro::fuzz
