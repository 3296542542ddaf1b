# Cross-compiling for Cortex-M with GNU Arm Embedded and picolibc:
#
#   cmake -B build -D CMAKE_TOOLCHAIN_FILE=.../arm-none-eabi.cmake
#
# Debian, Ubuntu: apt-get install gcc-arm-none-eabi picolibc-arm-none-eabi qemu-system-arm
#
# For another processor set ARM_MACHINE, for another memory ARM_FLASH, ARM_RAM and their sizes, for another
# board of the emulator ARM_BOARD. What is built runs in the emulator when CTest or a custom target calls it;
# printf goes through semihosting.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_ASM_COMPILER arm-none-eabi-gcc)
set(CMAKE_SIZE arm-none-eabi-size)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY) # nothing can be linked before memory is known

set(ARM_MACHINE "-mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard" CACHE STRING "Processor")
set(ARM_BOARD mps2-an386 CACHE STRING "Board of the emulator")
set(ARM_FLASH 0x0 CACHE STRING "Address of flash")
set(ARM_FLASH_SIZE 4M CACHE STRING "Size of flash")
set(ARM_RAM 0x20000000 CACHE STRING "Address of RAM")
set(ARM_RAM_SIZE 4M CACHE STRING "Size of RAM")
# The emulated clock advances by 2^5 ns with every instruction, and leaps where the processor sleeps: no run
# depends on the speed of the host.
set(ARM_CLOCK "shift=5,sleep=off" CACHE STRING "Clock of the emulator")
# CMake tests the compiler in projects of their own, which are to see the same values
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES
     ARM_MACHINE ARM_BOARD ARM_FLASH ARM_FLASH_SIZE ARM_RAM ARM_RAM_SIZE ARM_CLOCK)

set(CMAKE_C_FLAGS_INIT "${ARM_MACHINE} --specs=picolibc.specs -ffunction-sections -fdata-sections")
set(CMAKE_EXE_LINKER_FLAGS_INIT
    "--oslib=semihost --crt0=hosted -Wl,--gc-sections \
-Wl,--defsym=__flash=${ARM_FLASH} -Wl,--defsym=__flash_size=${ARM_FLASH_SIZE} \
-Wl,--defsym=__ram=${ARM_RAM} -Wl,--defsym=__ram_size=${ARM_RAM_SIZE}")
set(CMAKE_C_STANDARD_LIBRARIES_INIT "-lm")

set(CMAKE_CROSSCOMPILING_EMULATOR
    qemu-system-arm -M ${ARM_BOARD} -display none -monitor none -serial none
    -chardev stdio,id=s0 -semihosting-config enable=on,target=native,chardev=s0
    -icount ${ARM_CLOCK} -kernel)

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
