// Datagrams from anybody, judged before Fast DDS reads them.
#include "host/live/dds/rtps_check.hpp"
#include "host/live/dds/rtps_compatibility.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/ros2/rtps_samples.hpp"

namespace astro::fuzz {
namespace {

/// Walks the submessages in the plainest way: to the end exactly, and none of a vendor.
bool is_chain(ByteView sound) {
  std::size_t at = 20;
  while (at + 4 <= sound.size()) {
    if (sound[at] >= 0x80) return false;
    const bool little = (sound[at + 1] & 1) != 0;
    const std::size_t length = sound[at + (little ? 2 : 3)] | sound[at + (little ? 3 : 2)] << 8;
    const bool may_be_empty = sound[at] == 0x01 || sound[at] == 0x09;
    at = length == 0 && !may_be_empty ? sound.size() : at + 4 + length;
  }
  return at == sound.size();
}

}  // namespace

void take(ByteView input) {
  const ByteView sound = dds::sound_part(input);
  require(sound.empty() || sound.data() == input.data(), "what is passed on is where the datagram begins");
  require(sound.empty() || is_chain(sound), "it is whole submessages");
  const ByteView again = dds::sound_part(sound);
  require(again.size() == sound.size(), "it is sound when it is judged again");
  dds::acknowledgements_in(sound);
  dds::AcknowledgementCounts counts;
  if (const auto changed = dds::for_fast_dds(sound, counts))
    require(changed->size() == sound.size() && dds::sound_part(*changed).size() == sound.size(),
            "what is changed for Fast DDS is as long and as sound");
}

std::vector<Bytes> seeds() {
  std::vector<Bytes> seeds;
  for (const std::string_view sample : support::kRtpsSamples) seeds.push_back(support::bytes_in(sample));
  return seeds;
}

}  // namespace astro::fuzz
