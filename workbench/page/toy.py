"""The first toy of the course: two rabbits, one to be laid on the other, and the matrix of the
motion between them.
"""

from workbench.data.rabbit_outline import rabbit_outline

RING = 0.6
"""The radius of the ring that turns the rabbit, metres."""
START = (0.34, -0.12, 51.0)
"""Where orange stands at first: metres to the right, metres up, degrees counterclockwise."""
KEYS = "Arrow keys move the orange rabbit, comma and period turn it, Home starts again."


def toy_html() -> str:
    """Return the toy as HTML. `front.js` moves it; without a script it is a picture of where it
    starts.
    """
    x, y, turn = START
    outline = _path()
    return (
        '<figure class="toy" id="toy"><svg viewBox="-1.06 -0.86 2.24 1.68" role="application"'
        f' tabindex="0" aria-label="Two rabbits, orange and blue. {KEYS}" data-start="{x} {y}'
        f' {turn:g}"><path class="blue" d="{outline}"/><g class="it" transform="translate({x} {-y})'
        f' rotate({-turn:g})"><path class="grab" d="{outline}"/><circle class="ring"'
        f' r="{RING}"/><circle class="ring wide" r="{RING}"/><circle class="ring knob" cy="{-RING}"'
        f' r=".045"/></g><path class="link" d="M0 0L{x}'
        f' {-y}"/></svg><figcaption><table><caption>The motion of the orange'
        f' rabbit</caption><tbody>{_rows()}</tbody></table><p class="said"><b class="turned">Four'
        ' numbers</b> turn it, <b class="moved">two</b> move it. What are they when orange lies on'
        ' blue?</p><p class="home" hidden><b class="truth">It lies on blue.</b> Ones and zeros:'
        ' this matrix changes nothing.</p><p class="hide" role="status"></p></figcaption></figure>'
    )


def _path() -> str:
    """Return the outline as a path, y downwards as in pictures."""
    points = " ".join(f"{x:.3f} {-y:.3f}".replace("0.", ".") for x, y in rabbit_outline())
    return f"M{points}Z"


def _rows() -> str:
    """Return the rows of the matrix; the script fills in what moves."""
    kinds = (("turned", "turned", "moved"), ("turned", "turned", "moved"), ("", "", ""))
    fixed = (("", "", ""), ("", "", ""), ("0", "0", "1"))
    rows = (zip(row, texts, strict=True) for row, texts in zip(kinds, fixed, strict=True))
    return "".join(
        "<tr>" + "".join(f'<td class="{kind}">{text}</td>' for kind, text in row) + "</tr>"
        for row in rows
    )
