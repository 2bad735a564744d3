"""What the distances lesson says of its runs, decided from closed forms and by trying, apart from
its core.
"""

from lessons.distances.captions import caption
from tests.verdicts.distances.captions import CAPTIONS, right
from tests.verdicts.distances.texts import LINES, WHYS

__all__ = ["CAPTIONS", "LINES", "WHYS", "caption", "right"]
