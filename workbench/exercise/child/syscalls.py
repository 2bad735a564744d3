"""The filter of system calls of a student's process: what it may (seccomp, classic BPF).

The list is what Python, numpy and scipy were seen to use (strace, five of OpenBLAS's kernels), and
their like: memory, threads, clocks, files, and what a process asks about itself. Everything else is
refused, what the kernel does not have yet included. So a function has no other program, no other
process, no socket, no signal, no lease or lock on a file that others read, no owner, no mode, and
none of the kernel's rarer doors. It imports nothing of ours.

Source: Linux, Documentation/userspace-api/seccomp_filter.rst and include/uapi/linux/seccomp.h.
"""

import struct

# of a call on x86_64 and on aarch64; None where there is none
Numbers = tuple[int | None, int | None]
# of each word, these bits are one of these values
Way = tuple[tuple[int, int, tuple[int, ...]], ...]

MAY: dict[str, Numbers] = {
    "brk": (12, 214),
    "mmap": (9, 222),
    "mprotect": (10, 226),
    "munmap": (11, 215),
    "mremap": (25, 216),
    "msync": (26, 227),
    "exit": (60, 93),
    "exit_group": (231, 94),
    "set_robust_list": (273, 99),
    "rseq": (334, 293),
    "sched_yield": (24, 124),
    "sched_getaffinity": (204, 123),
    "getcpu": (309, 168),
    "restart_syscall": (219, 128),
    "rt_sigaction": (13, 134),
    "rt_sigprocmask": (14, 135),
    "rt_sigreturn": (15, 139),
    "rt_sigpending": (127, 136),
    "rt_sigtimedwait": (128, 137),
    "rt_sigsuspend": (130, 133),
    "sigaltstack": (131, 132),
    "pause": (34, None),
    "nanosleep": (35, 101),
    "clock_nanosleep": (230, 115),
    "clock_gettime": (228, 113),
    "clock_getres": (229, 114),
    "time": (201, None),
    "gettimeofday": (96, 169),
    "alarm": (37, None),
    "getitimer": (36, 102),
    "setitimer": (38, 103),
    "times": (100, 153),
    "getrusage": (98, 165),
    "sysinfo": (99, 179),
    "uname": (63, 160),
    "getrandom": (318, 278),
    "getpid": (39, 172),
    "getppid": (110, 173),
    "gettid": (186, 178),
    "getuid": (102, 174),
    "geteuid": (107, 175),
    "getgid": (104, 176),
    "getegid": (108, 177),
    "read": (0, 63),
    "write": (1, 64),
    "readv": (19, 65),
    "writev": (20, 66),
    "pread64": (17, 67),
    "pwrite64": (18, 68),
    "lseek": (8, 62),
    "close": (3, 57),
    "close_range": (436, 436),
    "dup": (32, 23),
    "dup2": (33, None),
    "dup3": (292, 24),
    "pipe": (22, None),
    "pipe2": (293, 59),
    "select": (23, None),
    "pselect6": (270, 72),
    "poll": (7, None),
    "ppoll": (271, 73),
    "stat": (4, None),
    "fstat": (5, 80),
    "lstat": (6, None),
    "newfstatat": (262, 79),
    "statx": (332, 291),
    "access": (21, None),
    "faccessat": (269, 48),
    "faccessat2": (439, 439),
    "readlink": (89, None),
    "readlinkat": (267, 78),
    "getdents": (78, None),
    "getdents64": (217, 61),
    "getcwd": (79, 17),
    "chdir": (80, 49),
    "fchdir": (81, 50),
}
OPEN: dict[str, Numbers] = {"open": (2, None), "openat": (257, 56)}
CHANGE: dict[str, Numbers] = {
    # what writing a file, or a folder, of its own takes
    "truncate": (76, 45),
    "ftruncate": (77, 46),
    "mkdir": (83, None),
    "mkdirat": (258, 34),
    "rmdir": (84, None),
    "unlink": (87, None),
    "unlinkat": (263, 35),
    "rename": (82, None),
    "renameat": (264, 38),
    "renameat2": (316, 276),
    "umask": (95, 166),
    "fsync": (74, 82),
    "fdatasync": (75, 83),
}

