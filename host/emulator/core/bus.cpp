#include "host/emulator/core/bus.hpp"

#include <fmt/format.h>

#include "host/emulator/core/register_names.hpp"

namespace astro::emulator {

void Bus::map(Model& model, std::uint32_t base, std::uint32_t bytes, std::optional<Gate> gate) {
  for (std::uint32_t at = base / kPage; at <= (base + bytes - 1) / kPage; ++at)
    slots_[at] = {&model, base, gate};
}

const Bus::Slot* Bus::legal(std::uint32_t address, int bytes, const char* verb) {
  const RegisterName* known = find_register(address);
  const auto slot = slots_.find(address / kPage);
  if (known == nullptr || slot == slots_.end()) {
    machine_.fail({fmt::format("{}: {} of a register that is not modelled", name_of(address), verb),
                   AccessProblem::not_modelled,
                   {name_of(address), verb}});
    return nullptr;
  }
  if (known->bytes != bytes) {
    machine_.fail(
        {fmt::format("{}: {} of {} bytes, the register has {}", known->name, verb, bytes, known->bytes),
         AccessProblem::wrong_width,
         {known->name, verb, std::to_string(bytes)}});
    return nullptr;
  }
  const std::optional<Gate>& gate = slot->second.gate;
  if (gate && !machine_.clocked(*gate)) {
    machine_.fail({fmt::format("{}: {} while its clock is off (CCM CCGR{} CG{})", known->name, verb,
                               gate->reg, gate->index),
                   AccessProblem::clock_off,
                   {known->name, verb, std::to_string(gate->reg), std::to_string(gate->index)}});
    return nullptr;
  }
  return &slot->second;
}

std::uint32_t Bus::read(std::uint32_t address, int bytes) {
  const Slot* slot = legal(address, bytes, "read");
  return slot == nullptr ? 0 : slot->model->read(address - slot->base);
}

void Bus::write(std::uint32_t address, std::uint32_t value, int bytes) {
  if (const Slot* slot = legal(address, bytes, "write")) slot->model->write(address - slot->base, value);
}

}  // namespace astro::emulator
