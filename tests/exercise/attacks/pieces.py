"""Beginnings and ends that several attacks share."""

SYSCALL = "import ctypes; call = ctypes.CDLL(None, use_errno=True).syscall; "
PIPE = "import fcntl, os; r, w = map(os.fdopen, os.pipe(), 'rw'); "
NUMPY_S = "import fcntl, os; f = open(np.__file__); "
RAISE = "fcntl.fcntl(r, 4, os.O_ASYNC | os.O_NONBLOCK); w.write('x'); w.flush(); return 1"
"""A pipe, a file that others read, and asking for a signal when there is something in the pipe."""
