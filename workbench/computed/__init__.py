"""A lesson computed in a browser: what a page's worker calls inside Pyodide.

The worker unpacks the archive that `archive.packed(lessons)` made into a folder on `sys.path`,
and calls `runner`. All values are plain and fit into JSON; a scene is bytes in the form of
`workbench.wire.packing`, which the page's `wire.js` reads. Texts are those that the live server
sends, so `page.told`, `page.came` and the exercise's report take them as they are::

    from workbench.computed.runner import open_lesson

    runner = open_lesson("icp")
    runner.about()            -> {"params": {...}, "versions": {"python", "numpy", "scipy"},
                                  "exercises": [{"name", "file", "starter", "preset", "title"},
                                                ...]}
    runner.run({"start_angle": 120.0})   -> {"params": {...}, "run": 3}
        # begins the run of these params; a name left out has its default, a number out of range
        # goes to the nearer end; InputError says what cannot be used, and nothing has changed
    runner.more(40.0)         -> bool    # computes for about so many milliseconds, one step at
                                         # least; True while there is more to compute
    runner.told()             -> {"tell": "run", "run": 3, "name", "params", "known", "finished",
                                  "end", "places", "idle", "mark", "called", "stopped", "command",
                                  "query", "from", "series", "charts", ...} or None
        # what is new of the run since it was told last, as the live server tells it: `series` only
        # where steps have come; `stopped` says why a run ended before its end; `mark` is the first
        # step where a student's run differs
    runner.step(12)           -> (head, scene): head is {"tell": "step", "run": 3, "k": 12,
                                  "step": {...}, "things": {...}}, scene is the bytes that the page
                                  lacks: 4 bytes of length, a head as JSON {"run", "k", "nodes",
                                  "kinds", "arrays", "stage"?, "fresh"?}, arrays
        # a negative step counts from the last known one; call it once per step that is shown, and
        # give every result to the page: what was sent once is not sent again
    runner.click(12, [x, y, z], [x, y, z])  -> {"field": value, ...}  # what a click in a step
                                         # sets: its ray's origin and direction; run() with them
    runner.use("align_rigid", text)      -> {"trouble": "", "name", "source": {"name", "html"}}
        # the student's function drives all runs from now on, with the reference's as ghost;
        # `trouble` says why it cannot, and nothing has changed then; an empty text gives the
        # lesson back. Begins no run: call run() after it. The page has to own a way to end this
        # worker: a function may never return
    runner.judge("align_rigid", text)    -> {"said", "mistake", "checks": [{"mark", "word",
                                  "promise", "points", "message"}, ...], "printed", "ran"}
        # as the page's `exercise.told({source, report})` takes a report

Errors of what a person gave are `workbench.errors.InputError` with one line for them.
"""
