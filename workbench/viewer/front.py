"""Several servers behind one port: a small process accepts, reads where a connection leads, and hands it to one of them.

A page lives in one process. Its token begins with the number of that process, so its websocket, its scene, its files and
its recording find it; a new page goes where the fewest are. Nothing that is sent passes through here: what is handed over
is the connection itself. A process that dies is replaced; its pages' connections end with it, and they say so.
"""

import contextlib
import heapq
import os
import re
import selectors
import signal
import socket
import sys
import time
import traceback
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field

from workbench.errors import InputError
from workbench.viewer.patience import PATIENCE
from workbench.viewer.runs import settle
from workbench.viewer.share import Share

LONGEST = 4096
"""Bytes within which a first line says where a connection leads."""
AGAIN = 0.02
"""Seconds until a connection is looked at again that has not said all of it yet."""
SOON = 3.0
"""Seconds within which a page that was handed over is expected to open."""
START = 120.0
"""Seconds that a process may take to start."""
STEADY = 10.0
"""Seconds after which a process that dies is replaced at once."""
FAREWELL = 12.0
"""Seconds that processes have to end."""
MOST_WAITING = 2000
_PAGE = re.compile(rb"GET /(\?\S*)? HTTP")
_TOKEN = re.compile(rb"[A-Z]+ /(?:live\?(?:\S*&)?token=|scene/|recording/|files/)([0-9a-f]{2})[0-9a-f]{22}\b")


@dataclass(eq=False)
class _Server:
    """One of the processes, as seen from here."""

    number: int
    process: int
    channel: socket.socket
    began: float
    ready: bool = False
    pages: int = 0
    handed: deque[float] = field(default_factory=deque)

    def load(self, now: float) -> int:
        while self.handed and now - self.handed[0] > SOON:
            self.handed.popleft()
        return self.pages + len(self.handed)


