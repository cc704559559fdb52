#pragma once

#include <cstdint>
#include <unordered_map>

#include "host/emulator/core/machine.hpp"

namespace astro::emulator {

/// Registers that only store what was written to them, with their reset values. Models in which some
/// registers do more derive from it.
class Stored : public Model {
 public:
  explicit Stored(std::unordered_map<std::uint32_t, std::uint32_t> reset_values = {})
      : reset_values_(std::move(reset_values)), values_(reset_values_) {}

  std::uint32_t read(std::uint32_t offset) override { return value(offset); }
  void write(std::uint32_t offset, std::uint32_t value) override { values_[offset] = value; }
  void reset() override { values_ = reset_values_; }

  std::uint32_t value(std::uint32_t offset) const {
    const auto found = values_.find(offset);
    return found == values_.end() ? 0 : found->second;
  }

 protected:
  void store(std::uint32_t offset, std::uint32_t value) { values_[offset] = value; }

 private:
  std::unordered_map<std::uint32_t, std::uint32_t> reset_values_, values_;
};

}  // namespace astro::emulator
