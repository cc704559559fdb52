// Text that was packed with gzip.
#include "host/formats/tables/packed_text.hpp"

#include "host/base/error.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/host/import/drives/file_samples.hpp"
#include "tests/host/truth/files/own_recordings.hpp"

namespace astro::fuzz {

void take(ByteView input) {
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
  return {parts, support::gzip(""), support::gzip(std::string(100'000, '\n'))};
}

}  // namespace astro::fuzz
