#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>

#include "host/emulator/core/machine.hpp"

namespace astro::emulator {

/// What is wrong with an access. The values are the register's name or address, and "read" or "write". Then
/// follow for wrong_width the bytes of the access, for clock_off the gate: "1", "6" for CCGR1 CG6.
enum class AccessProblem { not_modelled, wrong_width, clock_off };

/// Passes each access to the model of its address, and ends the run at accesses that fail on the chip: no
/// register at the address, the wrong width, a clock that is switched off.
class Bus {
 public:
  static constexpr std::uint32_t kPage = 0x1000;

  explicit Bus(Machine& machine) : machine_(machine) {}

  /// `model` answers for `bytes` from `base`. No gate: its clock cannot be switched off.
  void map(Model& model, std::uint32_t base, std::uint32_t bytes, std::optional<Gate> gate = {});

  std::uint32_t read(std::uint32_t address, int bytes);
  void write(std::uint32_t address, std::uint32_t value, int bytes);

 private:
  struct Slot {
    Model* model;
    std::uint32_t base;
    std::optional<Gate> gate;
  };

  const Slot* legal(std::uint32_t address, int bytes, const char* verb);

  Machine& machine_;
  std::unordered_map<std::uint32_t, Slot> slots_;  // by page
};

}  // namespace astro::emulator
