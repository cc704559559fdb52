#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/host/emulator/program.hpp"

namespace astro::emulator {
namespace {

using support::Tells;

constexpr std::uint32_t kUsageFault = 6, kBusFault = 5, kMemManage = 4, kHardFault = 3;

TEST(Exceptions, EntryStacksTheFrameOfTheInterruptedProgram) {
  Program program(R"(
    movs r1, #11
    movs r2, #12
    movs r3, #13
    mov r12, r3
    movs r0, #10
    svc #0
after:
    stay
  handler 11
    mov r8, lr
    mov r9, sp
    ldr r4, =0x20000000
    movs r5, #0
  1: ldr r7, [sp, r5]
    str r7, [r4, r5]
    adds r5, #4
    cmp r5, #32
    bne 1b
    str r8, [r4, #32]
    str r9, [r4, #36]
    mrs r7, ipsr
    str r7, [r4, #40]
    ldr r7, =after
    str r7, [r4, #44]
    bx r8
  )");
  EXPECT_EQ(program.stopped_by(), "");
  for (std::uint32_t n = 0; n < 4; ++n) EXPECT_EQ(program.result(n), 10 + n);
  EXPECT_EQ(program.result(4), 13U) << "r12";
  EXPECT_EQ(program.result(6), program.result(11) & ~1U) << "the instruction behind the call";
  EXPECT_EQ(program.result(7) & 0x0100'01FF, 0x0100'0000U) << "Thumb, thread mode";
  EXPECT_EQ(program.result(8), 0xFFFF'FFF9U);
  EXPECT_EQ(program.result(9), 0x2006'0000U - 32);
  EXPECT_EQ(program.result(10), 11U);
  EXPECT_EQ(program.teensy().chip().cpu().get(UC_ARM_REG_SP), 0x2006'0000U) << "all of it comes back";
  EXPECT_EQ(program.teensy().chip().cpu().get(UC_ARM_REG_R2), 12U);
}

TEST(Exceptions, AStackThatIsNotAMultipleOfEightIsAlignedAndComesBack) {
  Program program(R"(
    sub sp, #4
    svc #0
    mov r0, sp
    keep 1
    stay
  handler 11
    mov r0, sp
    keep 0
    bx lr
  )");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 0x2006'0000U - 40);
  EXPECT_EQ(program.result(1), 0x2006'0000U - 4);
}

// Interrupts 0 and 1 are pended by software; each handler appends its number to a list behind result 1.
constexpr const char* kNote = R"(
  .macro note what
    ldr r6, =0x20000000
    ldr r7, [r6]
    adds r7, #1
    str r7, [r6]
    movs r3, #\what
    str r3, [r6, r7, lsl #2]
  .endm
)";

constexpr const char* kBothNote = R"(
  handler 16
    note 1
    bx lr
  handler 17
    note 2
    bx lr
)";

std::vector<std::uint32_t> noted(Program& program) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t n = 1; n <= program.result(0); ++n) numbers.push_back(program.result(n));
  return numbers;
}

TEST(Exceptions, AnUrgentInterruptNestsInALessUrgentOneAndNotTheOtherWayRound) {
  Program program(std::string(kNote) + R"(
    set 0xE000E400, 0x00004080   // 0: 0x80, 1: 0x40
    set NVIC_ISER0, 3
    set NVIC_ISPR0, 1
    isb
    note 9
    stay
  handler 16
    note 1
    set NVIC_ISPR0, 2            // more urgent: at once
    isb
    note 2
    bx lr
  handler 17
    note 3
    set NVIC_ISPR0, 1            // less urgent: afterwards
    isb
    note 4
    ldr r7, =0x2000003C
    str lr, [r7]
    set NVIC_ICPR0, 1
    bx lr
  )");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_THAT(noted(program), testing::ElementsAre(1, 3, 4, 2, 9));
  EXPECT_EQ(program.result(15), 0xFFFF'FFF1U) << "back to a handler";
}

TEST(Exceptions, EqualPrioritiesGoByNumberAndChainWithoutTheProgramInBetween) {
  Program program(std::string(kNote) + R"(
    set NVIC_ISER0, 3
    cpsid i
    set NVIC_ISPR0, 3
    isb
    cpsie i
    note 9
    stay
  )" + kBothNote);
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_THAT(noted(program), testing::ElementsAre(1, 2, 9));
}

TEST(Exceptions, OnlyTheUpperFourBitsOfAPriorityExist) {
  Program program("set 0xE000E400, 0xFFFFFFFF\n get 0xE000E400\n keep 0");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 0xF0F0'F0F0U);
}

TEST(Exceptions, BasepriHoldsBackItsOwnLevelAndBelow) {
  Program program(std::string(kNote) + R"(
    set 0xE000E400, 0x00004080
    set NVIC_ISER0, 3
    movs r0, #0x80
    msr basepri, r0
    set NVIC_ISPR0, 1
    isb
    note 7
    set NVIC_ISPR0, 2
    isb
    note 8
    movs r0, #0
    msr basepri, r0
    note 9
    stay
  )" + kBothNote);
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_THAT(noted(program), testing::ElementsAre(7, 2, 8, 1, 9));
}

TEST(Exceptions, PendSvRunsWhenTheInterruptsAreDone) {
  Program program(std::string(kNote) + R"(
    set SCB_SHPR3, 0x00F00000
    set NVIC_ISER0, 1
    set NVIC_ISPR0, 1
    isb
    note 9
    stay
  handler 16
    set SCB_ICSR, 0x10000000
    isb
    note 1
    bx lr
  handler 14
    note 2
    bx lr
  )");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_THAT(noted(program), testing::ElementsAre(1, 2, 9));
}

TEST(Exceptions, ALineThatFallsAgainLeavesTheInterruptPending) {
  Program program(std::string(kNote) + R"(
    set CCM_CCGR1, 0xFFFFFFFF
    set PIT_MCR, 0
    cpsid i
    set NVIC_ISER0 + 12, 0x04000000   // 122
    set CCM_CSCMR1, 0x04900040        // 24 MHz
    set PIT_CHANNEL2_LDVAL, 23
    set PIT_CHANNEL2_TCTRL, 3
  1: get PIT_CHANNEL2_TFLG
    cmp r0, #0
    beq 1b
    set PIT_CHANNEL2_TCTRL, 0
    set PIT_CHANNEL2_TFLG, 1
    note 8
    cpsie i
    note 9
    stay
  handler 138
    note 1
    bx lr
  )");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_THAT(noted(program), testing::ElementsAre(8, 1, 9));
}

/// Keeps which exception was entered, CFSR, HFSR, the two addresses and the stacked program counter.
std::string with_fault_handlers(const std::string& code) {
  std::string text = "  set SCB_SHCSR, 0x00070000\n" + code + "\n stay\n";
  for (const std::uint32_t n : {kHardFault, kMemManage, kBusFault, kUsageFault})
    text += "  handler " + std::to_string(n) + "\n";
  return text + R"(
    mrs r0, ipsr
    keep 0
    get SCB_CFSR
    keep 1
    get SCB_HFSR
    keep 2
    get SCB_MMFAR
    keep 3
    get SCB_BFAR
    keep 4
    ldr r0, [sp, #24]
    keep 5
    ldr r0, =culprit
    keep 6
    stay
  )";
}

TEST(Faults, AnUndefinedInstructionIsAUsageFaultAtItsPlace) {
  Program program(with_fault_handlers("culprit: udf #0"));
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), kUsageFault);
  EXPECT_EQ(program.result(1), 1U << 16) << "UNDEFINSTR";
  EXPECT_EQ(program.result(5), program.result(6));
}

TEST(Faults, AJumpOutOfThumbIsAnInvalidState) {
  Program program(
      with_fault_handlers("ldr r0, =culprit\n bx r0\n .align 2\n .type culprit, %object\nculprit: nop"));
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), kUsageFault);
  EXPECT_EQ(program.result(1), 1U << 17) << "INVSTATE";
}

TEST(Faults, WithoutTheMpuAnAccessToNothingIsABusFault) {
  Program program(with_fault_handlers("ldr r0, =0x90000000\nculprit: ldr r1, [r0]"));
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), kBusFault);
  EXPECT_EQ(program.result(1), 0x8200U) << "PRECISERR, BFARVALID";
  EXPECT_EQ(program.result(4), 0x9000'0000U);
  EXPECT_EQ(program.result(5), program.result(6));
}

TEST(Faults, AJumpToNothingIsAnInstructionBusFault) {
  Program program(with_fault_handlers("ldr r0, =0x90000001\nculprit: bx r0"));
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), kBusFault);
  EXPECT_EQ(program.result(1), 0x0100U) << "IBUSERR";
  EXPECT_EQ(program.result(5), 0x9000'0000U);
}

TEST(Faults, AFaultWhoseHandlerIsNotEnabledIsAHardFault) {
  Program program(with_fault_handlers("set SCB_SHCSR, 0\nculprit: udf #0"));
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), kHardFault);
  EXPECT_EQ(program.result(1), 1U << 16);
  EXPECT_EQ(program.result(2), 1U << 30) << "FORCED";
}

