"""The one error whose message is written for the person at the keyboard."""


class InputError(ValueError):
    """Something a person gave cannot be used; the message is one line that says what and how to mend it.

    Commands print it and exit with code 2; a live page shows it as a red caption and goes on.
    """

    def __init__(self, message: str):
        super().__init__(" ".join(message.split()))


class AuthorError(InputError):
    """The code of a lesson or an exercise went wrong; the message names its file and line.

    Attributes:
        trace: The traceback, for whoever mends it.
    """

    def __init__(self, message: str, trace: str = ""):
        super().__init__(message)
        self.trace = trace
