// Knobs of a page that cannot compute: a param at the values whose runs are recorded. RECORDED.sweeps holds, for each,
// {label, unit, hint, values: what is shown, runs: the name of the run at each value}.
"use strict";

const sweeps = {
  rows: [], // [sweep, input, output]

  // the rows of the drawer
  made() {
    this.rows = RECORDED.sweeps.map((sweep) => {
      const unit = sweep.unit ? ` (${sweep.unit})` : "";
      const input = element("input", { type: "range", min: 0, max: sweep.values.length - 1, step: 1, title: sweep.hint });
      const shown = element("output");
      input.setAttribute("aria-label", `${sweep.label}${unit}`);
      input.addEventListener("input", () => {
        this.tell(sweep, input, shown);
        const atEnd = page.run && page.k === page.known() - 1;
        source.open(sweep.runs[input.value], atEnd ? -1 : page.k); // the same place in another run
      });
      return [sweep, input, shown];
    });
    const boxes = this.rows.map(([sweep, input, shown]) => element("fieldset", { className: "knob" },
      element("legend", { textContent: sweep.label, title: sweep.hint }), element("label", {}, element("span"), input, shown),
      element("p", { className: "hint", textContent: sweep.hint })));
    return [element("p", { className: "note", textContent: RECORDED.note }), ...boxes];
  },

  // sets every knob to the run that is open; one that this run is not of stands at the default's value
  show(run) {
    for (const [sweep, input, shown] of this.rows) {
      const at = sweep.runs.indexOf(run), usual = Math.max(0, sweep.runs.indexOf("default"));
      if (input !== document.activeElement || at >= 0) input.value = at < 0 ? usual : at;
      this.tell(sweep, input, shown);
    }
  },

  tell(sweep, input, shown) {
    shown.textContent = measured(sweep.values[input.value], sweep.unit);
    input.setAttribute("aria-valuetext", `${sweep.values[input.value]} ${sweep.unit}`.trim());
  },
};
