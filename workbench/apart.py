"""Reads files that somebody else made in a process of its own, which is ended where it takes too
long or too much.

`@apart` before a reader is all that its callers see of it: the reader gets its arguments in another
process, and what it returns or raises comes back. A file that a page was handed has less room than
one that a command names.
"""

import atexit
import contextlib
import functools
import importlib
import os
import pickle
import queue
import subprocess
import sys
import threading
import weakref
from collections.abc import Callable, Iterator
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ParamSpec, TypeVar, cast

from workbench.errors import InputError
from workbench.machinery.threads import as_here

P = ParamSpec("P")
R = TypeVar("R")

READERS = 2
"""How many files are read at the same time."""
MOST_TOLD = 256
"""Of how many files it is kept what was said of them."""
PAGE_SIZE = os.sysconf("SC_PAGE_SIZE") if hasattr(os, "sysconf") else 4096
LARGE = 200 * 2**20
"""Bytes of memory at which a process that has read something makes room by ending."""
BEGIN = "import sys; sys.path[:] = sys.argv[1:]; from workbench import apart; apart.{}()"


@dataclass(frozen=True, kw_only=True)
class Allowance:
    """What reading one file may take.

    Attributes:
        unpacked: Bytes of a file, and of what it unpacks to.
        points: Points of a cloud, or vertices of a mesh.
        pixels: Of a picture.
        lines: Of a list that is read word by word.
        seconds: Of a processor.
        memory: Bytes beyond what Python itself takes.
        more: What a refusal ends with: where more is allowed.
    """

    unpacked: int
    points: int
    pixels: int
    lines: int
    seconds: int
    memory: int
    more: str = ""


COMMAND = Allowance(
    unpacked=500 * 10**6,
    points=5_000_000,
    pixels=50_000_000,
    lines=1_000_000,
    seconds=60,
    memory=4 * 2**30,
)
PAGE = Allowance(
    unpacked=64 * 10**6,
    points=500_000,
    pixels=25_000_000,
    lines=250_000,
    seconds=2,
    memory=384 * 2**20,
    more=" on a page; more is read where `workbench show` names the file",
)
_uploads = set[Path]()
_given: ContextVar[Allowance | None] = ContextVar("allowance", default=None)
_noted: list[str] = []
_told: dict[Path, tuple[str, ...]] = {}
_waiting: "weakref.WeakSet[Any]" = weakref.WeakSet()
_inside = False


def handed_to_a_page(folder: Path) -> None:
    """Let files in a folder have the allowance of a page."""
    _uploads.add(folder)


def forgotten(folder: Path) -> None:
    """Undo `handed_to_a_page`."""
    _uploads.discard(folder)


def allowance() -> Allowance:
    """Return what the file that is being read may take."""
    return _given.get() or COMMAND


@contextlib.contextmanager
def allowing(allowed: Allowance) -> Iterator[None]:
    """Let files that are read in this block take so much."""
    before = _given.set(allowed)
    try:
        yield
    finally:
        _given.reset(before)


def note(words: str) -> None:
    """Say something of the file that is being read, one sentence, to whoever sees what comes of
    it.
    """
    _noted.append(words)


def told(path: Path) -> tuple[str, ...]:
    """Return what its readers said of a file."""
    return _told.get(path, ())


def tell_when_waiting(somebody: Any) -> None:
    """Call `somebody.stands_still()` in each thread that begins to wait for a file; held weakly."""
    _waiting.add(somebody)


def apart(read: Callable[P, R]) -> Callable[P, R]:
    """Return a reader that works in a process of its own.

    The reader is a function of a module; what it takes and returns pickles. Its first argument is
    the path of the file, for messages. Whatever it raises comes out as an `InputError` of one line;
    one that it raised itself comes out as it is.
    """

    @functools.wraps(read)
    def elsewhere(*args: P.args, **kwargs: P.kwargs) -> R:
        path = Path(cast(Any, args[0] if args else next(iter(kwargs.values()))))
        if _inside:
            return read(*args, **kwargs)
        with allowing(_given.get() or (PAGE if _uploads & set(path.parents) else COMMAND)):
            return _read_elsewhere(read, path, args, kwargs=kwargs)

    return elsewhere


def _read_elsewhere(read: Callable[..., R], path: Path, args: Any, *, kwargs: Any) -> R:
    for somebody in tuple(_waiting):
        somebody.stands_still()
    asked = pickle.dumps(
        (read.__module__, read.__qualname__, os.getcwd(), path.name, allowance(), args, kwargs)
    )
    reader = _free.get()
    try:
        value, error, notes = reader.ask(asked, path.name)
    finally:
        _free.put(reader)
    if notes:
        _told[path] = notes
        while len(_told) > MOST_TOLD:
            _told.pop(next(iter(_told)))
    if error is not None:
        raise InputError(error)
    return value


