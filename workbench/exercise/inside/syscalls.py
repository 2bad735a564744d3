"""The filter of system calls of a student's process: a denylist as the kernel takes it (seccomp, classic BPF).

What is refused leaves a function no other program, no other process, no socket, no signal, no mount, no file's owner or
mode, no memory that no limit counts, and none of the kernel's rarer doors. It imports nothing of ours.
"""

import struct
from typing import Any

NOT_FOR_A_FUNCTION = {
    # name: its number on (x86_64, aarch64); None where there is none
    "fork": (57, None), "vfork": (58, None), "execve": (59, 221), "execveat": (322, 281),
    "ptrace": (101, 117), "process_vm_readv": (310, 270), "process_vm_writev": (311, 271), "process_madvise": (440, 440),
    "kcmp": (312, 272), "kill": (62, 129), "tkill": (200, 130), "tgkill": (234, 131), "rt_sigqueueinfo": (129, 138),
    "rt_tgsigqueueinfo": (297, 240), "pidfd_open": (434, 434), "pidfd_send_signal": (424, 424), "pidfd_getfd": (438, 438),
    "socket": (41, 198), "socketpair": (53, 199), "io_uring_setup": (425, 425), "io_uring_enter": (426, 426),
    "io_uring_register": (427, 427), "shmget": (29, 194), "msgget": (68, 186), "semget": (64, 190), "mq_open": (240, 180),
    "memfd_create": (319, 279), "memfd_secret": (447, 447), "mount": (165, 40), "umount2": (166, 39),
    "pivot_root": (155, 41), "chroot": (161, 51), "unshare": (272, 97), "setns": (308, 268), "move_mount": (429, 429),
    "open_tree": (428, 428), "fsopen": (430, 430), "fsconfig": (431, 431), "fsmount": (432, 432), "fspick": (433, 433),
    "mount_setattr": (442, 442), "open_by_handle_at": (304, 265), "name_to_handle_at": (303, 264), "bpf": (321, 280),
    "perf_event_open": (298, 241), "userfaultfd": (323, 282), "keyctl": (250, 219), "add_key": (248, 217),
    "request_key": (249, 218), "init_module": (175, 105), "finit_module": (313, 273), "delete_module": (176, 106),
    "kexec_load": (246, 104), "kexec_file_load": (320, 294), "reboot": (169, 142), "swapon": (167, 224),
    "swapoff": (168, 225), "acct": (163, 89), "quotactl": (179, 60), "personality": (135, 92), "modify_ldt": (154, None),
    "iopl": (172, None), "ioperm": (173, None), "fanotify_init": (300, 262), "inotify_init": (253, None),
    "inotify_init1": (294, 26), "lookup_dcookie": (212, 18), "setpriority": (141, 140), "ioprio_set": (251, 30),
    "sched_setscheduler": (144, 119), "sched_setattr": (314, 274), "setrlimit": (160, 164), "prctl": (157, 167),
    "chmod": (90, None), "fchmod": (91, 52), "fchmodat": (268, 53), "fchmodat2": (452, 452), "chown": (92, None),
    "fchown": (93, 55), "lchown": (94, None), "fchownat": (260, 54), "utime": (132, None), "utimes": (235, None),
    "futimesat": (261, None), "utimensat": (280, 88), "setxattr": (188, 5), "lsetxattr": (189, 6), "fsetxattr": (190, 7),
    "removexattr": (197, 14), "lremovexattr": (198, 15), "fremovexattr": (199, 16), "setxattrat": (463, 463),
    "removexattrat": (466, 466), "mknod": (133, None), "mknodat": (259, 33),
    "sethostname": (170, 161), "setdomainname": (171, 162), "clock_settime": (227, 112), "settimeofday": (164, 170),
    "adjtimex": (159, 171), "clock_adjtime": (305, 266), "syslog": (103, 116), "vhangup": (153, 58),
}  # fmt: skip
CLONE, CLONE3, PRLIMIT = (56, 220), (435, 435), (302, 261)
MACHINES = {"x86_64": (0, 0xC000003E), "aarch64": (1, 0xC00000B7)}  # column above, audit's number of the architecture
LOAD, EQUAL, AT_LEAST, ANY_BIT, RETURN = 0x20, 0x15, 0x35, 0x45, 0x06  # BPF: take a word, jump if, end
NUMBER, ARCHITECTURE, FIRST, THIRD = 0, 4, 16, 32  # where struct seccomp_data has them
CLONE_THREAD, X32 = 0x10000, 0x40000000
EPERM, ENOSYS = 1, 38
ENDS = {"allow": 0x7FFF0000, "refuse": 0x00050000 | EPERM, "unknown": 0x00050000 | ENOSYS}


def program(machine: str) -> bytes:
    """Return the filter for a machine of `MACHINES`."""
    column, architecture = MACHINES[machine]
    numbers = sorted(n for n in (pair[column] for pair in NOT_FOR_A_FUNCTION.values()) if n is not None)
    parts: dict[str, list[tuple[int, int, str, str]]] = {  # name: lines (what, with, where to if, where to if not)
        "which": [
            (LOAD, ARCHITECTURE, "", ""),
            (EQUAL, architecture, "", "refuse"),
            (LOAD, NUMBER, "", ""),
            *([(AT_LEAST, X32, "refuse", "")] if machine == "x86_64" else []),
            *((EQUAL, number, "refuse", "") for number in numbers),
            (EQUAL, CLONE3[column], "unknown", ""),  # its flags cannot be seen; the C library then takes clone
            (EQUAL, PRLIMIT[column], "limits", ""),
            (EQUAL, CLONE[column], "", "allow"),
        ],
        "threads": [(LOAD, FIRST, "", ""), (ANY_BIT, CLONE_THREAD, "allow", "refuse")],
        "limits": [  # who only asks for them gives no new ones
            (LOAD, THIRD, "", ""),
            (EQUAL, 0, "", "refuse"),
            (LOAD, THIRD + 4, "", ""),
            (EQUAL, 0, "allow", "refuse"),
        ],
        **{name: [(RETURN, value, "", "")] for name, value in ENDS.items()},
    }
    places, lines = dict[str, int](), list[tuple[Any, ...]]()
    for name, part in parts.items():
        places[name] = len(lines)
        lines += part

    def over(at: int, to: str) -> int:
        return places[to] - at - 1 if to else 0

    return b"".join(struct.pack("=HBBI", op, over(i, yes), over(i, no), k) for i, (op, k, yes, no) in enumerate(lines))
