"""What submissions try: each is the body of a function that returns something true where it got
what it was after.

In the texts, `{secret}` is a file of the teacher's, `{results}` a student's result, `{folder}`
where both are, `{lessons}` the folder of the lessons, `{pid}` the grader's process, `{victim}`
another one of the same user, `{port}` where the teacher's machine listens.
"""

SYSCALL = "import ctypes; call = ctypes.CDLL(None, use_errno=True).syscall; "
PIPE = "import fcntl, os; r, w = map(os.fdopen, os.pipe(), 'rw'); "
NUMPY_S = "import fcntl, os; f = open(np.__file__); "
RAISE = "fcntl.fcntl(r, 4, os.O_ASYNC | os.O_NONBLOCK); w.write('x'); w.flush(); return 1"
"""A pipe, a file that others read, and asking for a signal when there is something in the pipe."""

READING = {
    "a path of text": "return len(open({secret!r}).read())",
    "a path of bytes": "return len(open({secret!r}.encode()).read())",
    "a path object": "import pathlib; return len(pathlib.Path({secret!r}).read_bytes())",
    "a path that is a buffer": "import os; return len(os.listdir(os.fsencode({folder!r})))",
    "a path by realpath patched": (
        "import os; os.path.realpath = lambda *a, **k: '/dev/null'; return"
        " len(open({secret!r}).read())"
    ),
    "a path of a class of its own": (
        "class P:\n    def __fspath__(self): return {secret!r}\nreturn len(open(P()).read())"
    ),
    "up from here": "return len(open('../' * 20 + {secret!r}[1:]).read())",
    "from the folder above": "import os; os.chdir({folder!r}); return len(os.listdir('.'))",
    "relative to a descriptor": (
        "import os; d = os.open('/', os.O_RDONLY); return os.open({secret!r}[1:], os.O_RDONLY,"
        " dir_fd=d) > 0"
    ),
    "os.open": "import os; return len(os.read(os.open({secret!r}, os.O_RDONLY), 99))",
    "an open file without reading": "import os; return os.open({secret!r}, os.O_RDONLY) > 0",
    "io.open_code": "import io; return len(io.open_code({secret!r}).read())",
    "FileIO": "import _io; return len(_io.FileIO({secret!r}).read())",
    "numpy": "return len(np.fromfile({secret!r}, np.uint8))",
    "a memory map": "return len(np.memmap({secret!r}, np.uint8, 'r'))",
    "linecache": "import linecache; return len(linecache.getlines({secret!r}))",
    "a loader": (
        "import importlib.machinery as m; return len(m.SourceFileLoader('x',"
        " {secret!r}).get_data({secret!r}))"
    ),
    "sqlite": (
        "import sqlite3; sqlite3.connect({folder!r} + '/new.db').execute('create table t(x)');"
        " return 1"
    ),
    "the C library": (
        "import ctypes; c = ctypes.CDLL(None); return c.open({secret!r}.encode(), 0) >= 0"
    ),
    "a system call": (
        SYSCALL
        + "return call(257, -100, {secret!r}.encode(), 0, 0) >= 0 or call(2, {secret!r}.encode(),"
        " 0) >= 0"
    ),
    "openat2": SYSCALL + "return call(437, -100, {secret!r}.encode(), bytes(24), 24) >= 0",
    "a link of its own": (
        "import os\ntry: os.symlink({secret!r}, 'mine')\nexcept OSError: return 0\nreturn"
        " len(open('mine').read())"
    ),
    "a hard link": "import os; os.link({secret!r}, 'mine'); return len(open('mine').read())",
    "a listing": "import os; return len(list(os.scandir({folder!r})))",
    "the root of the grader": "return len(open('/proc/{pid}/root' + {secret!r}).read())",
    "the root of itself": "return len(open('/proc/self/root' + {secret!r}).read())",
    "the memory of the grader": "return len(open('/proc/{pid}/mem', 'rb').read(1))",
    "the maps of the grader": "return len(open('/proc/{pid}/maps').read())",
    "the environment of the grader": "return len(open('/proc/{pid}/environ').read())",
    "the descriptors of the grader": "import os; return len(os.listdir('/proc/{pid}/fd'))",
    "the command lines": (
        "import glob; return len([open(f).read() for f in glob.glob('/proc/[0-9]*/cmdline')])"
    ),
    "users": "return len(open('/etc/passwd').read())",
    "keys": "import os; return len(os.listdir(os.path.expanduser('~root/.ssh')))",
    "the mounts": "return len(open('/proc/mounts').read())",
    "raw memory": "return len(open('/dev/mem', 'rb').read(1))",
    "a disk": (
        "import glob; return len(glob.glob('/dev/sd*') + glob.glob('/dev/vd*') +"
        " glob.glob('/dev/nvme*'))"
    ),
    "a terminal": "return len(open('/dev/tty').name)",
    "mounting": SYSCALL + "return call(165, b'/', b'/mnt', b'', 4096, None) == 0",
    "a handle": SYSCALL + "return call(304, -100, bytes(64), 0) >= 0",
}