TEST(Faults, ACallOfTheSupervisorThatCannotBeTakenIsAHardFault) {
  Program program(with_fault_handlers("cpsid i\nculprit: svc #0"));
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), kHardFault);
  EXPECT_EQ(program.result(2), 1U << 30);
}

TEST(Faults, AFaultInTheHardFaultHandlerLocksTheCoreUpAndRestartsTheChip) {
  Program program(R"(
    get SRC_SRSR
    keep 1
    ldr r6, =SRC_GPR5
    ldr r0, [r6]
    adds r0, #1
    str r0, [r6]
    keep 0
    cmp r0, #2
    beq 1f
    udf #0
  1: stay
  handler 3
    udf #1
  )");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 2U);
  EXPECT_EQ(program.result(1), 3U) << "power-on, and the lock-up's bit";
}

TEST(Faults, AStackThatOverflowsDuringEntryLeavesItsHandlerWithoutAFrame) {
  Program program(R"(
    set SCB_SHCSR, 0x00070000
    ldr r0, =0x20000010
    mov sp, r0
    svc #0
    stay
  handler 5
    ldr r0, =0x20060000
    mov sp, r0
    mrs r0, ipsr
    keep 0
    get SCB_CFSR
    keep 1
    stay
  )");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), kBusFault);
  EXPECT_EQ(program.result(1), 1U << 12) << "STKERR";
}

