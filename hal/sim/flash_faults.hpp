#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace astro::sim {

/// What a power cut leaves in the bytes that were not finished.
///   sharp   the old content: work stopped between two bytes
///   byte    a mixture of old and new bits in the byte being written, the old content after it
///   torn    a mixture in every byte that the call had still to do: work was going on in all of them
enum class Tear : std::uint8_t { sharp, byte, torn };

enum class FlashWork : std::uint8_t { erase, program };

/// THE model of faults in NOR flash, for every simulated flash: the owner keeps the cells and passes on each
/// erase and program call; the faults decide what the cells become.
///
///   power cut        after any byte of any call; from then on nothing changes until restore_power()
///   stuck bits       cells that hold their level whatever is erased or programmed
///   failing sector   a range in which erasing or programming has no effect
///
/// Bit rot needs no support here: the owner flips a bit between two calls.
///
/// Deterministic: torn bits are a hash of seed, place of the cut and address. Work without effect counts in
/// bytes_worked like any other.
class FlashFaults {
 public:
  /// The power fails after `bytes` more bytes have been erased or programmed, within the call that reaches
  /// them.
  void cut_power_after(std::uint64_t bytes, Tear tear = Tear::sharp, std::uint64_t seed = 0);
  void restore_power();
  bool powered() const { return powered_; }

  /// Bytes erased or programmed so far; the range of interesting arguments for cut_power_after.
  std::uint64_t bytes_worked() const { return worked_; }

  /// The cells of `mask` in the byte at `at` are stuck at `level` from now on.
  void stick(std::uint32_t at, std::uint8_t mask, bool level) { stuck_.push_back({at, mask, level}); }
  /// Work of this kind has no effect any more on `bytes` bytes from `begin` on.
  void fail(std::uint32_t begin, std::uint32_t bytes, FlashWork kind) {
    failing_.push_back({begin, bytes, kind});
  }

  /// One call's work on `cells`, the first of which has the address `at`.
  void erase(std::uint32_t at, std::span<std::uint8_t> cells);
  void program(std::uint32_t at, std::span<std::uint8_t> cells, std::span<const std::uint8_t> bytes);

  /// The value that a byte reads as if it should be `wanted`.
  std::uint8_t held(std::uint32_t at, std::uint8_t wanted) const;

 private:
  struct Stuck {
    std::uint32_t at;
    std::uint8_t mask;
    bool level;
  };
  struct Failing {
    std::uint32_t begin, bytes;
    FlashWork kind;
  };
  static constexpr std::uint64_t kNever = ~std::uint64_t{0};

  template <class Target>
  void work(FlashWork kind, std::uint32_t at, std::span<std::uint8_t> cells, Target target);
  bool takes(FlashWork kind, std::uint32_t at) const;
  std::uint8_t torn(std::uint32_t at, std::uint8_t old, std::uint8_t target) const;

  std::vector<Stuck> stuck_;
  std::vector<Failing> failing_;
  std::uint64_t worked_ = 0;
  std::uint64_t cut_at_ = kNever;
  std::uint64_t mixture_ = 0;
  Tear tear_ = Tear::sharp;
  bool powered_ = true;
};

}  // namespace astro::sim