OPEN_TO_USERS = {"the command lines", "users", "the mounts", "a disk"}
"""What another user reads of a container too, where that is the wall: nothing of the teacher's or
of other students.
"""

SOLUTIONS = {
    "import lessons": "import lessons.icp.exercises.align_rigid as a; return 1",
    "import workbench": "import workbench; return 1",
    "import by the machinery": (
        "import importlib.util as u; return u.find_spec('workbench.exercise') is not None"
    ),
    "finders restored": (
        "import sys; from importlib.machinery import PathFinder\nsys.meta_path[:] = [PathFinder]\n"
        "sys.path.append({lessons!r}[:-8])\nimport lessons.icp\nreturn 1"
    ),
    "the reference's text": (
        "return len(open({lessons!r} + '/icp/exercises/align_rigid.py').read())"
    ),
    "the reference's bytecode": (
        "import glob; return len([open(f, 'rb') for f in glob.glob({lessons!r} +"
        " '/icp/exercises/__pycache__/*')])"
    ),
    "run by its path": (
        "import runpy; return len(runpy.run_path({lessons!r} + '/icp/exercises/align_rigid.py'))"
    ),
    "a walk over everything": (
        "import os\nreturn any('align_rigid.py' in names or 'grading.py' in names for _, _, names"
        " in os.walk('/'))"
    ),
    "other packages": "import rerun; return 1",
    "what the frames know": (
        "import sys\nframe, found = sys._getframe(), set()\nwhile frame: found |="
        " set(frame.f_locals) | set(frame.f_globals); frame = frame.f_back\nreturn bool(found &"
        " {{'exercise', 'reference', 'checks', 'expected', 'judge', 'Exercise'}})"
    ),
    "what the collector knows": (
        "import gc\nreturn any(getattr(o, '__name__', '') in ('is_the_mean', 'moves_along') for o"
        " in gc.get_objects())"
    ),
    "descriptors that are not its own": (
        "import os\ndef there(n):\n    try: return os.fstat(n) is not None\n    except OSError:"
        " return False\n"
        # nothing, what it prints twice, the two ends of its pipes
        "return sum(map(there, range(1024))) > 5"
    ),
    "the call's message": (
        "import sys\nasked = sys._getframe(1).f_locals.get('request', {{}})\n"
        "return bool(set(asked) - {{'do', 'args', 'options', 'nonce', 'file'}})"
    ),
}

HARM = {
    "its marks": "open({results!r}, 'w').write('full'); return 1",
    "marks by appending": "open({results!r}, 'a').write('full'); return 1",
    "marks by bytes": "open({results!r}.encode(), 'r+b').write(b'full'); return 1",
    "marks by a system call": (
        SYSCALL + "f = call(257, -100, {results!r}.encode(), 1, 0); return f >= 0"
    ),
    "marks renamed": "import os; os.rename({results!r}, {results!r} + '2'); return 1",
    "marks removed": "import os; os.remove({results!r}); return 1",
    "marks truncated": "import os; os.truncate({results!r}, 0); return 1",
    "marks not readable": "import os; os.chmod({results!r}, 0); return 1",
    "marks given away": "import os; os.chown({results!r}, 1, 1); return 1",
    "marks of another day": "import os; os.utime({results!r}, (0, 0)); return 1",
    "marks with an attribute": "import os; os.setxattr({results!r}, 'user.x', b'1'); return 1",
    "a file beside": "open({folder!r} + '/new.json', 'w'); return 1",
    "a folder beside": "import os; os.mkdir({folder!r} + '/new'); return 1",
    "a pipe beside": "import os; os.mkfifo({folder!r} + '/new'); return 1",
    "a link beside": "import os; os.symlink('/etc/passwd', {folder!r} + '/new'); return 1",
    "everything": "import shutil; shutil.rmtree({folder!r}); return 1",
    "everything by the C library": (
        "import ctypes; return ctypes.CDLL(None).unlink({results!r}.encode()) == 0"
    ),
    "the temporary folder": "import tempfile; open('/tmp/of-a-student', 'w'); return 1",
    "numpy for the next": "open(np.__file__, 'a').write(''); return 1",
    "Python for the next": "import os; open(os.__file__, 'a').write(''); return 1",
    "the child for the next": (
        "import sys; open(sys.modules['__main__'].__file__, 'a').write(''); return 1"
    ),
    "modes for the next": "import os; os.chmod(np.__file__, 0o777); return 1",
    "a remount": SYSCALL + "return call(165, b'', b'/', None, 32 | 4096, None) == 0",
}

