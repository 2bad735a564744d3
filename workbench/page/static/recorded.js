// Feeds the page from recorded runs: a published site, or a notebook. RECORDED says which there are:
// {root, runs: where files are, files: run -> file, open: the first run, titles, sweeps, answers}.
"use strict";

const source = {
  wanted: 0,           // number of the last wish to open something: the last click wins
  open_: null,         // {name, steps: the nodes of each step}
  decoded: new Map(),  // run -> {stage, steps}, the last few

  get sweep() { return RECORDED.sweeps.length > 0 && !document.body.classList.contains("alone"); },

  start() {
    shelf.client().then((client) => stage.put({ srcdoc: client }), (error) => page.say(error.message, "wrong"));
    addEventListener("hashchange", () => this.followed());
    this.followed() || page.face === "story" || this.open(RECORDED.open, null);
  },

  // opens what the address names; false where it names nothing that is here
  followed() {
    const alone = typeof embed !== "undefined", given = Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
    const { run = alone ? RECORDED.open : undefined } = given, step = alone ? embed.step() : given.step;
    if (run === undefined) return false;
    const name = Object.hasOwn(RECORDED.aliases, run) ? RECORDED.aliases[run] : run;
    if (!Object.hasOwn(RECORDED.files, name) && Object.hasOwn(RECORDED.moved ?? {}, run)) {
      location.replace(RECORDED.moved[run] + (step === undefined ? "" : `&step=${step}`));
      return true;
    }
    if (!Object.hasOwn(RECORDED.files, name)) {
      page.say(`This page has no run named ${run.slice(0, 40)}.`, "wrong");
      return false;
    }
    this.open(name, /^-?\d{1,7}$/.test(step ?? "") ? Number(step) : null);
    return true;
  },

  async open(name, step) {
    const wish = ++this.wanted;
    const run = name || this.open_?.name || RECORDED.open;
    stage.awaited();
    try {
      const data = await shelf.run(run);
      if (wish !== this.wanted) return;
      this.told(run, data, step ?? data.first);
      const scenes = await this.scenes(run, data);
      if (wish !== this.wanted) return;
      feed.open(scenes.stage);
      this.open_ = { name: run, steps: scenes.steps };
      this.show(page.k, 0);
    } catch (error) {
      if (wish !== this.wanted) return;
      page.say(error.message, "wrong");
      stage.arrived();
    }
  },

  told(run, data, step) {
    const { steps, things, series, charts, command, recording, end, places, idle } = data;
    const known = steps.length;
    const at = Math.min(known - 1, page.stepOf({ known, end, finished: true }, step));
    const told = { name: run, title: RECORDED.titles[run], steps, things, series, charts, known, finished: true, command, recording, end, places, idle };
    page.told({ ...told, id: run, query: this.query(run), pinned: sceneView.series() });
    sweeps.show(run);
    page.see(page.within(at));
  },

  // what an address begins with that comes back to a run
  query: (run) => (location.protocol === "about:" ? "" : `#run=${run}${typeof embed === "undefined" ? "" : embed.kept()}`),

  async scenes(run, data) {
    if (!this.decoded.has(run)) {
      const wire = new Wire(), { stage, steps } = wire.read(await unpacked(data.scene, await feed.ready));
      this.decoded.set(run, { stage, steps: wire.steps(steps) });
      if (this.decoded.size > 6) this.decoded.delete(this.decoded.keys().next().value);
    }
    return this.decoded.get(run);
  },

  seek(k) {
    const open = this.open_;
    if (!open || open.name !== page.run.name) return; // it is shown when it has come
    const at = k < 0 ? page.known() + k : Math.min(k, page.known() - 1);
    this.show(at, at - page.k);
  },

  // shows a step of the run that is open; `by` is how many steps it follows what is shown, 0 where it does not
  show(k, by) {
    const { steps } = this.open_;
    sceneView.step(steps[Math.min(k, steps.length - 1)], by);
  },

  recorded: (run) => (run.recording && RECORDED.runs !== null ? `${RECORDED.runs}${run.recording}` : null),
  alone: () => (RECORDED.runs === null ? null : new URL(`${RECORDED.runs}${RECORDED.files[page.run.name]}.html`, location.href).href),

  light(path) { sceneView.light(path); },
  pin() { sceneView.pin(); },
  theme(dark) { feed.theme(dark); },
  reset() { if (Object.hasOwn(RECORDED.files, "default")) this.open("default", null); },

  predict(question, given, { stay = false } = {}) {
    const text = atob(RECORDED.answers[question]);
    const { truth, right, why, replies, run, step } = JSON.parse(new TextDecoder().decode(Uint8Array.from(text, (c) => c.charCodeAt(0))));
    const good = given !== null && (typeof right === "string" ? given === right : Math.abs(given - right[0]) <= right[1]);
    const known = Array.isArray(replies) ? replies.find(([low, high]) => low <= given && given <= high)?.[2] : replies[given];
    article.answered({ question, given, right: good, truth, why, reply: good || given === null ? "" : known });
    if (!stay) this.open(run, step);
  },
};
