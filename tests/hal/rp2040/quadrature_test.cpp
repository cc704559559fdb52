#include "hal/rp2040/arithmetic/quadrature.hpp"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <random>
#include <stdexcept>

namespace astro::rp2040 {
namespace {

/// A state machine of the PIO as the data sheet describes it (3.4), as far as the program needs one: written from there, not
/// from the encoder of instructions under test. An instruction that is not described here throws.
class Machine {
 public:
  void step(std::uint32_t pins) {
    const std::uint32_t instruction = kQuadrature.code.at(pc_);
    std::optional<std::uint32_t> next;
    if ((instruction >> 8 & 31) != 0) throw std::runtime_error("a delay or a side-set");
    const std::uint32_t low = instruction & 31, middle = instruction >> 5 & 7;
    switch (instruction >> 13) {
      case 0: {  // JMP
        if (middle == 0)
          next = low;
        else if (middle == 2) {
          if (x != 0) next = low;
          --x;
        } else
          throw std::runtime_error("a condition that is not used");
        break;
      }
      case 2:  // IN
        if (low == 0 || low > 31) throw std::runtime_error("a width that is not used");
        isr_ = isr_ << low | (source(middle, pins) & ((1U << low) - 1));
        break;
      case 4:  // PUSH, without blocking
        if (instruction != 0x8000) throw std::runtime_error("another push or a pull");
        published = isr_;
        isr_ = 0;
        break;
      case 5: {  // MOV
        std::uint32_t value = source(instruction & 7, pins);
        if ((instruction >> 3 & 3) == 1) value = ~value;
        if (middle == 1)
          x = value;
        else if (middle == 2)
          y_ = value;
        else if (middle == 5)
          next = value & 31;
        else if (middle == 6)
          isr_ = value;
        else
          throw std::runtime_error("a destination that is not used");
        break;
      }
      default:
        throw std::runtime_error("an instruction that is not used");
    }
    pc_ = next ? *next : pc_ == QuadratureProgram::kWrapTop ? QuadratureProgram::kWrapBottom : pc_ + 1;
  }
  /// Until it stands at the beginning of a round again; the number of steps.
  int round(std::uint32_t pins) {
    int steps = 0;
    do {
      step(pins);
      ++steps;
    } while (pc_ != QuadratureProgram::kRound && steps < 100);
    return steps;
  }

  std::uint32_t x = 0, published = 0;

 private:
  std::uint32_t source(std::uint32_t code, std::uint32_t pins) const {
    switch (code) {
      case 0:
        return pins;
      case 1:
        return x;
      case 2:
        return y_;
      case 6:
        return isr_;
      default:
        throw std::runtime_error("a source that is not used");
    }
  }
  std::uint32_t pc_ = QuadratureProgram::kRound, isr_ = 0, y_ = 0;
};

/// Levels of BA at a position, A leading.
constexpr std::uint32_t levels(std::int64_t position) {
  constexpr std::array<std::uint32_t, 4> kLevels{0b00, 0b01, 0b11, 0b10};
  return kLevels[static_cast<std::size_t>(position & 3)];
}

TEST(Quadrature, CountsEveryEdgeOfAShaftThatTurnsBackAndForth) {
  constexpr unsigned kSeed = 71;
  std::mt19937 random(kSeed);
  Machine machine;
  std::int64_t position = 0;
  for (int edge = 0; edge < 100'000; ++edge) {
    position += edge % 1000 < 700 ? 1 : random() % 2 == 0 ? 1 : -1;
    machine.round(levels(position) | static_cast<std::uint32_t>(random())
                                         << 2);  // other pins stand beside them
    machine.round(levels(position));
    ASSERT_EQ(static_cast<std::int32_t>(machine.published), position)
        << "seed " << kSeed << ", edge " << edge;
  }
}

TEST(Quadrature, WrapsAtBothEndsOfTheWord) {
  for (const int direction : {1, -1}) {
    Machine machine;
    machine.x = direction > 0 ? 0xFFFF'FFFE : 1;
    const std::uint32_t from = machine.x;
    for (int i = 1; i <= 5; ++i) {
      machine.round(levels(direction * i));
      ASSERT_EQ(machine.x, from + static_cast<std::uint32_t>(direction * i));
    }
  }
}

TEST(Quadrature, TwoEdgesAtOnceHaveNoDirectionAndCountNothing) {
  Machine machine;
  machine.round(0b11);
  EXPECT_EQ(machine.x, 0U);
  machine.round(0b00);
  EXPECT_EQ(machine.x, 0U);
  machine.round(0b01);
  EXPECT_EQ(machine.x, 1U) << "and it goes on from the new levels";
}

TEST(Quadrature, PulseOnOneLineCountsUpAndDownAgain) {
  Machine machine;
  machine.round(0b01);
  machine.round(0b00);
  EXPECT_EQ(machine.x, 0U);
}

TEST(Quadrature, RoundTakesTenCyclesAtMost) {
  Machine machine;
  int longest = 0;
  for (int i = 0; i < 8; ++i) longest = std::max(longest, machine.round(levels(i)));
  for (int i = 8; i > 0; --i) longest = std::max(longest, machine.round(levels(i)));
  EXPECT_EQ(longest, 10);
  EXPECT_EQ(machine.round(levels(1)), 7) << "where nothing moves";
}

}  // namespace
}  // namespace astro::rp2040
