"""Arrays of npy and npz files: nothing in them is run, and nothing unpacks without bound."""

import io
import zipfile

import numpy as np

from workbench.data.files.formats import not_too_large
from workbench.errors import InputError


def read_arrays(content: bytes, name: str) -> dict[str, np.ndarray]:
    """Return the arrays of an npz file by name; that of an npy file is named by the empty text.

    Raises:
        InputError: If it is no such file, is damaged, unpacks to too much, or holds objects.
    """
    try:
        if zipfile.is_zipfile(io.BytesIO(content)):
            with zipfile.ZipFile(io.BytesIO(content)) as packed:
                not_too_large(sum(member.file_size for member in packed.infolist()), name)
        loaded = np.load(io.BytesIO(content), allow_pickle=False)
        if isinstance(loaded, np.ndarray):
            return {"": loaded}
        return {member: np.asarray(loaded[member]) for member in loaded.files}
    except InputError:
        raise
    except Exception:  # numpy, zipfile and zlib each raise their own kinds on what is damaged
        raise InputError(f"{name}: not readable as arrays of numpy") from None