TEST(Faults, AnExceptionWithoutAHandlerEndsTheRun) {
  Program program("set SCB_VTOR, 0x60000000\n svc #0");
  EXPECT_THAT(program.fault(), Tells(ExceptionProblem::no_handler, "11"));
}

TEST(Faults, TheProcessStackEndsTheRun) {
  Program program("ldr r0, =0x20050000\n msr psp, r0\n movs r0, #2\n msr control, r0\n isb\n svc #0");
  EXPECT_THAT(program.fault(), Tells(ExceptionProblem::process_stack_used));
}

TEST(Faults, WaitingForAnEventEndsTheRun) {
  EXPECT_THAT(Program("wfe").fault(), Tells(ChipProblem::wait_for_event_not_modelled));
}

TEST(Exceptions, AReturnToAStackOrAContextThatNobodyUsesIsRefused) {
  for (const char* value : {"0xFFFFFFFD", "0xFFFFFFED", "0xFFFFFFE9"})
    EXPECT_THAT(Program(std::string("svc #0\n handler 11\n ldr r0, =") + value + "\n bx r0").fault(),
                Tells(ExceptionProblem::context_unused_here, value))
        << value;
}

TEST(Exceptions, AReturnNeedsItsFrame) {
  EXPECT_THAT(Program("svc #0\n handler 11\n ldr r0, =0x30000000\n mov sp, r0\n bx lr").fault(),
              Tells(ExceptionProblem::stack_in_no_memory, "0x30000000"));
}

TEST(Exceptions, WhereRegistersAreNothingIsExecuted) {
  // An EXC_RETURN outside a handler is a branch like any other.
  for (const char* where : {"0xFFFFFFF9", "0xE000E001", "0x40084001"}) {
    Program program(std::string("  ldr r0, =") + where + R"(
    bx r0
  handler 3
    get SCB_CFSR
    keep 0
    get SCB_HFSR
    keep 1
    ldr r0, [sp, #24]
    keep 2
    stay
    )");
    EXPECT_EQ(program.stopped_by(), "") << where;
    EXPECT_EQ(program.result(0), 1U) << "IACCVIOL, " << where;
    EXPECT_EQ(program.result(1), 1U << 30) << "FORCED, " << where;
    EXPECT_EQ(program.result(2) | 1U, std::stoul(where, nullptr, 16)) << "the frame names the place";
  }
}

}  // namespace
}  // namespace astro::emulator
