"""Attacks on other processes, through the doors of the kernel, and on memory, time and disk."""

from tests.exercise.attacks.pieces import PIPE, RAISE, SYSCALL

PROCESSES = {
    "fork": "import os; return os.fork() >= 0",
    "forkpty": "import os; return os.forkpty()[0] >= 0",
    "vfork": SYSCALL + "return call(58) >= 0",
    "clone": SYSCALL + "return call(56, 17, 0, 0, 0, 0) >= 0",
    "clone with a namespace": SYSCALL + "return call(56, 0x10000011, 0, 0, 0, 0) >= 0",
    "clone3": SYSCALL + "a = bytearray(88); a[32] = 17; return call(435, bytes(a), 88) >= 0",
    "subprocess": "import subprocess; subprocess.run(['/bin/true']); return 1",
    "Python again": (
        "import subprocess, sys; return subprocess.run([sys.executable, '-c', '']).returncode == 0"
    ),
    "system": "import os; return os.system('true') == 0",
    "popen": "import os; return os.popen('echo x').read() == 'x'",
    "posix_spawn": (
        "import os, sys; return os.posix_spawn(sys.executable, [sys.executable, '-c', ''],"
        " {{}}) > 0"
    ),
    "multiprocessing, spawned": (
        "import multiprocessing as m; q = m.get_context('spawn').Process(target=print); q.start();"
        " q.join(1); return 1"
    ),
    "multiprocessing, forked": (
        "import multiprocessing as m; m.get_context('fork').Process(target=print).start(); return 1"
    ),
    "fork_exec": (
        "import _posixsubprocess, os, sys, inspect\nr, w = os.pipe()\na ="
        " [[sys.executable.encode(), b'-c', b''], [sys.executable.encode()], True, (), None, None]"
        " + [-1] * 6 + [r, w]\na += [True, True] + [-1] * 1 + [None, None, -1, None, False]\nreturn"
        " _posixsubprocess.fork_exec(*a) > 0"
    ),
    "exec": "import os, sys; os.execv(sys.executable, [sys.executable, '-c', ''])",
    "execveat": (
        SYSCALL + "import sys; return call(322, -100, sys.executable.encode(), None, None, 0) >= 0"
    ),
    "a signal to the grader": "import os; os.kill({pid}, 0); return 1",
    "a signal to the parent": "import os; os.kill(os.getppid(), 9); return 1",
    "a signal to the group": "import os; os.killpg(os.getpgid(0), 0); return 1",
    "a signal to all": "import os; os.kill(-1, 0); return 1",
    "a signal by the C library": "import ctypes; return ctypes.CDLL(None).kill({pid}, 0) == 0",
    "a signal by a descriptor": (
        "import os, signal; f = os.pidfd_open({pid}); signal.pidfd_send_signal(f, 0); return 1"
    ),
    "a descriptor of the grader": SYSCALL + "return call(438, call(434, {pid}, 0), 1, 0) >= 0",
    "a signal by a pipe to the grader": (
        PIPE + "fcntl.fcntl(r, fcntl.F_SETOWN, {pid}); fcntl.fcntl(r, 10, 28); " + RAISE
    ),
    "a signal by a pipe to a group": (
        PIPE + "fcntl.fcntl(r, fcntl.F_SETOWN, -{victim}); fcntl.fcntl(r, 10, 28); " + RAISE
    ),
    "a signal by a pipe to its own": (
        PIPE + "fcntl.fcntl(r, fcntl.F_SETOWN, os.getpid()); fcntl.fcntl(r, 10, 28); " + RAISE
    ),
    "a signal by a pipe, the other way": (
        PIPE
        + "import struct; fcntl.fcntl(r, 15, struct.pack('ii', 1, {victim})); fcntl.fcntl(r, 10,"
        " 28); " + RAISE
    ),
    "a signal by a system call for the pipe": (
        PIPE + SYSCALL + "return call(72, r.fileno(), 8, {victim}) == 0"
    ),
    "a signal that a pipe would send": PIPE + "fcntl.fcntl(r, 10, 28); return 1",
    "a pipe that sends signals": PIPE + "fcntl.fcntl(r, 4, os.O_ASYNC); return 1",
    "a pipe that sends signals, by ioctl": (
        PIPE + "fcntl.ioctl(r, 0x5452, b'\\x01\\0\\0\\0'); return 1"
    ),
    "the owner of a pipe, by ioctl": (
        PIPE + "import struct; fcntl.ioctl(r, 0x8901, struct.pack('i', {victim})); return 1"
    ),
    "the group of a pipe, by ioctl": (
        PIPE + "import struct; fcntl.ioctl(r, 0x8902, struct.pack('i', {victim})); return 1"
    ),
    "who owns its input": "import fcntl; fcntl.fcntl(0, fcntl.F_GETOWN); return 1",
    "a clock that sends signals": SYSCALL + "return call(222, 1, None, bytes(8)) == 0",
    "another's processor": "import os; os.sched_setaffinity({victim}, {{0}}); return 1",
    "another's turn": (
        "import os; os.sched_setscheduler({victim}, os.SCHED_IDLE, os.sched_param(0)); return 1"
    ),
    "another's turn, its param": (
        "import os; os.sched_setparam({victim}, os.sched_param(0)); return 1"
    ),
    "another's turn, all of it": (
        SYSCALL
        + "import struct; return call(314, {victim}, struct.pack('IIQiIQQQ', 48, 5, 0, 0, 0, 0, 0,"
        " 0), 0) == 0"
    ),
    "its own processor": "import os; os.sched_setaffinity(0, {{0}}); return 1",
    "another's nice value": "import os; os.setpriority(os.PRIO_PROCESS, {victim}, 5); return 1",
    "another's disk": SYSCALL + "return call(251, 1, {victim}, 3 << 13) == 0",
    "another's limits": (
        "import resource; resource.prlimit({victim}, resource.RLIMIT_NOFILE); return 1"
    ),
    "another's pages": SYSCALL + "return call(279, {victim}, 0, None, None, None, 0) == 0",
    "another's memory elsewhere": (
        SYSCALL + "return call(256, {victim}, 64, bytes(8), bytes(8)) >= 0"
    ),
    "another's list of locks": SYSCALL + "return call(274, {victim}, bytes(8), bytes(8)) == 0",
    "another's thread as a lock's owner": (
        SYSCALL + "import struct; lock = struct.pack('I', {victim}); import ctypes as c\n"
        "call(202, lock, 6, 0, struct.pack('qq', 1, 0), None, 0); return c.get_errno() == 110"
    ),
    "another's group": "import os; os.getpgid({victim}); return 1",
    "out of its session": "import os; os.setsid(); return 1",
    "compared with another": SYSCALL + "return call(312, {victim}, {pid}, 1, 0, 0) >= 0",
    "a descriptor for another": SYSCALL + "return call(434, {victim}, 0) >= 0",
    "another's memory given back": SYSCALL + "return call(448, call(434, {victim}, 0), 0) == 0",
    "another's memory advised": (
        SYSCALL + "return call(440, call(434, {victim}, 0), bytes(16), 1, 20, 0) >= 0"
    ),
    "writing the grader": (
        SYSCALL + "return call(311, {victim}, bytes(16), 1, bytes(16), 1, 0) >= 0"
    ),
    "ptrace": SYSCALL + "return call(101, 16, {pid}, 0, 0) == 0",
    "ptrace by its parent": SYSCALL + "return call(101, 0, 0, 0, 0) == 0",
    "reading the grader": SYSCALL + "return call(310, {pid}, bytes(16), 1, bytes(16), 1, 0) >= 0",
    "the grader's limits": (
        "import resource; resource.prlimit({pid}, resource.RLIMIT_NOFILE, (3, 3)); return 1"
    ),
    "the grader's priority": "import os; os.setpriority(os.PRIO_PROCESS, {pid}, 19); return 1",
    "outliving the grader": SYSCALL + "return call(157, 1, 0, 0, 0, 0) == 0",
    "a signal by a pipe": (
        PIPE + "fcntl.fcntl(r, fcntl.F_SETOWN, {victim}); fcntl.fcntl(r, 10, 9); " + RAISE
    ),  # the last: it dies
}

