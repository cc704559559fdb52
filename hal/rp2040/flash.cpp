#include "hal/rp2040/flash.hpp"

#include <algorithm>

#include "hal/rp2040/boot_rom.hpp"
#include "hal/rp2040/core/cpu.hpp"
#include "hal/rp2040/watchdog.hpp"

namespace astro::rp2040 {
namespace {

constexpr std::uint32_t kBase = 0x001F'0000;  // from the start of the flash
constexpr std::uint32_t kPageBytes = 256;
constexpr std::uint32_t kMapped = 0x1000'0000;
static_assert(kBase % Flash::kSectorBytes == 0 && kBase + Flash::kBytes <= 0x0020'0000);
static_assert(kPageBytes % Flash::kProgramBytes == 0);

using Command = void (*)();
using Erase = void (*)(std::uint32_t offset, std::size_t bytes, std::uint32_t block_bytes,
                       std::uint8_t block_command);
using Program = void (*)(std::uint32_t offset, const std::uint8_t* bytes, std::size_t size);

const volatile std::uint8_t* mapped(std::uint32_t offset) {
  return reinterpret_cast<const volatile std::uint8_t*>(std::uintptr_t{kMapped + kBase + offset});
}

/// The flash listens to commands while such an object lives and is mapped again afterwards.
class Commands {
 public:
  Commands() {
    watchdog_timer::feed();
    boot_rom::get<Command>('I', 'F')();
    boot_rom::get<Command>('E', 'X')();
  }
  ~Commands() {
    boot_rom::get<Command>(
        'F', 'C')();  // empties the cache; also ends the chip select that the command before has forced
    boot_rom::get<Command>('C', 'X')();
    watchdog_timer::feed();
  }
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;
};

/// One page, ones around `bytes`.
void program_page(std::uint32_t offset, std::span<const std::uint8_t> bytes) {
  std::array<std::uint8_t, kPageBytes> page;
  page.fill(0xFF);
  const std::uint32_t within = offset % kPageBytes;
  std::copy(bytes.begin(), bytes.end(), page.begin() + within);
  const Commands open;
  boot_rom::get<Program>('R', 'P')(kBase + offset - within, page.data(), page.size());
}

/// Sends `bytes` to the flash and puts what it answers meanwhile in their place. The chip select is forced by the pin's
/// override, because the controller would release it whenever its queue is empty.
void exchange(std::span<std::uint8_t> bytes) {
  constexpr std::uint32_t kLow = 2, kHigh = 3;
  IO_QSPI[io::GPIO_QSPI_SS_CTRL].change(io::GPIO_QSPI_SS_CTRL_OUTOVER, kLow);
  for (std::uint8_t& byte : bytes) {
    XIP_SSI[ssi::DR0].write(byte);
    while (XIP_SSI[ssi::SR].get(ssi::SR_RFNE) == 0) {
    }
    byte = static_cast<std::uint8_t>(XIP_SSI[ssi::DR0].read());
  }
  IO_QSPI[io::GPIO_QSPI_SS_CTRL].change(io::GPIO_QSPI_SS_CTRL_OUTOVER, kHigh);
}

}  // namespace

bool Flash::erase(std::uint32_t sector) noexcept {
  if (sector >= kSectors) return false;
  const std::uint32_t offset = sector * kSectorBytes;
  {
    constexpr std::uint32_t kBlockBytes = 0x1'0000;
    constexpr std::uint8_t kEraseBlock = 0xD8;  // not used for a sector
    const Commands open;
    boot_rom::get<Erase>('R', 'E')(kBase + offset, kSectorBytes, kBlockBytes, kEraseBlock);
  }
  const auto* bytes = mapped(offset);
  return std::all_of(bytes, bytes + kSectorBytes, [](std::uint8_t byte) { return byte == 0xFF; });
}

bool Flash::program(std::uint32_t offset, std::span<const std::uint8_t> bytes) noexcept {
  if (offset >= kBytes || bytes.size() > kSectorBytes - offset % kSectorBytes) return false;
  if (offset % kProgramBytes != 0 || bytes.size() % kProgramBytes != 0) return false;
  for (std::size_t done = 0; done < bytes.size();) {
    const std::uint32_t at = offset + static_cast<std::uint32_t>(done);
    const std::size_t count = std::min<std::size_t>(bytes.size() - done, kPageBytes - at % kPageBytes);
    program_page(at, bytes.subspan(done, count));
    done += count;
  }
  return std::equal(bytes.begin(), bytes.end(), mapped(offset));
}

void Flash::read(std::uint32_t offset, std::span<std::uint8_t> into) noexcept {
  for (std::uint8_t& byte : into) {
    byte = offset < kBytes ? *mapped(offset) : std::uint8_t{0xFF};
    ++offset;
  }
}

std::array<std::uint8_t, 8> Flash::serial_number() noexcept {
  constexpr std::uint8_t kReadUniqueId = 0x4B;
  constexpr std::size_t kBefore = 5;  // the command and four bytes of nothing
  std::array<std::uint8_t, 13> bytes{kReadUniqueId};
  {
    const Commands open;
    exchange(bytes);
  }
  std::array<std::uint8_t, 8> number{};
  std::copy(bytes.begin() + kBefore, bytes.end(), number.begin());
  return number;
}

}  // namespace astro::rp2040
