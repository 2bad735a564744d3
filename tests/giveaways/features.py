"""Which sentences would tell the answers of the questions in the features lesson, as patterns; case
does not matter.
"""

GIVEAWAYS = {
    "radius": (r"7 cm[^.]*(hardly any|few|wrong)", r"almost flat"),
    "inwards": (
        r"(hardly any|few|none|five|ten) (matches )?(pass|are left|stay)",
        r"change (their|the) signs?",
        r"inwards[^.]*nothing in common",
    ),
    "ring": (
        r"vase[^.]*(cannot|never|not) (come|be found)",
        r"no descriptor can tell",
        r"vase[^.]*wrong",
    ),
    "thirty": (r"30°[^.]*(hardly any|few|none|wrong)", r"patch(es)? (fail|do not survive)"),
}