DOORS = {
    "a socket": "import socket; socket.socket(); return 1",
    "this machine": "import socket; socket.create_connection(('127.0.0.1', {port}), 0.5); return 1",
    "the web": (
        "import urllib.request; urllib.request.urlopen('http://127.0.0.1:{port}/', timeout=0.5);"
        " return 1"
    ),
    "a datagram": (
        "import socket; socket.socket(2, 2).sendto(b'x', ('127.0.0.1', {port})); return 1"
    ),
    "a local socket": "import socket; socket.socket(socket.AF_UNIX).bind('here'); return 1",
    "a pair of sockets": "import socket; socket.socketpair(); return 1",
    "a raw packet": "import socket; socket.socket(socket.AF_PACKET, socket.SOCK_RAW); return 1",
    "a socket by a system call": SYSCALL + "return call(41, 2, 1, 0) >= 0",
    "asyncio": "import asyncio; asyncio.new_event_loop(); return 1",
    "a namespace": SYSCALL + "return call(272, 0x10000000) == 0",
    "another's namespace": SYSCALL + "return call(308, 3, 0) == 0",
    "another root": SYSCALL + "return call(161, b'/') == 0",
    "bpf": SYSCALL + "return call(321, 0, bytes(64), 64) >= 0",
    "perf": SYSCALL + "return call(298, bytes(112), 0, -1, -1, 0) >= 0",
    "io_uring": SYSCALL + "return call(425, 1, bytes(120)) >= 0",
    "userfaultfd": SYSCALL + "return call(323, 1) >= 0",
    "keys of the kernel": SYSCALL + "return call(250, 0, -3, 0) >= 0",
    "a module of the kernel": SYSCALL + "return call(175, bytes(9), 9, b'') == 0",
    "other numbers of calls": SYSCALL + "return call(0x40000000 + 39) > 0",
    "numbers of 32 bits": (
        "import mmap, ctypes as c; code = mmap.mmap(-1, 4096, prot=7);"
        " code.write(bytes.fromhex('b814000000cd80c3'))\nreturn"
        " c.CFUNCTYPE(c.c_int)(c.addressof(c.c_char.from_buffer(code)))() > 0"
    ),
    "numbers that are none yet": (
        SYSCALL
        + "return call(2000) >= 0 or c.get_errno() not in (1, 38)".replace("c.get", "ctypes.get")
    ),
    "shared memory by a name": (
        "from multiprocessing.shared_memory import SharedMemory as M; M('x', True, 9); return 1"
    ),
    "a semaphore": SYSCALL + "return call(64, 0, 1, 0o1600) >= 0",
    "a queue of messages": SYSCALL + "return call(240, b'x', 0o100 | 2, 0o600, None) >= 0",
    "a ring's work": SYSCALL + "return call(426, 0, 1, 0, 0, None, 0) >= 0",
    "events": SYSCALL + "return call(291, 0) >= 0 or call(290, 0, 0) >= 0 or call(283, 1, 0) >= 0",
    "a signal's descriptor": SYSCALL + "return call(289, -1, bytes(8), 8, 0) >= 0",
    "a larger pipe": PIPE + "fcntl.fcntl(r, 1031, 1 << 20); return 1",
    "pages into a pipe": PIPE + SYSCALL + "return call(278, w.fileno(), bytes(16), 0, 0) >= 0",
    "a file into a pipe": (
        PIPE + "f = open(np.__file__); return os.splice(f.fileno(), w.fileno(), 9) > 0"
    ),
    "keys of memory": SYSCALL + "return call(330, 0, 0) >= 0",
    "a filter of its own": SYSCALL + "return call(317, 2, 0, bytes(4)) == 0",
    "walls of its own": SYSCALL + "return call(444, None, 0, 1) > 0",
    "shared memory": SYSCALL + "return call(29, 0, 1 << 30, 0o1600) >= 0",
    "memory without a limit": SYSCALL + "return call(319, b'x', 0) >= 0",
    "messages": SYSCALL + "return call(68, 0, 0o1600) >= 0",
    "limits": "import resource; resource.setrlimit(resource.RLIMIT_AS, (-1, -1)); return 1",
    "lower limits": "import resource; resource.setrlimit(resource.RLIMIT_CORE, (0, 0)); return 1",
    "priority": "import os; os.nice(-5); return 1",
    "being somebody": "import os; os.setuid(0); open('/etc/shadow'); return 1",
    "a clock": "import time; time.clock_settime(time.CLOCK_REALTIME, 0); return 1",
    "the name of the machine": "import socket; socket.sethostname('mine'); return 1",
}

