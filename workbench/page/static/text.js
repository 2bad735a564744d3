// The text of a run: every step's caption and numbers as a list, for screen readers, print and search.
"use strict";

const text = {
  told: null, // the run and the number of steps that are in the list

  start() {
    const box = $("#text");
    if (!box) return;
    box.addEventListener("toggle", () => this.show());
    let open = false;
    addEventListener("beforeprint", () => {
      open = box.open;
      box.open = true;
      this.fill();
      for (const part of $$("#story details")) part.open = true;
      for (const picture of $$(".still img")) picture.loading = "eager"; // some browsers load them too late for paper
    });
    addEventListener("afterprint", () => { box.open = open; });
  },

  // keeps the list up to date where it is open
  show() {
    const { run } = page;
    if (run && $("#text")?.open && this.told !== `${run.id} ${this.steps(run).length}`) this.fill();
  },

  steps: (run) => Object.keys(run.steps).map(Number),

  fill() {
    const { run } = page, box = $("#text");
    if (!run || !box) return;
    const known = this.steps(run);
    const missing = run.known - known.length;
    $("ol", box).replaceChildren(...known.map((k) => this.step(run, k)));
    $("p", box).textContent = `${run.title ? `${run.title}. ` : ""}${missing > 0
      ? `${known.length} of ${run.known} steps: those that were seen.` : `${run.known} steps.`}`;
    this.told = `${run.id} ${known.length}`;
  },

  step(run, k) {
    const numbers = run.series.filter((one) => (one.values[k] ?? null) !== null)
      .map((one) => `${one.name} ${measured(one.values[k], one.unit)}`).join(" · ");
    const go = element("button", { type: "button", textContent: k, title: `Go to step ${k}`, onclick: () => page.seek(k) });
    return element("li", {}, go, element("span", { textContent: run.steps[k].caption }), element("small", { textContent: numbers }));
  },
};

document.addEventListener("DOMContentLoaded", () => text.start());
