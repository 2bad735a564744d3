// Knobs of a page that cannot compute: a param at the values whose runs are recorded. RECORDED.sweeps holds, for each,
// {label, unit, hint, values: what is shown, runs: the name of the run at each value, places: for every run of the page
// where the dial stands and what it says}.
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
      input.addEventListener("input", () => this.go(sweep, input, shown));
      // a run that is not on the dial stands at the value next to its own: that one can be chosen too, though nothing moves
      for (const kind of ["click", "keyup"]) input.addEventListener(kind, ({ key = "" }) => /^$|Arrow|Home|End|Page/.test(key) && this.go(sweep, input, shown));
      return [sweep, input, shown];
    });
    const boxes = this.rows.map(([sweep, input, shown]) => element("fieldset", { className: "knob" },
      element("legend", { textContent: sweep.label, title: sweep.hint }), element("label", {}, element("span"), input, shown),
      element("p", { className: "hint", textContent: sweep.hint })));
    return [element("p", { className: "note", textContent: RECORDED.note }), ...boxes];
  },

  // opens the run at the value where the dial stands, at the same place
  go(sweep, input, shown) {
    const run = sweep.runs[input.value];
    if (run === (this.asked ?? page.run?.name)) return;
    this.asked = run;
    this.tell(sweep, input, shown, sweep.values[input.value]);
    source.open(run, page.run && page.k === page.known() - 1 ? -1 : page.k);
  },

  // sets every knob to the run that is open
  show(run) {
    this.asked = null;
    for (const [sweep, input, shown] of this.rows) {
      const [at, said] = sweep.places[run];
      input.value = at;
      this.tell(sweep, input, shown, said);
    }
  },

  tell(sweep, input, shown, said) {
    shown.textContent = Number.isNaN(Number(said)) ? said : measured(said, sweep.unit);
    input.setAttribute("aria-valuetext", `${said} ${sweep.unit}`.trim());
  },
};
