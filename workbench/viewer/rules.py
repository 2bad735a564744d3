"""Who may talk to the live server: by the Host that a browser names, the Origin of the page it
shows, and a token.

A browser must name this machine (`workbench.machinery.hosts`). Where others are let in, they bring
a token: in the link at the first visit, in a cookie from then on. A page of another origin opens no
websocket and reads nothing, and no other site shows a page in a frame.
"""

import re
import secrets
from http.cookies import CookieError, SimpleCookie
from urllib.parse import parse_qsl, urlencode

from starlette.datastructures import Headers, MutableHeaders
from starlette.requests import HTTPConnection, Request
from starlette.responses import HTMLResponse, PlainTextResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from workbench.errors import InputError
from workbench.machinery.hosts import Hosts, name_in
from workbench.viewer.addresses import KEY

_PAGE = (
    "default-src 'none'; script-src 'self' 'nonce-{nonce}'; style-src 'self' 'unsafe-inline';"
    " img-src 'self' data: blob:; font-src 'self' data:; connect-src 'self'; frame-src 'self';"
    " form-action 'self'; base-uri 'none'; frame-ancestors 'self'"
)
_SCENE = (  # viser's client is one file with its scripts, workers and compiled decoders in it
    "default-src 'none'; script-src 'self' 'unsafe-inline' 'unsafe-eval' blob: data:; worker-src"
    " blob: data:; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self'"
    " data:; connect-src data: blob:; form-action 'none'; base-uri 'none'; frame-ancestors 'self'"
)
_SLASH = '<script>if (!location.pathname.endsWith("/")) location.pathname += "/";</script>'
_HEADERS = {
    "x-content-type-options": "nosniff",
    "x-frame-options": "SAMEORIGIN",
    "referrer-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
}


class Rules:
    """What is let in.

    Args:
        host: Where the server listens.
        open_to_all: Let everybody in who reaches it, without a token.
        behind: The public name of the server where it stands behind a proxy, with its port or
            without.

    Attributes:
        token: What must be brought, None where nothing must.

    Raises:
        InputError: If `behind` is no name of a host.
    """

    def __init__(self, host: str, *, open_to_all: bool = False, behind: str | None = None):
        if behind is not None and name_in(behind) is None:
            raise InputError(
                f"--behind {behind}: the name under which browsers find the server, such as"
                " class.example.org"
            )
        self._hosts = Hosts(host)
        self.behind = None if behind is None else behind.lower()
        self.token = None if self._hosts.local or open_to_all else secrets.token_urlsafe(12)

    def knows(self, host: str) -> bool:
        """Tell whether a browser that names this host has come to the right place."""
        return self._hosts.know(host) or (
            name_in(host) is not None and self._is_behind(host.lower())
        )

    def same_origin(self, origin: str, host: str) -> bool:
        """Tell whether a page of an origin is one that this server gave a browser that names this
        host.
        """
        scheme, _, name = origin.lower().partition("://")
        return scheme in ("http", "https") and (name == host.lower() or self._is_behind(name))

    def _is_behind(self, name: str) -> bool:
        return self.behind is not None and self.behind in (name, name.rpartition(":")[0])

    def refusal(self, asked: HTTPConnection) -> str | None:
        """Say why a request is refused, None where it is let in as far as Host and Origin say."""
        host = asked.headers.get("host", "")
        origin = asked.headers.get("origin")
        if not self.knows(host):
            return (
                "This server is not known under that name. Behind a proxy, start it with --behind"
                " NAME."
            )
        if origin is None and asked.scope["type"] == "websocket":
            return "A page says where it comes from."
        if origin is not None and not self.same_origin(origin, host):
            return "A page of another origin is not let in."
        if (
            asked.headers.get("sec-fetch-site") == "cross-site"
            and asked.headers.get("sec-fetch-mode") != "navigate"
        ):
            return "A page of another origin is not let in."
        return None

    def brings_token(self, asked: HTTPConnection, cookie: str) -> bool:
        """Tell whether a request brings the token in its cookie, where one is wanted."""
        if self.token is None:
            return True
        cookies: SimpleCookie = SimpleCookie()
        try:
            cookies.load(asked.headers.get("cookie", ""))
        except CookieError:
            return False
        return cookie in cookies and self._is_token(cookies[cookie].value)

    def _is_token(self, given: str) -> bool:
        return self.token is not None and secrets.compare_digest(
            given.encode(), self.token.encode()
        )

    def with_key(self, request: Request) -> str | None:
        """Return the address without the key of a request that brings the right one, None of any
        other.
        """
        given = parse_qsl(request.url.query[:4000], keep_blank_values=True)
        if request.method != "GET" or not any(
            name == KEY and self._is_token(value) for name, value in given
        ):
            return None
        rest = urlencode([(name, value) for name, value in given if name != KEY], safe=",")
        return f"?{rest}"


class RequestGate:
    """Stands before an application and lets in what the rules let in; answers carry what keeps
    browsers safe.

    Args:
        app: What is behind it.
        rules: Who may.
        cookie: The name of the cookie that holds the token; servers on one machine have cookies in
            common.
    """

    def __init__(self, app: ASGIApp, rules: Rules, cookie: str):
        self._app, self._rules, self._cookie = app, rules, cookie

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer, refuse, or pass on."""
        if scope["type"] not in ("http", "websocket"):
            return await self._app(scope, receive, send)
        asked = HTTPConnection(scope)
        refused = self._rules.refusal(asked)
        if scope["type"] == "websocket":
            if refused is not None or not self._rules.brings_token(asked, self._cookie):
                await receive()
                return await send({"type": "websocket.close", "code": 4403})
            return await self._app(scope, receive, send)
        scope["nonce"] = nonce = secrets.token_urlsafe(16)
        is_scene = scope["path"].startswith("/scene/")

        async def answer(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                headers.update(_HEADERS)
                headers["content-security-policy"] = (
                    _SCENE if is_scene else _PAGE.format(nonce=nonce)
                )
            await send(message)

        return await self._admitted(Request(scope, receive), refused)(scope, receive, answer)

    def _admitted(self, request: Request, refused: str | None) -> ASGIApp:
        if refused is not None:
            return PlainTextResponse(refused, 403)
        if self._rules.token is None:
            return self._app
        address = self._rules.with_key(request)
        if address is not None:
            answer: Response = RedirectResponse(address, 303, {"cache-control": "no-store"})
            answer.set_cookie(
                self._cookie,
                self._rules.token,
                # what stands before the last slash as the browser sees it: right behind any prefix
                path=None,
                httponly=True,
                samesite="lax",
                secure=Headers(scope=request.scope).get("x-forwarded-proto") == "https",
            )
            return answer
        if not self._rules.brings_token(request, self._cookie):
            return PlainTextResponse(
                "Open the link that whoever started this workbench was shown: it lets you in.", 403
            )
        return self._app


def page_response(request: Request, html: str) -> HTMLResponse:
    """Return a page whose own scripts, those that stand in it, may run.

    All addresses in it are relative to the folder that it is: one that was asked for without its
    last slash, behind a proxy's prefix, is asked for again with it.
    """
    nonce = request.scope["nonce"]
    html = html.replace("<head>", f"<head>{_SLASH}", 1)
    return HTMLResponse(
        re.sub(r"<script(?=[ >])", f'<script nonce="{nonce}"', html),
        headers={"cache-control": "no-store"},
    )
