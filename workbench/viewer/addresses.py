"""Where a live server listens, and under which addresses browsers find it."""

import socket

from workbench.machinery.hosts import is_loopback

KEY = "key"
"""The name of the token in a link."""


class Doors:
    """Where browsers find a server.

    Args:
        host, port: Where it listens.
        token: What others than those on this machine bring; None where nothing must be brought.

    Attributes:
        address: Where a browser on this machine finds it.
        links: Where browsers on other machines find it, with the token that lets them in.
    """

    def __init__(self, host: str, port: int, token: str | None):
        self._token = token
        key = "" if token is None else f"/?{KEY}={token}"
        self.address = f"http://{'127.0.0.1' if host in ('0.0.0.0', '::', '') else addresses(host)[0]}:{port}{key}"  # noqa: E501
        self.links = (
            [] if is_loopback(host) else [f"http://{name}:{port}{key}" for name in addresses(host)]
        )

    def welcome(self) -> str:
        """Return what whoever started the server is told: where browsers find it, and who is let
        in.
        """
        if not self.links:
            return self.address
        notice = (
            "Everybody who reaches this machine is let in, and sees what is served, own files'"
            " contents included."
            if self._token is None
            else "Whoever has this link is let in; give it to nobody else:"
        )
        return "\n".join([notice, *self.links, "On this machine:", self.address])


def addresses(host: str) -> list[str]:
    """Return the hosts under which other machines may reach what listens on a host, as links write
    them.
    """
    if host not in ("0.0.0.0", "::", ""):
        return [f"[{host}]" if ":" in host else host]
    ips = dict.fromkeys([_outward(), *(str(info[4][0]) for info in _own_infos())])
    shown = [
        f"[{ip}]" if ":" in ip else ip for ip in ips if ip and not is_loopback(ip) and "%" not in ip
    ]
    return [ip for ip in shown if host != "0.0.0.0" or ":" not in ip] or [socket.gethostname()]


def _own_infos() -> list:
    try:
        return socket.getaddrinfo(socket.gethostname(), None, type=socket.SOCK_STREAM)
    except OSError:
        return []


def _outward() -> str:
    """Return this machine's address towards others; nothing is sent."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))  # an address that is kept for documents
            return str(probe.getsockname()[0])
        except OSError:
            return ""