# bits of a word; argument k, from 0, is the words 2 k and, its upper half, 2 k + 1
ALL = 0xFFFFFFFF
CHANGING = 0x3 | 0x40 | 0x200  # O_ACCMODE, O_CREAT, O_TRUNC
READ_ONLY: dict[str, tuple[Way, ...]] = {
    "open": (((2, CHANGING, (0,)),),),
    "openat": (((4, CHANGING, (0,)),),),
}
# the one that makes a thread; all that the C libraries give for one
CLONE_THREAD = 0x10000
OF_THREADS = 0x7D0F00
O_ASYNC = 0x2000
MAY_IF: dict[str, tuple[Numbers, tuple[Way, ...]]] = {
    # name: its numbers, and the ways in which it may be called
    "clone": ((56, 220), (((0, ALL & ~OF_THREADS | CLONE_THREAD, (CLONE_THREAD,)),),)),
    "fcntl": (
        (72, 25),
        (
            (
                (2, ALL, (0, 1, 2, 3, 1030)),
            ),  # F_DUPFD, F_GETFD, F_SETFD, F_GETFL, F_DUPFD_CLOEXEC: no owner, lease, lock
            ((2, ALL, (4,)), (4, O_ASYNC, (0,))),  # F_SETFL, but no signals
        ),
    ),
    # TCGETS, TCGETS2 and TIOCGWINSZ ask whether it is a terminal; FIONCLEX, FIOCLEX, FIONBIO
    "ioctl": ((16, 29), (((2, ALL, (0x5401, 0x802C542A, 0x5413, 0x5450, 0x5451, 0x5421)),),)),
    # waiting and waking, private and on a clock or not; not FUTEX_LOCK_PI and its like, which name
    # anybody's thread
    "futex": ((202, 98), (((2, ALL & ~(128 | 256), (0, 1, 3, 4, 5, 9, 10)),),)),
    # MADV_DONTNEED, FREE, HUGEPAGE, NOHUGEPAGE, GUARD_INSTALL, GUARD_REMOVE; not PAGEOUT: others
    # read these pages too
    "madvise": ((28, 233), (((4, ALL, (4, 8, 14, 15, 102, 103)),),)),
    "mbind": ((237, 235), (((10, ALL, (0,)),),)),  # says where memory shall be and moves none
    "membarrier": ((324, 283), (((0, ALL, (0, 8, 16)),),)),  # of its own threads
    "prlimit64": (
        (302, 261),
        (((0, ALL, (0,)), (4, ALL, (0,)), (5, ALL, (0,))),),
    ),  # its own, and no new ones
}
NEW = 424
"""Calls from this number on are of 2019 or later: they are unknown, not refused, so that libraries
take older ones.
"""

# column above, audit's number of the architecture
MACHINES = {
    "x86_64": (0, 0xC000003E),
    "aarch64": (1, 0xC00000B7),
}
NUMBER, ARCHITECTURE, WORDS = 0, 4, 16  # where struct seccomp_data has them
# BPF: take a word, mask it, jump if, end
LOAD = 0x20
AND = 0x54
EQUAL = 0x15
AT_LEAST = 0x35
RETURN = 0x06
ALLOW = 0x7FFF0000
EPERM = 0x00050001
ENOSYS = 0x00050000 | 38
Line = tuple[int, int, int, int]  # what, lines to skip if so, lines to skip if not, with
ENDS: list[Line] = [(RETURN, 0, 0, answer) for answer in (EPERM, ENOSYS, ALLOW)]


def program(machine: str, *, writes: bool) -> bytes:
    """Return the filter for one of `MACHINES`; `writes` if the process has a folder to write to."""
    column, architecture = MACHINES[machine]
    free = MAY | OPEN | CHANGE if writes else MAY
    bound = (
        MAY_IF
        if writes
        else MAY_IF | {name: (OPEN[name], ways) for name, ways in READ_ONLY.items()}
    )
    asked: list[tuple[int | None, list[Line]]] = [
        (numbers[column], []) for numbers in free.values()
    ]
    asked += [(numbers[column], _part(ways)) for numbers, ways in bound.values()]
    asked = [(number, part) for number, part in asked if number is not None]

    lines: list[Line] = [
        (LOAD, 0, 0, ARCHITECTURE),
        (EQUAL, 1, 0, architecture),
        ENDS[0],
        (LOAD, 0, 0, NUMBER),
    ]
    parts: list[Line] = []
    for k, (number, part) in enumerate(asked):
        to_ends = len(asked) - k  # the numbers after this one, and the line below
        to_part = to_ends + len(ENDS) + len(parts)
        lines.append(
            (
                EQUAL,
                to_part if part else to_ends + ENDS.index((RETURN, 0, 0, ALLOW)),
                0,
                number or 0,
            )
        )
        parts += part
    lines.append((AT_LEAST, 1, 0, NEW))  # over the first of the ends to the second
    return b"".join(struct.pack("=HBBI", *line) for line in (*lines, *ENDS, *parts))


def _part(ways: tuple[Way, ...]) -> list[Line]:
    """Return the lines that allow a call where one of its ways holds, and else refuse it."""
    lines: list[Line] = []
    for way in ways:
        rest: list[Line] = [(RETURN, 0, 0, ALLOW)]  # of this way, from its end
        for word, mask, values in reversed(way):
            tests: list[Line] = [
                (EQUAL, len(values) - k - 1, 0, value) for k, value in enumerate(values[:-1])
            ]
            # none of them: over the rest, to the next way
            tests.append((EQUAL, 0, len(rest), values[-1]))
            rest = [(LOAD, 0, 0, WORDS + 4 * word), (AND, 0, 0, mask), *tests, *rest]
        lines += rest
    return [*lines, (RETURN, 0, 0, EPERM)]
