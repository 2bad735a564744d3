// The page: what is open, which step is seen, and who is told of it.
"use strict";

const page = {
  run: null,  // {id, name, steps, things, series, charts, known, finished, played, seen, pinned}
  k: 0,
  from: 0,        // the steps that are shown: the whole run, but where somebody embeds a part of it
  to: Infinity,
  loops: false,   // whether playing begins anew at the end
  ending: false,  // whether the end of the run is wanted, and not yet known
  face: document.body.dataset.face ?? "bench",  // which of the two faces is seen: story or bench
  listeners: [],  // parts of the page that hear told(run), came(run, k, step, things), drawn(), ...

  // tells all that listen to it
  tell(verb, ...what) { for (const one of this.listeners) one[verb]?.(...what); },

  // whether this lesson has what a tool is for
  can: (tool) => tool !== "move" || LESSON.knobs.some((knob) => knob.by === "gizmo"),

  known() { return this.run ? this.run.known : 0; },
  last() { return Math.min(this.to, Math.max(0, this.known() - 1)); },
  within(k) { return Math.max(this.from, Math.min(this.to, k)); },
  step() { return this.run ? this.run.steps[this.k] : undefined; },

  open(name, step) {
    transport.pause();
    source.open(name, step);
  },

  // goes to a step; negative counts from the end
  seek(k) {
    this.ending = false;
    k = k < 0 && this.to === Infinity ? k : this.within(k < 0 ? this.known() + k : k);
    const run = this.run, at = k < 0 ? this.known() + k : Math.min(k, Math.max(0, this.known() - 1));
    source.seek(k < 0 || k >= this.known() ? k : at);
    if (run && run.steps[at] && (k >= 0 || run.finished)) this.see(at);
  },

  // the index of a step of a run: "stop" is its own end, a negative number counts from the end
  // of all, tries of other starts included; undefined while it is not known
  stepOf(run, step) {
    if (typeof step === "number" && step >= 0) return step;
    const last = run.finished ? run.known - 1 : undefined, own = step === "stop";
    const from = own ? run.end ?? last : last, back = own ? 0 : step + 1;
    return from === undefined ? undefined : Math.max(0, from + back);
  },

  // goes to the end of the run itself, as soon as it is known; from there to that of what other starts lead to
  end() {
    const end = this.run.end ?? -1;
    this.seek(this.k < end ? end : -1);
    this.ending = end < 0;
  },

  // what the source says of a run: new, or more of it
  told({ series, from, ...data }) {
    const { id } = data;
    if (!this.run || this.run.id !== id) {
      this.run = { steps: [], things: {}, series: [], charts: {}, played: -1, seen: false, pinned: null, ...data };
      this.k = 0;
      this.ending = false;
    } else Object.assign(this.run, data);
    if (this.ending && Number.isInteger(this.run.end)) this.seek(this.run.end);
    if (series) this.run.series = grown(this.run.series, series, from ?? 0);
    if (data.params) knobs.show(data);
    $("#pin").setAttribute("aria-pressed", String(Boolean(this.run.pinned)));
    this.draw();
    this.tell("told", this.run);
  },

  // a step that has come
  came(id, k, step, things) {
    if (!this.run || this.run.id !== id) return;
    Object.assign(this.run.things, things);
    this.run.steps[k] = step;
    if (this.face === "bench" || storyStage.awaits(k)) this.see(k);
    this.tell("came", this.run, k, step, things);
  },

  see(k) {
    const { run } = this;
    this.k = k;
    run.played = Math.max(run.played, k);
    if (run.finished && k === run.known - 1) run.seen = true;
    this.draw();
    this.remember();
  },

  draw() {
    transport.show();
    if (this.run) article.show(this.run, this.k);
    exercise.show(this.run);
    thisRun.show(this.run);
    const step = this.step();
    if (!step) return;
    // a story goes wrong on purpose
    this.say(step.caption, this.face === "story" && step.tone === "wrong" ? "info" : step.tone);
    stage.legend(this.run.things[step.legend] ?? "");
    if (this.face === "bench") panels.show();
    text.show();
    this.tell("drawn");
  },

  say(text, tone) {
    const caption = $("#caption");
    if (caption.textContent !== text) caption.textContent = text;
    caption.className = tone;
    caption.classList.toggle("long", caption.scrollHeight > caption.clientHeight); // smaller, where its room is too small
  },

  // the address is the place: a reload or a shared link comes back to it
  remember() {
    if (this.face === "story" || transport.playing || !this.run || !this.run.query) return;
    history.replaceState(null, "", `${this.run.query}&step=${this.k}${this.others()}`);
  },

  // keys of the address that are not ours are left alone
  others() {
    if (!this.run.query.startsWith("?")) return "";
    const ours = new Set(["lesson", "preset", "step", ...Object.keys(this.run.params), ...LESSON.files.map((one) => one.name)]);
    const theirs = [...new URLSearchParams(location.search)].filter(([key]) => !ours.has(key));
    return theirs.map(([key, value]) => `&${encodeURIComponent(key)}=${encodeURIComponent(value)}`).join("");
  },

  // shows the tools that the source has verbs for
  tools() {
    for (const tool of $$("[data-needs]")) tool.hidden = !tool.dataset.needs.split(" ").some((verb) => source[verb]) || !this.can(tool.id);
    if (!$("#move").hidden) $("#move").onclick = keys.others.h = () => {
      const on = $("#move").getAttribute("aria-pressed") !== "true";
      $("#move").setAttribute("aria-pressed", String(on));
      source.handles(on);
    };
    if (!$("#set").hidden) keys.others.s = () => knobs.toggle();
  },

  theme(dark) {
    document.documentElement.dataset.theme = dark ? "dark" : "light";
    source.theme?.(dark);
  },
};

// series with the values that have come from a step on; null where one has none
function grown(before, series, from) {
  return series.map((one) => {
    const values = (before.find((other) => other.path === one.path)?.values ?? []).slice(0, from);
    while (values.length < from) values.push(null);
    return { ...one, values: [...values, ...one.values] };
  });
}

document.addEventListener("DOMContentLoaded", () => {
  page.tools();
  article.start();
  knobs.start();
  for (const part of [exercise, thisRun, labels, handles]) part.start();
  for (const button of $$("[data-act]")) button.addEventListener("click", () => transport.act(button.dataset.act));
  $("#step").addEventListener("input", ({ target }) => {
    if (page.face === "story") return story.step(Number(target.value));
    transport.pause();
    page.seek(Number(target.value));
  });
  document.addEventListener("keydown", (event) => keys.pressed(event));
  const dark = () => document.documentElement.dataset.theme === "dark";
  const wanted = kept.get("dark") ?? matchMedia("(prefers-color-scheme: dark)").matches;
  const switched = () => { page.theme(!dark()); kept.set("dark", dark()); };
  $("#help").onclick = keys.others["?"] = () => panels.lay("Keys", keys.told());
  $("#theme").onclick = keys.others.t = switched;
  keys.others.i = () => source.pin?.();
  keys.others.r = () => source.reset?.();
  keys.others.escape = () => panels.enlarge(null);
  $("#pin").onclick = keys.others.i;
  if (typeof story !== "undefined") story.start();
  if (typeof dress !== "undefined") dress.start();
  source.start();
  page.theme(wanted);
});
