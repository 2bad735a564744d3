"""The filter of system calls of a student's process, line for line as the kernel runs it."""

import importlib
import struct
import sys
from collections.abc import Iterator
from types import ModuleType

import pytest

from tests.exercise import kernel
from workbench.exercise.sandbox import python

MACHINES = ("x86_64", "aarch64")


@pytest.fixture(scope="module")
def syscalls() -> Iterator[ModuleType]:
    with pytest.MonkeyPatch.context() as patched:
        patched.syspath_prepend(str(python.CHILD_FILES))
        yield importlib.import_module("syscalls")
        sys.modules.pop("syscalls")


def answered(program: bytes, architecture: int, number: int, *, words: tuple[int, ...] = ()) -> int:
    """Return what a filter says of a call.

    Source: Linux, Documentation/userspace-api/seccomp_filter.rst; struct seccomp_data,
    include/uapi/linux/seccomp.h.
    """
    asked = struct.pack(
        "<IIQ12I", number & 0xFFFFFFFF, architecture, 0, *words, *[0] * (12 - len(words))
    )
    lines = list(struct.iter_unpack("=HBBI", program))
    at = held = 0
    while True:
        opcode, yes, no, k = lines[at]
        at += 1
        if opcode == 0x06:
            return k
        if opcode == 0x20:
            (held,) = struct.unpack_from("<I", asked, k)
        elif opcode == 0x54:
            held &= k
        else:
            at += yes if {0x15: held == k, 0x35: held >= k}[opcode] else no


ALLOWED = 0x7FFF0000


@pytest.mark.parametrize("writes", [True, False])
@pytest.mark.parametrize("machine", MACHINES)
def test_what_is_on_the_list_is_allowed_and_nothing_else(syscalls, machine, writes):
    column, architecture = syscalls.MACHINES[machine]
    program = syscalls.program(machine, writes=writes)
    free = syscalls.MAY | (syscalls.OPEN | syscalls.CHANGE if writes else {})
    numbers = {n[column] for n in free.values()}
    assert len(numbers - {None}) == len([n for n in free.values() if n[column] is not None])
    bound = {n[column] for n, _ in syscalls.MAY_IF.values()} | {
        n[column] for n in syscalls.OPEN.values()
    }
    hostile = (0xDEADBEEF,) * 12
    for number in [*range(1000), 0x40000000, 0x40000001, 0xFFFFFFFF]:
        assert (answered(program, architecture, number, words=hostile) == ALLOWED) == (
            number in numbers
        )
        assert answered(program, 0x40000003, number) != ALLOWED  # the machine's older half, 32 bits
        if number not in numbers | bound:
            assert answered(program, architecture, number) == (
                0x50000 | (38 if number >= 424 else 1)
            )


CASES = [  # a call, its arguments, whether it is allowed
    *(("fcntl", (3, command), True) for command in (0, 1, 2, 3, 1030)),
    ("fcntl", (3, 4, 0x800), True),
    ("fcntl", (3, 4, 0x2800), False),
    *(("fcntl", (3, command), False) for command in (5, 6, 7, 8, 9, 10, 11, 15, 16, 36, 37, 38)),
    *(("fcntl", (3, command), False) for command in (1024, 1025, 1026, 1031, 1033, 1036, 1039)),
    # the kernel looks at 32 bits too
    ("fcntl", (3, 1024 + 2**40), False),
    ("fcntl", (3, 3 + 2**40), True),
    # TCGETS, TCGETS2, TIOCGWINSZ, FIONCLEX, FIOCLEX, FIONBIO
    *(
        ("ioctl", (0, command), True)
        for command in (0x5401, 0x802C542A, 0x5413, 0x5450, 0x5451, 0x5421)
    ),
    ("ioctl", (0, 0x8901), False),
    ("ioctl", (0, 0x8902), False),
    ("ioctl", (0, 0x5452), False),
    ("ioctl", (0, 0x5412), False),
    ("ioctl", (0, 0x40086602), False),
    ("clone", (0x3D0F00,), True),
    ("clone", (0x7D0F00,), True),
    ("clone", (17,), False),
    ("clone", (0x1200011,), False),
    ("clone", (0x3D0F00 | 0x10000000,), False),
    ("clone", (0x3D0F11,), False),
    ("clone", (0x3D0F00 & ~0x10000,), False),
    *(("futex", (8, command | 128), True) for command in (0, 1, 3, 4, 5, 9, 10)),
    ("futex", (8, 129 | 256), True),
    ("futex", (8, 6), False),
    ("futex", (8, 6 | 128), False),
    ("futex", (8, 13), False),
    ("futex", (8, 11), False),
    *(("madvise", (0, 9, advice), True) for advice in (4, 8, 14, 15, 102, 103)),
    ("madvise", (0, 9, 21), False),
    ("madvise", (0, 9, 12), False),
    ("mbind", (0, 9, 1, 0, 0, 0), True),
    ("mbind", (0, 9, 1, 0, 0, 4), False),
    *(("membarrier", (command,), True) for command in (0, 8, 16)),
    ("membarrier", (1,), False),
    ("prlimit64", (0, 7, 0, 4096), True),
    ("prlimit64", (0, 7, 4096, 0), False),
    ("prlimit64", (0, 7, 2**32, 0), False),
    ("prlimit64", (9, 7, 0, 4096), False),
]


@pytest.mark.parametrize("machine", MACHINES)
@pytest.mark.parametrize(("name", "arguments", "may"), CASES)
def test_arguments_are_looked_at(syscalls, machine, name, *, arguments, may):
    column, architecture = syscalls.MACHINES[machine]
    program = syscalls.program(machine, writes=True)
    words = tuple(half for value in arguments for half in (value & 0xFFFFFFFF, value >> 32))
    number = syscalls.MAY_IF[name][0][column]
    assert answered(program, architecture, number, words=words) == (ALLOWED if may else 0x50001)


@pytest.mark.parametrize("machine", MACHINES)
def test_where_it_has_no_folder_it_opens_to_read_alone(syscalls, machine):
    column, architecture = syscalls.MACHINES[machine]
    number = syscalls.OPEN["openat"][column]
    for writes in (True, False):
        program = syscalls.program(machine, writes=writes)
        for flags, changing in (
            (0, 0),
            (0x80000, 0),
            (1, 1),
            (2, 1),
            (3, 1),
            (0x40, 1),
            (0x200, 1),
            (0x410002, 1),
        ):
            got = answered(program, architecture, number, words=(0, 0, 0, 0, flags, 0))
            assert (got == ALLOWED) == (writes or not changing)


@pytest.mark.parametrize("machine", MACHINES)
def test_the_numbers_are_the_kernel_s(syscalls, machine):
    known = kernel.numbers(machine)
    column = syscalls.MACHINES[machine][0]
    ours = (
        syscalls.MAY
        | syscalls.OPEN
        | syscalls.CHANGE
        | {name: n for name, (n, _) in syscalls.MAY_IF.items()}
    )
    for name, numbers in ours.items():
        assert known.get(name) == (None if numbers[column] is None else str(numbers[column])), name


def test_a_machine_is_the_one_that_the_kernel_names(syscalls):
    """Source: Linux, include/uapi/linux/audit.h, elf-em.h: 64 bits, little end first, and EM_."""
    known = {"x86_64": 62, "aarch64": 183}
    numbers = {machine: number for machine, (_, number) in syscalls.MACHINES.items()}
    assert numbers == {machine: 0xC0000000 | number for machine, number in known.items()}
