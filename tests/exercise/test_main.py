"""The student's side of the pipe, called here: what it imports, prints, and tells of an error."""

import builtins
import sys

import numpy as np
import pytest

from workbench.exercise.child import main
from workbench.exercise.child.main import Allowed, Beside, Kept, load, told


@pytest.fixture(autouse=True)
def as_it_was(monkeypatch):
    """Take back what loading a file does to a process of its own."""
    monkeypatch.setattr(sys, "meta_path", list(sys.meta_path))
    monkeypatch.setitem(sys.modules, "student", None)


def test_of_an_error_inside_a_helper_the_innermost_line_of_the_file_is_told():
    source = "def helper(p):\n    return p[99]\n\ndef f(p):\n    return helper(p)\n"
    function = load(source, "my.py", "f", modules={})
    with pytest.raises(IndexError) as caught:
        function([])
    assert told(caught.value, "my.py") == {
        "error": "IndexError",
        "errors": ["IndexError", "LookupError", "Exception", "BaseException", "object"],
        "message": "list index out of range",
        "line": 2,
    }
    assert told(caught.value, "other.py")["line"] == 0


def test_an_exception_that_cannot_say_anything_says_nothing():
    class MuteError(Exception):
        def __str__(self):
            raise KeyError

    assert told(MuteError(), "my.py")["message"] == ""
    assert len(told(ValueError("x " * 999), "my.py")["message"]) == 500


def test_a_text_that_is_no_python_is_told_with_its_line():
    for source, line in (("x = 1\n\nx = = 2", 3), ("def f():\n    return 1 +", 2)):
        with pytest.raises(SyntaxError) as caught:
            load(source, "my.py", "f", modules={})
        assert told(caught.value, "my.py")["line"] == line
        assert told(caught.value, "other.py")["line"] == 0
    nowhere = SyntaxError("bad", ("my.py", None, None, None))
    assert told(nowhere, "my.py")["line"] == 0


def test_a_file_must_define_the_function():
    for source in ("x = 1", "f = 1"):
        with pytest.raises(NameError, match=r"^the file defines no function f$"):
            load(source, "my.py", "f", modules={})
    source = "def f():\n    return __file__, __name__"
    assert load(source, "my.py", "f", modules={})() == ("my.py", "student")


def test_modules_beside_the_file_are_imported_before_any_others():
    beside = {"zipapp": "import other\nname = other.name + __file__", "other": "name = 'x '"}
    source = "import zipapp\ndef f():\n    return zipapp.name"
    try:
        assert load(source, "my.py", "f", modules=beside)() == "x zipapp.py"
    finally:
        for name in beside:
            sys.modules.pop(name, None)
    source = "import __hello__\ndef f():\n    return __hello__.name"
    try:  # Python has one of that name in itself
        assert load(source, "my.py", "f", modules={"__hello__": "name = 'own'"})() == "own"
    finally:
        sys.modules.pop("__hello__", None)
    spec = Beside(beside).find_spec("other")
    assert spec is not None
    assert spec.origin == "other.py"
    assert Beside(beside).find_spec("another") is None


def test_a_page_gives_a_file_its_own_builtins():
    source = "def f(x):\n    return len(x)"
    with pytest.raises(NameError):
        load(source, "my.py", "f", modules={}, names={})([1])
    assert load(source, "my.py", "f", modules={}, names={"len": lambda x: 7})([1]) == 7
    assert load(source, "my.py", "f", modules={})([1]) == builtins.len([1])


def test_packages_are_found_in_their_folders_and_ours_never():
    place = np.__path__[0].removesuffix("/numpy")
    allowed = Allowed({"numpy": place})
    spec = allowed.find_spec("numpy")
    assert spec is not None
    assert spec.origin == np.__file__
    assert allowed.find_spec("scipy") is None
    for ours in ("workbench", "lessons"):
        with pytest.raises(ModuleNotFoundError, match=f"^{ours} cannot be used here: write the"):
            allowed.find_spec(ours)


def test_of_what_is_printed_the_first_is_kept(capfd, monkeypatch):
    kept = Kept(5)
    assert kept.writable()
    assert [kept.write(part) for part in (b"abc", memoryview(b"defgh"), b"ijk")] == [3, 5, 3]
    assert capfd.readouterr().out == "abcde"

    def full(descriptor, data):
        raise OSError

    kept = Kept(9)
    with monkeypatch.context() as patched:
        patched.setattr(main.os, "write", full)
        assert kept.write(b"abc") == 3
    assert kept.write(b"abc") == 3
    assert capfd.readouterr().out == ""


def test_what_stands_for_a_stream_is_flushed_if_it_can_be(monkeypatch):
    class Stream:
        flushed = 0

        def flush(self):
            self.flushed += 1

    last = Stream()
    monkeypatch.setattr(sys, "stdout", "no stream")
    monkeypatch.setattr(sys, "stderr", last)
    main.flush()
    assert last.flushed == 1