class _Reader:
    """A place in which a process reads; it starts with the first file."""

    def __init__(self) -> None:
        self.process: subprocess.Popen | None = None

    def ask(self, asked: bytes, name: str) -> tuple[Any, str | None, tuple[str, ...]]:
        """Return what was read or why not, and what was noted."""
        how = self._told(asked)
        if how == 0:  # it has just made room by ending; another one begins
            how = self._told(asked)
        if not isinstance(how, int):
            return how
        return None, f"{name}: to read it takes too long, or too much memory{allowance().more}", ()

    def _told(self, asked: bytes) -> tuple[Any, str | None, tuple[str, ...]] | int:
        """Return the answer of the process, or how it ended without one."""
        process = self._running()
        # on a machine that is busy
        late = threading.Timer(4 * allowance().seconds + 10, process.kill)
        late.daemon = True
        late.start()
        asking, answers = process.stdin, process.stdout
        assert asking is not None
        assert answers is not None
        try:
            asking.write(len(asked).to_bytes(8, "little") + asked)
            asking.flush()
            return pickle.load(answers)
        except (OSError, EOFError, pickle.UnpicklingError):
            return self.end()
        except BaseException:
            self.end()  # an answer is on its way that nobody waits for
            raise
        finally:
            late.cancel()

    def _running(self) -> subprocess.Popen:
        if self.process is None or self.process.poll() is not None:
            self.end()
            self.process = subprocess.Popen(
                [sys.executable, "-c", BEGIN.format(read_for_others.__name__), *sys.path],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                env=os.environ | as_here(),
                start_new_session=True,  # Ctrl+C is for the process that asks
            )
        return self.process

    def end(self) -> int:
        """End the process, if there is one; return how it ended."""
        process = self.process
        self.process = None
        if process is None:
            return 0
        for pipe in (process.stdin, process.stdout):
            with contextlib.suppress(OSError):
                if pipe is not None:
                    pipe.close()
        with contextlib.suppress(subprocess.TimeoutExpired):
            return process.wait(0.5)  # one that made room is about to end
        process.kill()
        return process.wait()


_readers = [_Reader() for _ in range(READERS)]
_free: "queue.LifoQueue[_Reader]" = queue.LifoQueue()


def _begin() -> None:
    """Have readers of our own: a copy of this process must not talk to those of the first one."""
    global _readers, _free
    _readers = [_Reader() for _ in range(READERS)]
    _free = queue.LifoQueue()
    for reader in _readers:
        _free.put(reader)


def _end() -> None:
    for reader in _readers:
        if reader.process is not None:
            reader.process.kill()
            reader.end()


_begin()
atexit.register(_end)
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_begin)


def read_for_others() -> None:
    """Answer what comes in, until nobody asks any more or much memory was taken. The life of a
    process that reads.
    """
    global _inside
    _inside = True
    ours = os.fdopen(os.dup(1), "wb")
    silent = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silent, 1)  # whatever a library prints
    asked = sys.stdin.buffer
    with contextlib.suppress(AttributeError, OSError):
        os.nice(5)  # who looks at a page comes first
    importlib.import_module("numpy").seterr(all="ignore")
    importlib.import_module("warnings").simplefilter("ignore")
    while length := asked.read(8):
        answer = _answer(asked.read(int.from_bytes(length, "little")))
        ours.write(answer)
        ours.flush()
        if len(answer) > LARGE or _memory()[1] > LARGE:
            return


def _answer(question: bytes) -> bytes:
    module, name, here, file, allowed, args, kwargs = pickle.loads(question)
    _noted.clear()
    try:
        os.chdir(here)
        read = getattr(importlib.import_module(module), name)
        read = getattr(read, "__wrapped__", read)
        with allowing(allowed), _limited(allowed):
            value = read(*args, **kwargs)
        return pickle.dumps((value, None, tuple(_noted)), protocol=5)
    except InputError as error:
        message = str(error)
    except MemoryError:
        message = f"{file}: to read it takes more memory than it may{allowed.more}"
    except Exception as error:  # readers and libraries raise what they trip over
        message = f"{file}: not readable ({type(error).__name__})"
    return pickle.dumps((None, message, ()), protocol=5)


@contextlib.contextmanager
def _limited(allowed: Allowance) -> Iterator[None]:
    """Let the kernel refuse memory and end this process where it takes too much; nothing where
    there are no such limits.
    """
    try:
        import resource
    except ImportError:
        yield
        return
    spent = resource.getrusage(resource.RUSAGE_SELF)
    limits = {resource.RLIMIT_CPU: int(spent.ru_utime + spent.ru_stime) + 1 + allowed.seconds}
    if used := _memory()[0]:
        limits[resource.RLIMIT_AS] = used + allowed.memory
    before = {kind: resource.getrlimit(kind) for kind in limits}
    for kind, most in limits.items():
        resource.setrlimit(kind, (most, before[kind][1]))
    try:
        yield
    finally:
        for kind, pair in before.items():
            resource.setrlimit(kind, pair)


def _memory() -> tuple[int, int]:
    """Return the bytes of memory that this process has asked for, and those that it takes; zeros
    where nobody says.

    The most that it ever took is no help: a process begins with the number of the one that started
    it.
    """
    try:
        asked, taken = Path("/proc/self/statm").read_text().split()[:2]
    except OSError:
        return 0, 0
    return PAGE_SIZE * int(asked), PAGE_SIZE * int(taken)
