#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "host/emulator/core/machine.hpp"

namespace astro::emulator {

/// What is wrong with a region of the MPU.
enum class RegionProblem { too_small, misaligned, subregions, small_with_access, mpu_on };

/// The MPU as the firmware has set it (ARMv7-M PMSA, privileged accesses).
///
/// Not modelled  subregions; HFNMIENA: the regions also hold in the handlers of NMI and HardFault, which on
///               the chip run without them.
class Protection {
 public:
  struct Access {
    bool read = true, write = true, execute = true, cached = false;
    friend bool operator==(const Access&, const Access&) = default;
  };
  struct Region {
    std::uint32_t base = 0, attributes = 0;  // RBAR, RASR
    std::uint64_t bytes() const;
  };
  struct Span {
    std::uint32_t base, bytes;
  };
  /// Granularity of the engine's access rights; smaller regions are in `traps()`.
  static constexpr std::uint32_t kPage = 1024;

  Protection(Machine& machine, std::function<void()> changed)
      : machine_(machine), changed_(std::move(changed)) {}
  void reset();
  /// As a boot ROM may leave it: on, with regions that the next program must remove.
  void leave_rom_state();

  std::uint32_t read(std::uint32_t offset) const;
  void write(std::uint32_t offset, std::uint32_t value);

  bool on() const { return on_; }
  const Region& region(std::size_t number) const { return regions_[number]; }
  /// What the processor may do at an address. Outside of all regions it may do everything while the MPU is
  /// off or PRIVDEFENA is set, else nothing.
  Access at(std::uint32_t address) const { return at(address, 0); }
  /// The same for a whole page, ignoring regions that are smaller.
  Access page(std::uint32_t address) const { return at(address, kPage); }
  /// Regions smaller than a page that allow no access: a null pointer, the end of a stack.
  std::vector<Span> traps() const;
  /// Where the regions of a page or more begin and end.
  std::vector<std::uint64_t> edges() const;

 private:
  Access at(std::uint32_t address, std::uint64_t smallest) const;
  void set_attributes(std::uint32_t value);

  Machine& machine_;
  std::function<void()> changed_;
  std::array<Region, 16> regions_{};
  std::size_t selected_ = 0;
  bool on_ = false, background_ = false;
};

}  // namespace astro::emulator
