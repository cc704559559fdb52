# Debian's bare-metal compiler for the Cortex-M7 of the Teensy 4.0.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR cortex-m7)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_AR arm-none-eabi-gcc-ar)
set(CMAKE_RANLIB arm-none-eabi-gcc-ranlib)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
# Soft float on purpose: a float that slips in becomes a library call, which the image check finds by name.
# -fno-schedule-insns: the first scheduling pass fills the registers with early loads and then spills them; without
# it the control tick is a tenth shorter.
# -fno-jump-tables: a jump through a table of addresses looks like a call through a pointer, which the check of the
# stack could not follow.
set(CMAKE_CXX_FLAGS_INIT "-mcpu=cortex-m7 -mthumb -mfloat-abi=soft -ffreestanding -fno-exceptions -fno-rtti \
-fno-threadsafe-statics -fno-use-cxa-atexit -fno-common -fno-schedule-insns -fno-jump-tables -ffunction-sections \
-fdata-sections -flto=auto -fstack-usage")
