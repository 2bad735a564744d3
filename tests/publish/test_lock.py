"""Two publishes never write into one folder at the same time; a dead one holds nobody up."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.publish.conftest import TINY
from workbench.errors import InputError
from workbench.publish import site
from workbench.publish.lock import LOCK, only_writer

ROOT = Path(__file__).resolve().parents[2]
HOLDER = (
    "import sys; from pathlib import Path; from workbench.publish.lock import only_writer\n"
    "with only_writer(Path(sys.argv[1])): print('held', flush=True); sys.stdin.read()"
)


@pytest.fixture
def holder(tmp_path):
    """A process that holds the folder until it is killed."""
    command = [sys.executable, "-c", HOLDER, str(tmp_path)]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, cwd=ROOT
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == b"held\n"
        yield process
        process.kill()


def test_a_second_publish_is_refused_and_a_dead_one_holds_nobody_up(holder, tmp_path, rendered):
    with pytest.raises(InputError, match=f"{tmp_path}: another publish is writing here"):
        site.publish(tmp_path, [TINY])
    assert rendered == []
    holder.kill()
    holder.wait()
    assert (tmp_path / LOCK).exists()
    with only_writer(tmp_path):
        pass
    assert not (tmp_path / LOCK).exists()


def test_a_file_of_that_name_with_something_in_it_stays(tmp_path):
    (tmp_path / LOCK).write_text("mine")
    with only_writer(tmp_path):
        pass
    assert (tmp_path / LOCK).read_text() == "mine"
