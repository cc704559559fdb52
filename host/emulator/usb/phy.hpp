#pragma once

#include <cstdint>

#include "host/emulator/chip/stored.hpp"

namespace astro::emulator {

/// The transceiver USBPHY1: registers with copies that set and clear.
class UsbPhy : public Stored {
 public:
  UsbPhy();
  std::uint32_t read(std::uint32_t offset) override { return value(offset & ~0xFU); }
  void write(std::uint32_t offset, std::uint32_t value) override;
  bool ready() const;
};

}  // namespace astro::emulator
