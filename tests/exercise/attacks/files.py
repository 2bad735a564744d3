"""Attacks on files: reading the teacher's, finding our solutions, doing harm, holding up who reads
the same ones.
"""

from tests.exercise.attacks.pieces import NUMPY_S, SYSCALL

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
