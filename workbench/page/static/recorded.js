// Feeds the page from recorded runs: a published site, or a notebook. RECORDED says which there are:
// {root, runs: where files are, files: run -> file, open: the first run, titles, sweeps, answers}.
"use strict";

const source = {
  path: "",            // what stands out
  wanted: 0,           // number of the last wish to open something: the last click wins
  open_: null,         // {name, data, nodes: the scene after each step}
  pinned: null,        // {nodes, ghosts, series} of the step that stands behind
  client: null,        // the promise of the window of viser's page
  decoded: new Map(),  // run -> its nodes, the last few

  get sweep() { return RECORDED.sweeps.length > 0 && !document.body.classList.contains("alone"); },

  start() {
    this.client = shelf.page().then(([before, after]) => {
      stage.put({ srcdoc: (before + after).replace(/<head>/, `<head>${feed.before}`) });
      return new Promise((found) => { // its window, once its program is there
        const look = () => stage.frame.contentWindow?.__viserZstdWasm ? found(stage.frame.contentWindow) : setTimeout(look, 30);
        look();
      });
    });
    this.client.catch((error) => page.say(error.message, "wrong"));
    addEventListener("hashchange", () => this.followed());
    this.followed() || this.open(RECORDED.open, null);
  },

  // opens what the address names; false where it names nothing that is here
  followed() {
    const { run, step } = Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
    if (run === undefined) return false;
    const name = Object.hasOwn(RECORDED.aliases, run) ? RECORDED.aliases[run] : run;
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
    $("#scene").setAttribute("aria-busy", "true");
    try {
      const data = await shelf.run(run);
      if (wish !== this.wanted) return;
      this.told(run, data, step ?? data.first);
      const nodes = await this.nodes(run, data);
      if (wish !== this.wanted) return;
      if (this.open_?.nodes !== nodes) feed.open(nodes.first);
      this.open_ = { name: run, data, nodes };
      this.show(page.k, 0);
    } catch (error) {
      if (wish === this.wanted) page.say(error.message, "wrong");
    }
    if (wish === this.wanted) $("#scene").removeAttribute("aria-busy");
  },

  told(run, data, step) {
    const { steps, things, series, charts, command, recording, end } = data;
    const known = steps.length, at = Math.max(0, Math.min(known - 1, step < 0 ? known + step : step));
    const told = { name: run, title: RECORDED.titles[run], steps, things, series, charts, known, finished: true, command, recording, end };
    page.told({ ...told, id: run, query: location.protocol === "about:" ? "" : `#run=${run}`, pinned: this.pinned?.series ?? null });
    sweeps.show(run);
    page.see(at);
  },

  async nodes(run, data) {
    if (!this.decoded.has(run)) {
      const steps = await viserfile.read(data.scene, await this.client);
      this.decoded.set(run, Object.assign(nodesOfSteps(steps), { first: steps[0] }));
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
    const nodes = this.open_.nodes[Math.min(k, this.open_.nodes.length - 1)];
    const wanted = this.path ? litNodes(nodes, this.path, feed.dark) : nodes;
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    feed.show(this.pinned ? withGhosts(wanted, this.pinned.ghosts) : wanted, { glide: Math.abs(by) === 1 && !still, next: by === 1 });
  },

  recorded: (run) => (run.recording && RECORDED.runs !== null ? `${RECORDED.runs}${run.recording}` : null),
  alone: () => (RECORDED.runs === null ? null : new URL(`${RECORDED.runs}${RECORDED.files[page.run.name]}.html`, location.href).href),

  light(path) {
    this.path = path;
    if (this.open_) this.show(page.k, 0);
  },

  reset() { if (Object.hasOwn(RECORDED.files, "default")) this.open("default", null); },

  // keeps the step that is shown behind the next ones, or lets it go
  pin() {
    const { run } = page, open = this.open_;
    if (!run || !open) return;
    const nodes = open.nodes[page.k];
    this.pinned = this.pinned ? null : { nodes, ghosts: ghostsOf(nodes, feed.dark), series: run.series };
    page.told({ id: run.id, pinned: this.pinned?.series ?? null });
    this.show(page.k, 0);
  },

  predict(question, given) {
    const text = atob(RECORDED.answers[question]);
    const { truth, right, why, replies, run, step } = JSON.parse(new TextDecoder().decode(Uint8Array.from(text, (c) => c.charCodeAt(0))));
    const good = given !== null && (typeof right === "string" ? given === right : Math.abs(given - right[0]) <= right[1]);
    const known = Array.isArray(replies) ? replies.find(([low, high]) => low <= given && given <= high)?.[2] : replies[given];
    article.answered({ question, given, right: good, truth, why, reply: good || given === null ? "" : known });
    this.open(run, step);
  },

  theme(dark) {
    feed.theme(dark);
    if (!this.open_ || !this.pinned) return;
    this.pinned.ghosts = ghostsOf(this.pinned.nodes, dark);
    this.show(page.k, 0);
  },
};