SHARED = {
    "a lease to write": NUMPY_S + "fcntl.fcntl(f, fcntl.F_SETLEASE, fcntl.F_WRLCK); return 1",
    "a lease to read": NUMPY_S + "fcntl.fcntl(f, fcntl.F_SETLEASE, fcntl.F_RDLCK); return 1",
    "a lease by a system call": NUMPY_S + SYSCALL + "return call(72, f.fileno(), 1024, 1) == 0",
    "a lease by the C library": (
        NUMPY_S + "import ctypes; return ctypes.CDLL(None).fcntl64(f.fileno(), 1024, 0) == 0"
    ),
    "a lease of a command with high bits": (
        NUMPY_S + SYSCALL + "return call(72, f.fileno(), 1024 + 2**40, 1) == 0"
    ),
    "leases on all of numpy": (
        "import fcntl, glob, os; held = []\n"
        "for name in glob.glob(os.path.dirname(np.__file__) + '/**/*.py', recursive=True)[:40]:\n"
        "    f = open(name)\n"
        "    try: fcntl.fcntl(f, fcntl.F_SETLEASE, fcntl.F_WRLCK); held.append(f)\n"
        "    except OSError: pass\nreturn len(held)"
    ),
    "notes of who opens": (
        "import fcntl, os; d = os.open(os.path.dirname(np.__file__), 0); "
        "\ntry: fcntl.fcntl(d, fcntl.F_NOTIFY, fcntl.DN_ACCESS)\nfinally: os.close(d)\nreturn 1"
    ),
    "notes of who reads": SYSCALL + "return call(294, 0) >= 0",
    "a lock on a file": NUMPY_S + "fcntl.flock(f, fcntl.LOCK_EX); return 1",
    "a lock on a part": NUMPY_S + "fcntl.lockf(f, fcntl.LOCK_SH); return 1",
    "a lock of an open file": (
        NUMPY_S + "import struct; fcntl.fcntl(f, 37, struct.pack('hhqqi', 0, 0, 0, 0, 0)); return 1"
    ),
    "who holds a lock": (
        NUMPY_S + "import struct; fcntl.fcntl(f, 5, struct.pack('hhqqi', 1, 0, 0, 0, 0)); return 1"
    ),
    "a hint for all who write": (
        NUMPY_S + "import struct; fcntl.fcntl(f, 1036, struct.pack('Q', 1)); return 1"
    ),
    "pages dropped": (
        NUMPY_S + "os.posix_fadvise(f.fileno(), 0, 0, os.POSIX_FADV_DONTNEED); return 1"
    ),
    "pages put out": (
        NUMPY_S + "import mmap; mmap.mmap(f.fileno(), 0, prot=1).madvise(21); return 1"
    ),
    "pages counted": (
        SYSCALL + "m = ctypes.create_string_buffer(9); a = ctypes.addressof(m); "
        "return call(27, a - a % 4096, 4096, bytes(1)) == 0"
    ),
    "pages merged": "import mmap; mmap.mmap(-1, 4096).madvise(12); return 1",
    "pages locked": SYSCALL + "m = bytes(4096); return call(149, m, 4096) == 0",
    "a handle of a file": (
        SYSCALL
        + "return call(303, -100, np.__file__.encode(), b'\\x80' + bytes(200), bytes(8), 0) == 0"
    ),
    "every file written to disk": SYSCALL + "return call(162) == 0",
}

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
