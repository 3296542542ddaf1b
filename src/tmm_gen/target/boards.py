"""Microcontrollers as data: cross compiler, emulated board, and how instructions are counted there.

All are Debian's packages. QEMU's ``-icount`` lets the emulated clock advance by ``2**shift`` ns with every instruction,
so that a timer of the board counts instructions: exactly, and the same in every run. They are instructions, not cycles.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Board:
    """A microcontroller that ``tmm-gen check --target`` knows.

    Parameters
    ----------
    name : str
        As the command line says it.
    title : str
        For people.
    prefix, package : str
        Of the cross compiler's programs ("arm-none-eabi-"), and the package that holds them.
    library : str
        Package of its C library.
    machine : tuple of str
        Compiler options that choose processor and floating-point unit.
    optimisation : str
        Compiler option that makes kernels fast there; on small cores that is the one for size.
    link : tuple of str
        Linker options.
    emulator, emulator_package : str
        Program, and the package that holds it.
    emulate : tuple of str
        Options of the emulator, without the program to run.
    counter : str
        Name of the counter in the harness: "systick" or "instret".
    ticks_per_instruction : float
        By which that counter advances.
    hardware_reals : tuple of str
        Number types its floating-point unit has; others are computed in software.
    """

    name: str
    title: str
    prefix: str
    package: str
    library: str
    machine: tuple[str, ...]
    optimisation: str
    link: tuple[str, ...]
    emulator: str
    emulator_package: str
    emulate: tuple[str, ...]
    counter: str
    ticks_per_instruction: float
    hardware_reals: tuple[str, ...]


_SEMIHOSTING = (
    *("-display", "none", "-monitor", "none", "-serial", "none", "-chardev", "stdio,id=s0"),
    *("-semihosting-config", "enable=on,target=native,chardev=s0"),
)


def _memory(flash: str, ram: str) -> tuple[str, ...]:
    """Return linker options for picolibc: semihosting, and start-up code that ends the emulator after main."""
    places = {"__flash": flash, "__flash_size": "4M", "__ram": ram, "__ram_size": "4M"}
    return (
        *("--specs=picolibc.specs", "--oslib=semihost", "--crt0=hosted"),
        *(f"-Wl,--defsym={symbol}={value}" for symbol, value in places.items()),
    )


def _cortex_m(
    name: str, title: str, cpu: str, fpu: str, optimisation: str, board: str, reals: tuple[str, ...]
) -> Board:
    return Board(
        name=name,
        title=title,
        prefix="arm-none-eabi-",
        package="gcc-arm-none-eabi",
        library="picolibc-arm-none-eabi",
        machine=(f"-mcpu={cpu}", "-mthumb", f"-mfpu={fpu}", "-mfloat-abi=hard"),
        optimisation=optimisation,
        link=_memory("0", "0x20000000"),
        emulator="qemu-system-arm",
        emulator_package="qemu-system-arm",
        # SysTick runs at 25 MHz, 40 ns a tick; an instruction takes 2**8 ns.
        emulate=("-M", board, *_SEMIHOSTING, "-icount", "shift=8"),
        counter="systick",
        ticks_per_instruction=256.0 / 40.0,
        hardware_reals=reals,
    )


_ALL = (
    _cortex_m("cortex-m4f", "Cortex-M4F", "cortex-m4", "fpv4-sp-d16", "-Os", "mps2-an386", ("float32",)),
    _cortex_m("cortex-m7", "Cortex-M7", "cortex-m7", "fpv5-d16", "-O2", "mps2-an500", ("float32", "float64")),
    Board(
        name="rv32imafdc",
        title="RISC-V RV32IMAFDC",
        prefix="riscv64-unknown-elf-",
        package="gcc-riscv64-unknown-elf",
        library="picolibc-riscv64-unknown-elf",
        machine=("-march=rv32imafdc", "-mabi=ilp32d", "-mcmodel=medany"),
        optimisation="-O2",
        link=_memory("0x80000000", "0x80400000"),
        emulator="qemu-system-riscv32",
        emulator_package="qemu-system-misc",
        emulate=("-M", "virt", "-bios", "none", *_SEMIHOSTING, "-icount", "shift=0"),
        counter="instret",
        ticks_per_instruction=1.0,
        hardware_reals=("float32", "float64"),
    ),
)

BOARDS: dict[str, Board] = {board.name: board for board in _ALL}
"""By name."""
