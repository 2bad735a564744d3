"""What a class handed in is found, bounded, and named, before anything of it runs."""

import pytest

from workbench.errors import InputError
from workbench.exercise.submission import MOST_BYTES, content, submission
from workbench.exercise.submissions import HandIn, handed_by, handed_in, with_roster


def write(folder, *names: str, text: str = "x = 1\n"):
    for name in names:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder


def test_a_student_hands_in_200_files_and_8_megabytes(tmp_path):
    many = handed_by("ada", write(tmp_path / "many", *(f"f{k:03}.py" for k in range(223))))
    assert list(many.files) == [f"f{k:03}.py" for k in range(200)]
    assert [file for file, _ in many.troubles] == [f"f{k}.py" for k in range(200, 220)]
    assert many.troubles[0][1] == "f200.py: not read; a student may hand in 200 files, 8 MB"
    names = [f"{letter}.py" for letter in "abcdefghij"]
    large = handed_by("ada", write(tmp_path / "large", *names, text="#" * MOST_BYTES))
    assert list(large.files) == names[:8]
    assert [file for file, _ in large.troubles] == names[8:]


def test_a_file_is_read_up_to_a_megabyte(tmp_path):
    path = tmp_path / "a.py"
    path.write_bytes(b"#" * MOST_BYTES)
    assert len(content(path)) == MOST_BYTES == 1 << 20
    path.write_bytes(b"#" * (MOST_BYTES + 1))
    with pytest.raises(InputError, match=r"^a\.py: more than 1 MB$"):
        content(path)
    with pytest.raises(InputError, match=r"cannot be read as text \(No such file"):
        content(tmp_path / "none.py")


def test_what_is_not_read_is_named_up_to_five(tmp_path):
    write(tmp_path / "in", *(f"photo{k}.png" for k in range(7)), "week/a.ipynb", ".hidden", "b.PY")
    write(tmp_path / "in", "__pycache__/c.py", ".git/d.py")
    hand_in = handed_by("ada", tmp_path / "in")
    assert sorted(hand_in.files) == ["b.PY", "week/a.ipynb"]
    named = ", ".join(f"photo{k}.png" for k in range(5))
    assert hand_in.note == f"not read, since neither .py nor .ipynb: {named} and 2 more"
    for k in (5, 6):
        (tmp_path / "in" / f"photo{k}.png").unlink()
    assert handed_by("ada", tmp_path / "in").note.endswith("photo4.png")


def test_in_a_folder_of_a_class_each_name_is_a_student(tmp_path):
    write(tmp_path, "ada.py", "bob.ipynb", "kim/a.py", "notes.txt", "max.tar.gz", "sue.py.txt")
    write(tmp_path, "kim.zip", "ada.zip", "bob.rar", ".git/a.py", "__pycache__/b.py", "out/c.py")
    (tmp_path / "lea").mkdir()
    hand_ins = handed_in(tmp_path, tmp_path / "out")
    assert sorted(hand_ins) == ["ada", "bob", "kim", "lea", "max", "sue"]
    assert {name: list(hand_in.files) for name, hand_in in hand_ins.items() if hand_in.files} == {
        "ada": ["ada.py"],
        "bob": ["bob.ipynb"],
        "kim": ["a.py"],
    }
    unread = "not read: unpack it, or save it as a .py file or a notebook"
    assert hand_ins["max"].troubles == (("max.tar.gz", f"max.tar.gz: {unread}"),)
    assert hand_ins["sue"].troubles == (("sue.py.txt", f"sue.py.txt: {unread}"),)
    assert hand_ins["lea"].troubles == (("", "the folder holds no .py file and no notebook"),)
    assert "out" in handed_in(tmp_path)


def test_two_of_one_name_are_both_named(tmp_path):
    hand_ins = handed_in(write(tmp_path, "ada.py", "ada.ipynb", "ada/my.py"))
    named = "ada.ipynb, my.py, ada.py"
    message = f"two things here are named ada ({named}): leave one of them"
    assert hand_ins == {"ada": HandIn("ada", {}, ((named, message),))}


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("ada\nbob\nada\n", ["ada", "bob"]),
        ("id;name;mail\n1; Bob ;x\n2;ada;y\n\n3;;z\n4\n", ["Bob", "ada"]),
        ("mail,login\nx,ada\n", ["ada"]),
        ("x\temail\n1\tada@b.c\n", ["ada@b.c"]),
    ],
)
def test_a_roster_s_first_row_may_say_where_the_names_are(tmp_path, text, names):
    (tmp_path / "roster.csv").write_text(text)
    assert list(with_roster({}, tmp_path / "roster.csv")) == names


def test_a_roster_finds_its_students_whatever_their_capitals(tmp_path):
    (tmp_path / "roster.csv").write_text("Ada\nBob\n")
    ada = HandIn("ada", {"a.py": b""})
    eve = HandIn("eve", {"b.py": b""}, note="late")
    hand_ins = with_roster({"eve": eve, "ada": ada}, tmp_path / "roster.csv")
    assert [(hand_in.student, hand_in.note) for hand_in in hand_ins.values()] == [
        ("ada", ""),
        ("Bob", ""),
        ("eve", "late; not in the roster"),
    ]
    for text, message in ((b"", "names no student"), (b"\xff\xfe", "not UTF-8")):
        (tmp_path / "roster.csv").write_bytes(text)
        with pytest.raises(InputError, match=message):
            with_roster({}, tmp_path / "roster.csv")


class Reads:
    """Reads files of which each imports what its text names."""

    def read(self, file: str, content: bytes) -> dict:
        statement = {"binds": ["f"], "reads": ["g"], "defines": True, "runs": False}
        return {
            "source": content.decode(),
            "said": ["match"],
            "defines": ["f"],
            "imports": content.decode().split(),
            "parts": [statement | {"uses": [["numpy", 3]]}],
        }


def test_modules_beside_a_file_are_read_with_it_up_to_twenty():
    files = {"a.py": b"b a", "b.py": b"a c", **{f"m{k}.py": b"none" for k in range(30)}}
    given = submission("my.py", b"numpy a", files.get, reader=Reads())
    assert given.modules == {"a": "b a", "b": "a c"}
    assert (given.file, given.source, given.said, given.defines) == (
        "my.py",
        "numpy a",
        ("match",),
        frozenset("f"),
    )
    assert given.parts == given.extra_files["a"]
    assert given.parts[0].uses == (("numpy", 3),)
    many = " ".join(f"m{k}" for k in range(30)).encode()
    assert list(submission("my.py", many, files.get, reader=Reads()).modules) == [
        f"m{k}" for k in range(20)
    ]


def test_a_folder_that_is_named_like_an_archive_is_a_folder(tmp_path):
    (tmp_path / "ada.zip").mkdir()
    (tmp_path / "ada.zip" / "my_match.py").write_text("x = 1\n")
    ((name, handed),) = handed_in(tmp_path).items()
    assert name == "ada.zip"
    assert list(handed.files) == ["my_match.py"]
    assert handed.troubles == ()
