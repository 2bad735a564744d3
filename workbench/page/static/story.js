// The story: which words are read, and so what stands on the stage. Two own it: the text, or the
// reader's hand. STORY says what each beat of a scene shows.
"use strict";

const READS_AT = { beside: 0.46, below: 0.42 };  // where one reads: a share of the height that is free
const SETTLES = 140;  // milliseconds after which a scroll has come to rest

const story = {
  scenes: [],    // sections, in order
  beats: [],     // {el, scene, key, place, play}
  here: null,    // the beat that is read
  scene: null,   // the scene it is in
  hand: false,   // whether the reader's hand owns the stage
  flying: false, // whether a jump is on its way
  goal: null,    // the scene of the last jump
  scroll: 0,     // where the words were when the workbench was opened

  start() {
    history.scrollRestoration = "manual";  // the address says where to be
    this.scenes = $$("#story .scene");
    this.beats = this.scenes.flatMap((scene) => this.beatsOf(scene));
    storyParts.build(this);
    for (const part of [storyAsk, storyChart, storyStage, storyWords]) part.start();
    page.listeners.push({
      told: (run) => storyStage.told(run), came: () => storyStage.pursue(),
      drawn: () => { storyStage.show(); storyStage.pursue(); },
      answered: (answer) => storyAsk.answered(answer), tidied: (inside) => storyParts.tidied(inside),
    });
    addEventListener("scroll", () => this.scrolled(), { passive: true });
    addEventListener("resize", () => this.scrolled());
    addEventListener("popstate", () => this.returned());
    addEventListener("load", () => this.address());
    keys.others.w = () => this.turn("story");
    keys.more.push(["W", "the story"]);
    const at = this.named(location.hash);
    if (page.face === "story") {
      if (at > 0) this.to(at, { now: true });
      this.follow();
    }
    document.fonts?.ready.then(() => this.measure());
  },

  beatsOf(scene) {
    const told = STORY.scenes.find((one) => one.name === scene.id)?.beats ?? [];
    let before = null;
    return $$("[data-beat]", scene).map((el) => {
      const place = told[Number(el.dataset.beat)] ?? told[0];
      const beat = { el, scene, place };
      beat.key = `${scene.id} ${JSON.stringify({ ...beat.place, from: undefined })}`;
      const words = el.matches("p") && !el.matches(".later") && before?.el.matches("p, .formula");
      if (words && before.key !== beat.key && place.from === undefined) el.classList.add("apart");
      before = beat;
      return beat;
    });
  },

  // the place of the words that an element stands in
  placeAt(el) {
    const own = el.closest("[data-beat]"), beat = this.beats.find((one) => one.el === own);
    const scene = el.closest(".scene");
    const place = beat?.place ?? this.beats.find((one) => one.scene === scene)?.place;
    const { from, ...rest } = place ?? this.here?.place ?? { run: "default", step: 0 };
    return rest;
  },

  named: (hash) => story.scenes.findIndex((scene) => `#${scene.id}` === hash),

  // a question that is answered stands where its run ended
  answered(form) {
    const beat = this.beats.find(({ el }) => el === form);
    if (!beat) return;
    const { from, ...place } = beat.place, { seen } = STORY.starts[form.dataset.question] ?? {};
    beat.place = { ...place, step: "stop", ...seen };
    beat.key = `${beat.scene.id} ${JSON.stringify(beat.place)}`;
    if (this.here === beat && !this.hand) storyStage.go(beat.place);  // words took it meanwhile
  },

  // reading ---------------------------------------------------------------------------------------

  // how much of the window's top the stage takes: none where it stands beside the words
  top() {
    const box = $("#side").getBoundingClientRect();
    return box.left > 20 ? 0 : box.height;
  },
  line() {
    const top = this.top();
    return top + (innerHeight - top) * (top ? READS_AT.below : READS_AT.beside);
  },

  scrolled() {
    if (page.face !== "story") return;
    clearTimeout(this.resting);
    const fast = Math.abs(scrollY - (this.y ?? scrollY)) > 0.35 * innerHeight;
    this.y = scrollY;
    this.resting = setTimeout(() => { this.flying = false; this.follow(); }, SETTLES);
    if (!fast && !this.flying) this.follow();  // while it flies past, nothing opens
  },

  // whether the reader, whose hand brought the stage here, has not scrolled since: words that come or go by themselves
  // do not take it
  stays() { return this.hand && scrollY === this.came; },

  // the beat that is read: the last whose top is above the reading line
  read() {
    const line = this.line(), shown = this.beats.filter(({ el }) => el.getClientRects().length);
    const end = scrollY + innerHeight >= document.documentElement.scrollHeight - 4 && scrollY > 0;
    if (end) return shown.at(-1);
    return shown.filter(({ el }) => el.getBoundingClientRect().top <= line).at(-1) ?? shown[0];
  },

  follow() {
    const now = page.face === "story" && this.read();
    if (!now) return;
    const stays = this.stays();
    if (now.scene !== this.scene) this.enter(now.scene);
    if (now === this.here) return;
    const before = this.here, order = this.beats;
    const down = !before || order.indexOf(now) > order.indexOf(before);
    before?.el.classList.remove("here");
    this.here = now;
    now.el.classList.add("here");
    if (stays) {
      this.hand = true;
      return void this.back();
    }
    if (before?.key === now.key) return;  // the same picture: what the hand did to it stays
    this.give({ down });
  },

  enter(scene) {
    this.scene = scene;
    this.hand = false;
    storyParts.mark(scene);
    storyAsk.entered(scene);
    this.address();
  },

  // another scene, or an open question, changes what the lines above take: read anew
  measure() {
    if (page.face !== "story") return;
    if (this.flying && this.goal) this.to(this.scenes.indexOf(this.goal), { now: true, push: false });
    else this.follow();
  },

  // the text puts the stage where it is read
  async put(beat, down) {
    storyStage.pause();
    this.plate();
    storyWords.unpick();
    const { from, ...place } = beat.place;
    const plays = from !== undefined && down && !isStill() && !beat.played;
    if (!plays) return void storyStage.go(place);
    beat.played = true;
    if (await storyStage.go({ ...place, step: from }) && this.here === beat && !this.hand)
      storyStage.play(beat.place.step, 9);
  },

  // the hand ----------------------------------------------------------------------------------

  // the reader's hand takes the stage until other words are read
  async took(act, { lasts = () => true } = {}) {
    const turn = this.turns = {};
    this.hand = true;
    storyStage.pause();
    this.plate();
    storyWords.unpick();
    this.back();
    await act?.();
    if (this.turns !== turn || lasts()) return;
    this.hand = false;
    this.back();
  },

  // the stage is the text's again
  give({ down = false } = {}) {
    this.turns = {};
    this.hand = false;
    this.back();
    if (this.here) this.put(this.here, down);
  },

  back() {
    $("#back").hidden = !this.hand;
    $("#plate").classList.toggle("full", this.hand);
  },

  // what stands above the scene: the title and the line of a what-if
  plate(title = "", line = "") {
    $("#plate b").textContent = title;
    $("#plate span").textContent = line;
  },

  // goes to a step of what is seen
  step(k) {
    const last = page.run?.finished ? page.known() - 1 : Infinity;
    return this.took(() => storyStage.go({ ...storyStage.place, from: undefined,
      step: Math.max(0, Math.min(last, k)) }));
  },

  act(verb) {
    const { place } = storyStage, coming = !storyStage.is(page.run, place);
    const k = coming && place?.step >= 0 ? place.step : page.k;
    if (verb === "next") return this.step(k + 1);
    if (verb === "back") return this.step(k - 1);
    if (verb !== "play") return;
    if (transport.playing) {
      storyStage.pause();
      return;
    }
    this.took(async () => {
      const end = storyStage.found(page.run, "stop"), whole = page.known() - 1;
      const past = page.k > (end ?? Infinity);
      const again = page.k === end || page.k === whole;
      if (again && !(await storyStage.go({ ...storyStage.place, step: 0 }))) return;
      storyStage.play(past ? whole : "stop", 9);
    });
  },

  // going through -------------------------------------------------------------------------------

  // jumps to a scene: its head as high as possible while its first picture still stands
  to(i, { now = false, push = true } = {}) {
    const scene = this.scenes[Math.max(0, Math.min(this.scenes.length - 1, i))];
    const head = $("h1, h2", scene) ?? scene, beats = this.beats.filter((one) => one.scene === scene);
    const seen = beats.filter(({ el }) => el.getClientRects().length);
    const next = seen.find((beat) => beat.key !== seen[0].key), top = this.top();
    const at = head.getBoundingClientRect().top;
    const space = next ? this.line() + 16 - (next.el.getBoundingClientRect().top - at) : 0;
    const high = Math.max(top + 26, Math.min(space, this.line() - 90));
    const y = scene === this.scenes[0] ? 0 : at + scrollY - high;
    if (push && !now && scene !== this.scene) history.pushState({ face: "story" }, "", this.url(scene));
    this.flying = true;
    this.goal = scene;
    scrollTo({ top: y, behavior: now || isStill() ? "instant" : "smooth" });
    head.tabIndex = -1;
    head.focus({ preventScroll: true });
    this.scrolled();
  },

  url(scene) {
    const query = new URLSearchParams(document.body.dataset.home === "live" ? location.search : "");
    for (const key of this.params()) query.delete(key);
    const first = scene === this.scenes[0], search = query.size ? `?${query}` : "";
    return `${location.pathname}${search}${first ? "" : `#${scene.id}`}`;
  },

  // the keys of an address that the workbench writes
  params: () => ["preset", "step", ...LESSON.knobs.map((knob) => knob.name),
    ...LESSON.files.map((file) => file.name), ...Object.keys(page.run?.params ?? {})],

  // the address names the scene; only once all is loaded, since a browser may scroll to it
  address() {
    if (page.face !== "story" || !this.scene || document.readyState !== "complete") return;
    history.replaceState({ face: "story" }, "", this.url(this.scene));
  },

  // Back and Forward
  returned() {
    const query = new URLSearchParams(location.search);
    const run = new URLSearchParams(location.hash.slice(1)).has("run");
    const face = run || this.params().some((key) => query.has(key)) ? "bench" : "story";
    if (face !== page.face) this.turn(face, { push: false });
    if (face === "bench") return void source.followed();
    this.to(Math.max(0, this.named(location.hash)), { now: true, push: false });
  },

  // turns to the other face, on the same run and step
  turn(face, { push = true } = {}) {
    if (face === page.face) return;
    storyStage.pause();
    if (face === "bench") this.scroll = scrollY;
    document.body.dataset.face = page.face = face;
    if (face === "bench") this.left(push);
    else this.entered(push);
    storyParts.mark(this.scene);
    feed.fit();
    $(face === "bench" ? "#to-story" : "#to-bench").focus({ preventScroll: true });
  },

  left(push) {
    storyStage.sent = storyStage.base = "";  // the workbench opens what it wants
    feed.lead(null);
    sceneView.hide = [];
    sceneView.swift = false;
    sceneView.again();
    const { run, k } = page;
    if (push && run?.query) history.pushState({ face: "bench" }, "", `${run.query}&step=${k}`);
    page.draw();
  },

  entered(push) {
    const { place } = storyStage, { run } = page;
    const known = place && storyStage.is(run, place) && storyStage.found(run, place.step) === page.k;
    if (!this.here) this.scroll = this.scrollOf(run?.name);
    scrollTo({ top: this.scroll, behavior: "instant" });
    this.came = scrollY;
    this.flying = false;
    storyStage.view = storyStage.view === null ? null : "";  // the camera may have been turned
    if (known) {
      sceneView.hide = [];
      storyStage.go(place);
    }
    const now = this.read();
    if (!this.here && now) this.settle(now);
    if (!known && run) {
      this.hand = true;
      storyStage.adopt();
      storyStage.pursue();
    }
    this.back();
    if (push) history.pushState({ face: "story" }, "", this.url(this.scene ?? this.scenes[0]));
    page.draw();
  },

  // words are read without the stage following them
  settle(beat) {
    this.here = beat;
    beat.el.classList.add("here");
    storyStage.place = { ...beat.place, from: undefined };
    this.enter(beat.scene);
  },

  // where the words of a run are
  scrollOf(name) {
    const beat = name && this.beats.find((one) => one.place.run === name);
    if (!beat || beat.scene === this.scenes[0]) return 0;
    return beat.scene.getBoundingClientRect().top + scrollY - 60;
  },

  // keys ------------------------------------------------------------------------------------------

  key(event) {
    const i = this.scenes.indexOf(this.scene), letter = event.key.toLowerCase();
    const shift = event.shiftKey && { n: "]", p: "[" }[letter];
    const acts = {
      "]": () => this.to(i + 1), "[": () => this.to(i - 1), n: () => this.act("next"),
      p: () => this.act("back"), k: () => this.act("play"), b: () => this.hand && this.give(),
      t: keys.others.t, w: () => this.turn("bench"), "?": keys.others["?"], escape: keys.others.escape,
    };
    const act = acts[shift || letter];
    if (!act) return;
    event.preventDefault();
    act();
  },

  keys: () => [["]  or  Shift + N", "next scene"], ["[  or  Shift + P", "scene before"],
    ["N", "next step"], ["P", "step back"], ["K", "play or pause"], ["B", "back to the text"],
    ["W", "the workbench: all knobs, on the same run"], ["T", "light or dark"],
    ["Enter, on a number", "to the slider of the steps"], ["?", "these keys"]],
};
