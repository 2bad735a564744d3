// A run alone, in a page of somebody else: which of its steps are shown, and how much stands around them. The address says it:
// #step=40, #from=10&to=30, #loop=1, #show=picture, joined by &. What it says is looked up here and held within the run.
"use strict";

const embed = {
  FORMS: { step: /^-?\d{1,7}$/, from: /^-?\d{1,7}$/, to: /^-?\d{1,7}$/, loop: /^[01]$/, show: /^(all|picture)$/ },

  start() {
    page.listeners.push({ told: (run) => this.told(run) });
    addEventListener("resize", () => page.run && this.fit(page.run));
  },

  // what the address says, without what is not understood
  asked() {
    const given = new URLSearchParams(location.hash.slice(1));
    const known = Object.keys(this.FORMS).filter((key) => this.FORMS[key].test(given.get(key) ?? ""));
    return Object.fromEntries(known.map((key) => [key, given.get(key)]));
  },

  // where it opens: the step, else the first of those that are shown
  step() {
    const { step, from } = this.asked();
    return step ?? from;
  },

  // what a reload has to find again
  kept() {
    const { step, ...others } = this.asked();
    return Object.entries(others).map(([key, value]) => `&${key}=${value}`).join("");
  },

  told(run) {
    const { from = "0", to = "-1", loop, show } = this.asked(), last = run.known - 1;
    const [low, high] = [from, to].map(Number).map((k) => Math.max(0, Math.min(last, k < 0 ? run.known + k : k)));
    Object.assign(page, low <= high ? { from: low, to: high } : { from: 0, to: last });
    page.loops = loop === "1";
    document.body.classList.toggle("picture", show === "picture");
    document.body.classList.toggle("loops", page.loops);
    this.fit(run);
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (page.loops && !still) transport.play(); // as a film that is embedded does; K and the button stop it
  },

  // the caption has room for the longest of the run: no words are cut, and the scene keeps its size from step to step
  fit(run) {
    const caption = $("#caption"), longest = run.steps.map((step) => step.caption).sort((a, b) => b.length - a.length).slice(0, 8);
    const probe = caption.cloneNode();
    Object.assign(probe.style, { position: "absolute", visibility: "hidden", minHeight: "0", width: `${caption.clientWidth}px` });
    probe.removeAttribute("id");
    probe.classList.add("caption");
    caption.after(probe);
    const high = Math.max(...longest.map((words) => { probe.textContent = words; return probe.offsetHeight; }));
    probe.remove();
    caption.style.minHeight = `${Math.min(high, Math.round(0.4 * innerHeight))}px`;
  },
};

document.addEventListener("DOMContentLoaded", () => embed.start());
