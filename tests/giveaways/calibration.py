"""Which sentences would tell the answers of the questions in the calibration lesson, as patterns;
case does not matter.
"""

GIVEAWAYS = {
    "flat-rms": (
        r"(same|no larger|as small an?) (rms|error|residual)",
        r"(rms|residual)[^.]*(stays|the same|does not (grow|change))",
        r"flat boards[^.]*fit (just )?as well",
        r"0\.27\d px",
    ),
    "noise-rms": (r"√2", r"0\.2[78]\d* px", r"two coordinates", r"times the noise"),
    "views": (
        r"two views (suffice|are enough|determine)",
        r"(from|with) (two|2) views",
        r"four (unknown|numbers)",
        r"four rows",
        r"five entries",
    ),
    "larger": (
        r"larger (print|board)[^.]*(distance|nearer|only t\b)",
        r"(square|size)[^.]*changes? (only|nothing)",
        r"no unit of length",
        r"scale[^.]*only (in )?the (poses|distances|translation)",
    ),
    "bent-error": (
        r"bow(ed)?[^.]*times its ±",
        r"(three|four|five|six|several|many) times (its|the) ±",
        r"± [^.]*(too small|optimistic|far too)",
    ),
}
INNOCENT = {"bent-error": r"over the picture|over half a per cent"}