class Front:
    """Accepts connections for several servers.

    Args:
        listener: Where it listens.
        servers: How many there are, at most 256.
        token: What others than those on this machine bring.
        work: Runs a server for a share, until that ends; called in a process of its own.

    Raises:
        InputError: If a process ends before it is ready; what is wrong with it has been told.
    """

    def __init__(self, listener: socket.socket, servers: int, token: str | None, work: Callable[[Share], None]):
        self._listener, self._token, self._work = listener, token, work
        self._selector = selectors.DefaultSelector()
        self._servers: dict[int, _Server] = {}
        self._missing: dict[int, float] = {}  # number of a process that is not there -> when it is to start
        self._waiting: dict[socket.socket, float] = {}  # connections that have said nothing -> since when
        self._later: list[tuple[float, int, socket.socket]] = []  # those that are looked at again, and when
        self._turn, self._starting = 0, True
        self._missing = dict.fromkeys(range(servers), 0.0)
        try:
            settle()  # what is there now is shared by all, as long as nobody writes into it
            self._start_missing(0.0)
            until = time.monotonic() + START
            while not all(server.ready for server in self._servers.values()):
                if time.monotonic() > until:
                    raise InputError(f"of {servers} processes not all have started within {START:.0f} seconds")
                self._look()
        except BaseException:
            self.stop()
            raise
        self._starting = False
        listener.listen(1024)
        listener.setblocking(False)
        self._selector.register(listener, selectors.EVENT_READ)

    def run(self) -> None:
        """Hand connections over, for ever."""
        while True:
            self._look()

    def stop(self) -> None:
        """End all processes, and every page with them."""
        self._listener.close()
        for connection in tuple(self._waiting):
            self._drop(connection)
        for server in self._servers.values():
            server.channel.close()
        until = time.monotonic() + FAREWELL
        for server in self._servers.values():
            while not _has_ended(server.process):
                if time.monotonic() > until:
                    os.kill(server.process, signal.SIGKILL)
                time.sleep(0.02)
        self._servers.clear()

    def _look(self) -> None:
        """Do what there is to do now, or wait for it for a little while."""
        patience = AGAIN if self._later else 0.5
        for key, _ in self._selector.select(patience):
            if isinstance(key.data, _Server):
                self._hear(key.data)
            elif key.fileobj is self._listener:
                self._accept()
            else:
                self._read(key.fileobj)  # type: ignore[arg-type]
        now = time.monotonic()
        while self._later and self._later[0][0] <= now:
            connection = heapq.heappop(self._later)[2]
            if connection in self._waiting:
                self._read(connection)
        while self._waiting and now - next(iter(self._waiting.values())) >= PATIENCE:
            self._drop(next(iter(self._waiting)))
        self._start_missing(now)

    # connections ----------------------------------------------------------------------------------------------------

    def _accept(self) -> None:
        for _ in range(64):
            try:
                connection, _ = self._listener.accept()
            except BlockingIOError:
                return
            except OSError:  # no more files: who has waited longest gives one back
                if self._waiting:
                    self._drop(next(iter(self._waiting)))
                time.sleep(AGAIN)
                return
            connection.setblocking(False)
            if len(self._waiting) >= MOST_WAITING:
                self._drop(next(iter(self._waiting)))
            self._waiting[connection] = time.monotonic()
            self._selector.register(connection, selectors.EVENT_READ)

    def _read(self, connection: socket.socket) -> None:
        """Hand a connection over as soon as its first line is there."""
        try:
            head = connection.recv(LONGEST, socket.MSG_PEEK)
        except BlockingIOError:
            return self._watch(connection)
        except OSError:
            return self._drop(connection)
        if not head:
            return self._drop(connection)
        if b"\n" not in head and len(head) < LONGEST:
            return self._wait(connection)
        server = self._server_for(head)
        if server is None:
            return self._drop(connection)
        try:
            socket.send_fds(server.channel, [b"."], [connection.fileno()])
        except BlockingIOError:  # it takes nothing now
            return self._wait(connection)
        except OSError:  # it has just died
            pass
        return self._drop(connection)

    def _watch(self, connection: socket.socket) -> None:
        if connection not in self._selector.get_map():
            self._selector.register(connection, selectors.EVENT_READ)

    def _wait(self, connection: socket.socket) -> None:
        """Look again in a while: what was said is left where it is, and would be told of at once."""
        if connection in self._selector.get_map():
            self._selector.unregister(connection)
        now = time.monotonic()
        again = now + min(1.0, max(AGAIN, now - self._waiting[connection]))  # more and more rarely
        heapq.heappush(self._later, (again, id(connection), connection))

    def _drop(self, connection: socket.socket) -> None:
        """Close a connection here; whoever it was handed to has it."""
        if connection in self._selector.get_map():
            self._selector.unregister(connection)
        self._waiting.pop(connection, None)
        connection.close()

    def _server_for(self, head: bytes) -> _Server | None:
        there = [server for server in self._servers.values() if server.ready]
        found = _TOKEN.match(head)
        if found is not None:
            number = int(found[1], 16)
            return next((server for server in there if server.number == number), None)
        self._turn += 1
        if not _PAGE.match(head):
            return there[self._turn % len(there)] if there else None
        now = time.monotonic()
        least = min(there, key=lambda server: (server.load(now), (server.number + self._turn) % 256), default=None)
        if least is not None:
            least.handed.append(now)
        return least

    # processes ------------------------------------------------------------------------------------------------------

    def _hear(self, server: _Server) -> None:
        try:
            said = server.channel.recv(16)
        except BlockingIOError:
            return
        except OSError:
            said = b""
        if said:
            server.ready, before, server.pages = True, server.pages, int(said)
            if server.pages > before and server.handed:
                server.handed.popleft()
            return
        self._bury(server)

    def _bury(self, server: _Server) -> None:
        """Let go of a process that has ended, and see to it that another takes its place."""
        self._selector.unregister(server.channel)
        server.channel.close()
        with contextlib.suppress(ProcessLookupError):
            os.kill(server.process, signal.SIGKILL)
        _, status = os.waitpid(server.process, 0)
        del self._servers[server.number]
        if self._starting:
            raise InputError(f"process {server.number + 1} ended before it was ready")
        now = time.monotonic()
        self._missing[server.number] = now if now - server.began > STEADY else now + 1.0
        why = f"signal {os.WTERMSIG(status)}" if os.WIFSIGNALED(status) else f"exit code {os.WEXITSTATUS(status)}"
        said = f"process {server.number + 1} ended ({why}) with {server.pages} open pages; another takes its place"
        sys.stderr.write(f"workbench: {said}\n")
        sys.stderr.flush()

    def _start_missing(self, now: float) -> None:
        for number in [number for number, due in self._missing.items() if due <= now]:
            del self._missing[number]
            self._start(number)

    def _start(self, number: int) -> None:
        ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        sys.stdout.flush()
        sys.stderr.flush()
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGTERM})
        process = os.fork()
        if not process:
            self._be(number, ours, theirs)
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        theirs.close()
        ours.setblocking(False)
        server = self._servers[number] = _Server(number, process, ours, time.monotonic())
        self._selector.register(ours, selectors.EVENT_READ, server)

    def _be(self, number: int, ours: socket.socket, theirs: socket.socket) -> None:
        """Be one of the processes, and nothing else: never returns."""
        code = 1
        try:
            signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl+C is for the one that hands over
            signal.signal(signal.SIGTERM, signal.SIG_DFL)
            signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT, signal.SIGTERM})
            port = self._listener.getsockname()[1]
            self._selector.close()
            for one in (self._listener, ours, *self._waiting, *(s.channel for s in self._servers.values())):
                one.close()
            self._work(Share(number, theirs, port, self._token))
            code = 0
        except InputError as error:
            sys.stderr.write(f"workbench: {error}\n")
        except BaseException:
            traceback.print_exc()
        finally:
            sys.stderr.flush()
            os._exit(code)


def _has_ended(process: int) -> bool:
    try:
        return os.waitpid(process, os.WNOHANG)[0] != 0
    except ChildProcessError:
        return True
