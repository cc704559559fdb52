#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "host/emulator/core/machine.hpp"
#include "host/emulator/robot/teensy.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::emulator {

using namespace std::chrono_literals;

/// The same lines copied to ITCM and run there, for tests that must not depend on the flash.
std::string in_ram(const std::string& code);

/// A few lines of assembler as the whole image of a Teensy: they follow the label main, in flash, with
/// FlexRAM, stack and vector table set up, and run when the test lets time pass. The boot ROM leaves a clean
/// state.
///
///   register names    INSTANCE_REGISTER, as PIT_MCR
///   set REG, value    a 32-bit write; set16 a 16-bit one
///   get REG           a 32-bit read into r0; get16 a 16-bit one
///   until REG, mask, value   waits until the bits of the mask have the value
///   pause n           n microseconds at 600 MHz, which is how fast time passes here whatever the clocks say
///   keep n            stores r0 as result(n)
///   count n           adds one to result(n)
///   handler n         begins the handler of exception n; those without one count as an unexpected exception
///   stay              an endless loop
class Program {
 public:
  explicit Program(const std::string& code);

  Teensy& teensy() { return *teensy_; }
  /// Word n of the program's results.
  std::uint32_t result(std::uint32_t n) { return teensy_->word_at(Memory::kDtcm + 4 * n); }
  /// What ended the run; no sentence if nothing did.
  Remark fault(std::chrono::nanoseconds limit = 1ms);
  /// The same as a sentence: "" if nothing did.
  std::string stopped_by(std::chrono::nanoseconds limit = 1ms) { return fault(limit).sentence; }
  /// Where the image was built.
  std::filesystem::path hex() const { return folder_.path() / "program.hex"; }

 private:
  test::TemporaryFolder folder_;
  std::unique_ptr<Teensy> teensy_;
};

}  // namespace astro::emulator