RESOURCES = {
    "memory": "x = []\nwhile True: x.append(np.ones(30_000_000))",
    "memory at once": "return len(np.ones(10**10)) > 0",
    "a string": "return len('x' * 10**10) > 0",
    "files": "for i in range(200):\n    open(f'f{{i}}', 'wb').write(b'x' * 1_000_000)\nreturn 1",
    "a large file": (
        "f = open('f', 'wb')\nfor i in range(99): f.write(b'x' * 1_000_000)\nf.flush()\nreturn 1"
    ),
    "open files": "import os; return len([os.open('/dev/null', 0) for i in range(99)]) == 99",
    "sleep": "import time; time.sleep(60); return 1",
    "an endless loop": "while True: pass",
    "an endless loop in C": (
        "import itertools, collections; collections.deque(itertools.count(), 0)"
    ),
    "an endless loop that catches all": (
        "while True:\n    try:\n        while True: pass\n    except BaseException: pass"
    ),
    "recursion": "return centroid(p)",
    "recursion without a bound": "import sys; sys.setrecursionlimit(10**9); return centroid(p)",
    "a crash": "import ctypes; ctypes.string_at(0); return 1",
    "an exit": "import os; os._exit(0)",
    "an exit that says all is well": "import sys; sys.exit(0)",
    "a signal to itself": "import signal; signal.raise_signal(9); return 1",
    "an alarm": "import signal, time; signal.alarm(1); time.sleep(5); return 1",
    "threads that stay": (
        "import threading, time\nfor i in range(9): threading.Thread(target=time.sleep,"
        " args=(60,)).start()\nreturn 0"
    ),
    "printing for ever": "while True: print('x' * 10_000)",
    "printing past Python": "import os\nwhile True: os.write(1, b'x' * 10_000)",
    "an error that cannot be told": (
        "class E(Exception):\n    def __str__(self): raise self\nraise E"
    ),
    "an error of a long name": "raise type('E' * 10**6, (Exception,), {{}})('x' * 10**7)",
    "a huge answer": "return np.zeros((10**7, 3))",
    "a deep answer": "x = []\nfor _ in range(10**5): x = [x]\nreturn x",
    "a number without end": "return 10 ** 5000",
    "an answer with itself in it": "x = []; x.append(x); return x",
}
