#pragma once

#include <array>
#include <cstdint>

#include "host/emulator/chip/iomuxc.hpp"

namespace astro::emulator {

/// The crossbar: which of its inputs feeds which of its outputs.
class Xbara : public Stored {
 public:
  std::uint32_t input_of(std::uint32_t output) const {
    return value(output & ~1U) >> (output % 2 * 8) & 0x7F;
  }
};

/// What a decoder cannot do. The first value is its number, the second one the register or its offset.
enum class DecoderProblem { read_not_modelled, write_not_modelled, modulo_not_modelled, filter_running };

/// One quadrature decoder. Counts all four edges of the two phases that the crossbar brings to it.
///
/// Not modelled  differences, revolutions, counting modulo, the input filter's effect.
class Enc : public Model {
 public:
  Enc(Machine& machine, int number) : machine_(machine), number_(number) {}

  std::uint32_t read(std::uint32_t offset) override;
  void write(std::uint32_t offset, std::uint32_t value) override;
  void reset() override;

  /// Counts edges; positive if A comes before B.
  void count(std::int32_t edges);
  /// Sets the position; used by scripts that replay counts.
  void preset(std::int32_t position) { position_ = static_cast<std::uint32_t>(position); }
  std::int32_t position() const { return static_cast<std::int32_t>(position_); }
  /// The delay of the input filter, in clocks of the bus; 0: it is bypassed.
  std::uint32_t filter_clocks() const;

 private:
  Machine& machine_;
  int number_;
  std::uint32_t position_ = 0, held_ = 0;
  std::uint16_t control_ = 0, control2_ = 0, filter_ = 0, compare_upper_ = 0xFFFF, compare_lower_ = 0xFFFF;
  std::uint32_t initial_ = 0;
};

/// The wires from pins 2 to 5 through pads and crossbar to both decoders.
class EncoderWires {
 public:
  EncoderWires(const Iomuxc& iomuxc, const IomuxcGpr& gpr, const Xbara& xbara, Enc& left, Enc& right)
      : iomuxc_(iomuxc), gpr_(gpr), xbara_(xbara), decoders_{&left, &right} {}

  /// Edges of the left (0) or right (1) encoder; lost if a wire does not reach its decoder.
  void count(std::size_t side, std::int32_t edges) {
    if (edges != 0 && connected(side)) decoders_[side]->count(edges);
  }
  bool connected(std::size_t side) const;

 private:
  const Iomuxc& iomuxc_;
  const IomuxcGpr& gpr_;
  const Xbara& xbara_;
  std::array<Enc*, 2> decoders_;
};

}  // namespace astro::emulator
