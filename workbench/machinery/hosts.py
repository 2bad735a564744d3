"""Where a server of this machine listens, and which hosts a browser may name that asks it.

On loopback it must name this machine, so that no page of the internet can get in by giving its own
name this machine's address (DNS rebinding).
"""

import ipaddress
import re
import socket

from workbench.errors import InputError

_HOST = re.compile(r"(\[[0-9a-f:.]+\]|[a-z0-9._-]+)(?::(\d{1,5}))?")


class Hosts:
    """The hosts under which a server that listens at `listens` is known; `local` if only here."""

    def __init__(self, listens: str):
        self.local = is_loopback(listens)
        own = socket.gethostname().lower()
        self._names = {"localhost", "127.0.0.1", "[::1]"} | (
            set() if self.local else {own, f"{own}.local"}
        )
        self._names.add(f"[{listens.strip('[]')}]" if ":" in listens else listens.lower())

    def know(self, host: str) -> bool:
        """Tell whether a browser that names this host has come to the right place."""
        name = name_in(host)
        if name is None:
            return False
        # an address means one machine
        return name in self._names or (not self.local and _is_address(name))


def listening(host: str, port: int) -> socket.socket:
    """Return a socket that listens.

    Raises:
        InputError: If the port is taken or may not be used.
    """
    if not 0 <= port < 65536:
        raise InputError(f"port {port}: a port is a whole number from 0 to 65535")
    made = socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET)
    try:
        made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        made.bind((host.strip("[]"), port))
    except OSError as error:
        made.close()
        if isinstance(error, PermissionError):
            raise InputError(
                f"port {port} needs more rights than this user has: choose one above 1023"
            ) from None
        if isinstance(error, socket.gaierror) or error.errno == 99:
            raise InputError(f"host {host!r} is no address of this machine") from None
        if error.errno == 98 or "in use" in str(error):
            free = "stop the other program, or choose another with --port (0 picks a free one)"
            raise InputError(f"port {port} is in use: {free}") from None
        raise InputError(f"cannot listen on {host}:{port}: {error.strerror or error}") from None
    return made


def name_in(host: str) -> str | None:
    """Return the name or address of what a browser names as host, in small letters; or None."""
    match = _HOST.fullmatch(host.lower())
    return None if match is None else match[1]


def is_loopback(host: str) -> bool:
    """Tell whether only this machine reaches what listens on a host."""
    try:
        return ipaddress.ip_address(host.strip("[]")).is_loopback
    except ValueError:
        return host.lower() == "localhost"


def _is_address(name: str) -> bool:
    try:
        return bool(ipaddress.ip_address(name.strip("[]")))
    except ValueError:
        return False
