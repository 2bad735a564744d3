"""What the pinhole lesson says of its camera and its mistakes, held against the camera written out
in plain numpy.
"""

from lessons.pinhole.captions import caption
from tests.verdicts.pinhole.captions import CAPTIONS, VALUES, right
from tests.verdicts.pinhole.lines import LINES
from tests.verdicts.pinhole.whys import WHYS

__all__ = ["CAPTIONS", "LINES", "VALUES", "WHYS", "caption", "right"]
