#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/interface/board.hpp"

/// What the contract suite needs of a bench on which a board is tested: the far ends of its wires.
namespace astro::contract {

enum class Bridge : std::uint8_t { coast, brake, drive };

template <class T>
concept Rig = std::default_initializable<T> &&
    requires(T& rig, int port, std::span<const std::uint8_t> bytes, hal::EncoderCounts counts, bool fault) {
  requires hal::Board<std::remove_reference_t<decltype(rig.board())>>;
  rig.pass_ms(1);                                        // time goes by
  rig.set_counts(counts);                                // both decoders' registers
  rig.turn(counts);                                      // both shafts turn by so many counts
  { rig.bridge() } -> std::same_as<Bridge>;              // what the motors feel
  { rig.duty() } -> std::same_as<hal::Duty>;             // of the last drive
  rig.set_driver_fault(fault);                           // the driver chip's output
  { rig.host_send(port, bytes) } -> std::same_as<bool>;  // all of them
  { rig.host_receive(port) } -> std::same_as<std::vector<std::uint8_t>>;  // everything that waits
  { rig.other_id() } -> std::same_as<std::array<std::uint8_t, 16>>;       // of another robot of the same kind
  { rig.restarted_id() } -> std::same_as<std::array<std::uint8_t, 16>>;   // of this robot, started again
};

}  // namespace astro::contract
