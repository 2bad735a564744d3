"""The command line: which command its words name, what they ask of it, and its exit code.

Adding a command is a matter of one function in `workbench.commands`, with a signature of options
and a docstring, and of its place in `COMMANDS`. Heavy modules (the viewer, the recorder) are
imported inside the functions that need them. Every InputError becomes one line on stderr and exit
code 2.
"""

import sys
from collections.abc import Callable, Sequence

from workbench.commands import course, making, watching
from workbench.commands.complaints import complain
from workbench.errors import InputError, not_among
from workbench.machinery.docstrings import summary_of
from workbench.machinery.version import __version__
from workbench.run.flags import parse

Command = Callable[..., int | None]
"""Does its work; returns the exit code where it is neither 0 nor, for an InputError, 2."""
COMMANDS: dict[str, Command] = {
    "list": watching.list_,
    "show": watching.show,
    "record": watching.record,
    "picture": watching.picture,
    "replay": watching.replay,
    "reopen": watching.reopen,
    "compare": watching.compare,
    "exercise": course.exercise,
    "check": course.check,
    "grade": course.grade,
    "handout": course.handout,
    "new": making.new,
    "validate": making.validate,
    "publish": making.publish,
}


def main(args: Sequence[str] | None = None) -> int:
    """Carry out a command line and return its exit code."""
    words = list(sys.argv[1:] if args is None else args)
    code = 0
    try:
        code = _carry_out(words) or 0
        sys.stdout.flush()
    except InputError as error:
        complain(str(error))
        return 2
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:  # the reader of our output, such as `head`, has had enough
        sys.stdout = None
        return 0
    except OSError as error:
        complain(f"{error.filename or 'standard output'}: {error.strerror or error}")
        sys.stdout = None
        return 2
    except SystemExit:  # after --help
        return 0
    return code


def _carry_out(words: list[str]) -> int | None:
    if words == ["--version"]:
        sys.stdout.write(f"{__version__}\n")
    elif not words or words[0].startswith("-"):
        return parse(watching.serve, words, "workbench", description=_overview())()
    elif words[0] not in COMMANDS:
        raise InputError(f"no command is named {words[0]!r}; {not_among(words[0], COMMANDS)}")
    else:
        function = COMMANDS[words[0]]
        return parse(
            function, words[1:], f"workbench {words[0]}", description=function.__doc__ or ""
        )()
    return None


def _overview() -> str:
    lines = [f"  {name:<9} {summary_of(function)}" for name, function in COMMANDS.items()]
    head = (
        "Watch, touch, record and grade the algorithms of 3D vision. Without a command: "
        + (watching.serve.__doc__ or "").lower()
    )
    return "\n".join(
        [head, "", "commands:", *lines, "", "`workbench COMMAND --help` says more of each."]
    )
