// SETUP packets and data for endpoint 0 of the robot's USB stack.
#include <cstring>

#include "hal/usb/control.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {

void take(ByteView input) {
  using namespace usb_device;  // NOLINT(google-build-using-namespace): this function is all USB
  Control control;
  control.start({0x16C0, 0x0483, 0x0279, Speed::high}, "0123456789abcdef0123456789abcdef");
  while (input.size() >= 9) {
    const auto half = [&](std::size_t at) {
      return static_cast<std::uint16_t>(input[at] | static_cast<unsigned>(input[at + 1]) << 8U);
    };
    const Setup setup{input[0], input[1], half(2), half(4), half(6)};
    const Speed speed = (input[8] & 1U) != 0 ? Speed::high : Speed::full;
    if ((input[8] & 2U) != 0) control.on_reset();
    input = input.subspan(9);
    const Response response = control.on_setup(setup, speed);
    if (response.kind == Response::Kind::send) {
      require(response.data.size() <= setup.length, "no more is sent than was asked for");
      std::uint8_t sum = 0;
      for (const std::uint8_t byte : response.data) sum = static_cast<std::uint8_t>(sum + byte);
      static_cast<void>(sum);  // every byte has been read: the sanitizer has seen that it may be
    }
    if (response.kind == Response::Kind::receive) {
      const std::size_t size = std::min<std::size_t>(response.length, input.size());
      control.on_data(input.first(size));
      input = input.subspan(size);
    }
    require(control.address() < 128, "an address has 7 bits");
    control.take_changes();
  }
}

std::vector<Bytes> seeds() {
  const Bytes start{0x00, 5, 7, 0, 0, 0, 0, 0, 1, 0x00, 9, 1, 0, 0, 0, 0, 0, 1};
  std::vector<Bytes> all{start};
  for (const std::uint8_t kind : {1, 2, 3, 6, 7}) {
    all.push_back(start);
    for (const std::uint8_t byte :
         {std::uint8_t{0x80}, std::uint8_t{6}, std::uint8_t{0}, kind, std::uint8_t{9}, std::uint8_t{4},
          std::uint8_t{255}, std::uint8_t{0}, std::uint8_t{1}})
      all.back().push_back(byte);
  }
  const Bytes coding{0x21, 0x20, 0, 0, 0, 0, 7, 0, 1, 134, 0, 0, 0, 0, 0, 8, 0x21, 0x22, 3, 0, 0, 0, 0, 0, 1};
  all.push_back(start);
  all.back().insert(all.back().end(), coding.begin(), coding.end());
  return all;
}

}  // namespace astro::fuzz
