// The stage of the story. It shows a place: {run, step, knob, view, chart, hide}; the last wish
// wins. What it needs it asks of the page's source, so that it is the same live and on a site.
"use strict";

const isStill = () => matchMedia("(prefers-reduced-motion: reduce)").matches;

const storyStage = {
  place: null,    // what is wished for
  arrived: null,  // settles the promise of the wish
  sent: "",       // the run that was asked for last
  base: "",       // ... before a param of it was changed
  sought: "",     // the step that was asked for last
  view: null,     // the name of the camera that was put last
  refused: null,  // the id of a run that came instead of the one that was asked for
  token: null,    // of what plays
  gliding: 0,     // the frame request of the camera

  start() {
    new ResizeObserver(() => storyChart.show()).observe($("#story-chart"));
  },

  // goes to a place; resolves true when it is shown, false when another one is wished for first
  go(place, { glide = true } = {}) {
    this.arrived?.(false);
    this.arrived = null;
    this.place = { ...place, step: own(place.step) };
    sceneView.swift = !glide;
    this.hide(place.hide ?? []);
    clearTimeout(this.late);
    this.late = setTimeout(() => this.wait(true), 1000);
    return new Promise((resolve) => {
      this.arrived = resolve;
      this.pursue();
    });
  },

  wait(on) {
    if (!on) clearTimeout(this.late);
    $("#wait").hidden = !on;
  },

  hide(paths) {
    if (String(sceneView.hide) === String(paths)) return;
    sceneView.hide = paths;
    if (this.is(page.run, this.place)) sceneView.again();
  },

  // brings the page to the place: again whenever something has come
  pursue() {
    const { place } = this;
    if (page.face !== "story" || !place) return;
    this.ask(place);
    if (!this.is(page.run, place)) return;
    if (this.view === null) this.look(place.view);  // nothing is seen yet: the first picture is whole
    const { run } = page, k = this.found(run, place.step);
    if (k === undefined) return this.seek(run, -1);
    if (page.k !== k || !run.steps[k]) this.seek(run, k);
    if (page.k !== k || !run.steps[k] || !this.arrived) return;
    const arrived = this.arrived;
    this.look(place.view);  // with the scene, never before it
    source.flush?.();
    this.arrived = null;
    this.wait(false);
    this.show({ here: true });
    arrived(true);
  },

  // whether a step that has come is one to be seen: not one on the way to that which is wanted
  awaits(k) {
    const { place } = this, { run } = page;
    if (!place || typeof place.step !== "number" || place.step === k) return true;
    return this.is(run, place) && this.found(run, place.step) === k;
  },

  // a run is told: one that somebody else opened meanwhile is answered by asking again, once
  told(run) {
    const { place } = this, other = place && place.id === undefined && !this.is(run, place);
    const base = place?.knob && (!run.name || canonical(run.name) === canonical(place.run));
    if (other && !base && this.refused !== run.id) {
      this.refused = run.id;
      this.sent = this.base = "";
    }
    this.pursue();
  },

  // asks for the run of a place, once
  ask({ run, knob, id, step }) {
    if (id !== undefined) return;
    const wanted = JSON.stringify([run, knob ?? {}]);
    if (wanted === this.sent) return;
    this.sought = "";
    this.sent = wanted;
    if (!knob || this.base !== run) source.open(run, step);
    this.base = run;
    if (knob) source.change(knob);
  },

  seek(run, k) {
    const wanted = `${run.id} ${k}`;
    if (wanted === this.sought) return;
    this.sought = wanted;
    if (k < 0) source.seek(k);
    else page.seek(k);
  },

  // whether a run is that of a place
  is(run, { run: name, knob, id } = {}) {
    if (!run) return false;
    if (id !== undefined) return run.id === id;
    if (!knob) return canonical(run.name) === canonical(name);
    return Object.entries(knob).every(([key, value]) =>
      Math.abs((run.params?.[key] ?? NaN) - value) <= 1e-9 * (1 + Math.abs(value)));
  },

  // the index of a step of a run; undefined while it is not known
  found(run, step) {
    const k = page.stepOf(run, step);
    return k === undefined || !run.finished ? k : Math.min(k, run.known - 1);
  },

  // what the page shows now becomes the place: the workbench was here
  adopt() {
    const { run, k } = page;
    if (!run) return;
    const named = run.name && { run: run.name };
    this.place = { ...this.place, knob: undefined, run: this.place?.run, id: undefined, ...named,
      ...(named ? {} : { id: run.id }), step: k };
    sceneView.hide = this.place.hide ?? [];
    sceneView.again();
    this.sent = this.base = "";
    this.sought = "";
  },

  // playing ---------------------------------------------------------------------------------------

  // plays on to a step within so many seconds, or back to it where that is meant; resolves true when
  // it got there
  async play(to, seconds, { back = false } = {}) {
    this.pause();
    const token = this.token = {};
    if (isStill()) return this.go({ ...this.place, step: to });
    this.sign(true);
    await pausing(250);
    while (this.token === token) {
      const { run, k } = page, last = this.found(run, own(to));
      if (last !== undefined && (back ? k === last : k >= last)) break;
      if (token.last !== last) Object.assign(token, { last, k, began: performance.now() });
      const far = last === undefined ? 1 : last - token.k, spent = performance.now() - token.began;
      const left = Math.abs(far), way = Math.sign(far);
      const whole = Math.min(1000 * seconds, 650 * left);  // what is slow to come is passed over
      const due = last === undefined ? 1 : Math.ceil((left * (spent + 1)) / whole);
      const ahead = last === undefined ? due : Math.min(left, Math.max(way * (k - token.k) + 1, due));
      const next = last === undefined ? k + 1 : token.k + way * ahead;
      const rest = last === undefined ? 200 : (whole * ahead) / left - spent;
      const shown = this.go({ ...this.place, step: next });
      const [came] = await Promise.all([shown, pausing(Math.max(30, Math.min(650, rest)))]);
      if (!came) return this.ended(token, false);
    }
    return this.ended(token, this.token === token);
  },

  ended(token, whole) {
    if (this.token === token) this.pause();
    return whole;
  },

  pause() {
    this.token = null;
    this.sign(false);
  },

  sign(on) {
    if (transport.playing === on) return;
    transport.playing = on;
    transport.sign();
  },

  // the camera ------------------------------------------------------------------------------------

  // lets the eye glide where the view is another one; where a reader has turned it, it stays
  look(name = "") {
    if (name === this.view) return;
    const to = STORY.views[name] ?? (name ? null : feed.stage?.own);
    if (!to) return;
    const first = this.view === null;
    this.view = name;
    cancelAnimationFrame(this.gliding);
    if (first || isStill() || !feed.stage) return feed.lead(to);
    const from = seenFrom(feed.stage.camera), start = performance.now();
    const frame = (time) => {
      const part = Math.min(1, Math.max(0, (time - start) / 1100));
      feed.lead(part < 1 ? cameraBetween(from, to, quintic(part)) : to);
      if (part < 1) this.gliding = requestAnimationFrame(frame);
    };
    this.gliding = requestAnimationFrame(frame);
  },

  turned() { cancelAnimationFrame(this.gliding); },

  // what stands under the scene -------------------------------------------------------------------

  show({ here = false } = {}) {
    if (page.face !== "story" || !page.step()) return;
    if (!here && (!this.is(page.run, this.place) || !this.awaits(page.k))) return;  // on the way
    const { run, k } = page, end = this.found(run, "stop") ?? run.known - 1;
    const last = Math.max(1, k > end ? run.known - 1 : end);
    Object.assign($("#step"), { max: last, value: k });
    $("#step").setAttribute("aria-valuetext", run.steps[k].caption);
    this.marks(run, k, end, last);
    storyChart.show();
    storyWords.show();
  },

  // named places under the slider, and between them where in the run this is
  marks(run, k, end, last) {
    const ticks = storyWords.ticks(run), named = ticks ?? this.places(run, end, last);
    const said = JSON.stringify([run.id, k, named, last]);
    if (said === this.marked) return;
    this.marked = said;
    $("#marks").replaceChildren(...named.map(([at, name], i) => {
      const button = element("button", { type: "button", textContent: name,
        className: at === 0 ? "first" : i === named.length - 1 && at === last ? "last" : "",
        onclick: () => story.step(at) });
      button.style.left = `${(100 * at) / last}%`;
      if (at === k) button.setAttribute("aria-current", "true");
      return button;
    }));
    thin([...$("#marks").children]);
    const free = !ticks && !named.some(([at]) => at > 0.3 * last && at < 0.7 * last);
    const round = free && k > 0 && k < end && this.round(run, k, end);
    if (round) $("#marks").append(element("output", { textContent: round }));
  },

  // the places of a run that have a name of their own: few of them, or its two ends
  places(run, end, last) {
    const found = this.told(run).filter(([at, name], i, all) => at <= last &&
      !ENDS.has(name) && all.filter(([, other]) => other === name).length === 1);
    const inner = found.filter(([at]) => at > 0.12 * last && at < 0.88 * last).slice(0, 4);
    const names = [[0, "start"], ...inner];
    if (end === last || end < 0.8 * last) names.push([end, "stop"]);  // else its word has no room
    if (last > end) names.push([last, "other starts"]);
    return names.filter(([at], i) => i === 0 || at > 0).sort(([a], [b]) => a - b)
      .filter(([at], i, all) => i === 0 || at !== all[i - 1][0]);
  },

  told: (run) => run.places ?? STORY.places?.[run.name] ?? [],

  // "round 3 of 17: fit", where the names of the steps come round again
  round(run, k, end) {
    const all = this.told(run).filter(([at, word]) => at <= end && !ENDS.has(word));
    const name = all[0]?.[1];
    const now = all.filter(([at]) => at <= k).at(-1);
    if (!now) return "";
    const starts = all.filter(([, other]) => other === name).map(([at]) => at);
    if (starts.length < 2) return now[1];
    return `round ${starts.filter((at) => at <= k).length} of ${starts.length}: ${now[1]}`;
  },
};

// takes words away that would stand over others: the ends stay, of the others the first ones
function thin(words) {
  const boxes = new Map(words.map((word) => [word, word.getBoundingClientRect()]));
  const kept = [words[0], words.at(-1)];
  for (const word of words.slice(1, -1)) {
    const { left, right } = boxes.get(word);
    const free = (one) => boxes.get(one).right < left || right < boxes.get(one).left;
    if (kept.every(free)) kept.push(word);
    else word.remove();
  }
}

const ENDS = new Set(["start", "stop"]);  // names of places that every run has

// where a place names no step it is the first; "stop" is the end of the run itself, a negative one
// counts from the last, tries of other starts included
const own = (step) => (step === "start" ? 0 : step ?? 0);

// one name for runs of the same params
function canonical(name) {
  const presets = LESSON.presets ?? [], preset = presets.find((one) => one.name === name);
  if (name === "default" || !preset) return name;
  const params = JSON.stringify(preset.params);
  if (params === "{}") return "default";
  return presets.find((one) => JSON.stringify(one.params) === params).name;
}

const pausing = (ms) => new Promise((done) => setTimeout(done, ms));
const quintic = (t) => t * t * t * (t * (6 * t - 15) + 10);

// a camera as the reader left it: the eye where it is, looking as far as before
function seenFrom(camera) {
  const { position, wxyz } = labels.camera ?? {};
  if (!position || !wxyz) return camera;
  const far = Math.hypot(...camera.target.map((v, i) => v - camera.eye[i])), [w, x, y, z] = wxyz;
  const forward = [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)];
  return { ...camera, eye: position, target: position.map((v, i) => v + far * forward[i]) };
}

// a camera on the way, in spherical coordinates about what it looks at
function cameraBetween(from, to, part) {
  const mix = (a, b) => a + (b - a) * part, mixed = (a, b) => a.map((v, i) => mix(v, b[i]));
  const target = mixed(from.target, to.target), [a, b] = [from, to].map(polar);
  const round = ((b.round - a.round + 3 * Math.PI) % (2 * Math.PI)) - Math.PI;
  const steep = [a, b].some(({ up }) => Math.abs(up) > 1.5);
  const r = mix(a.r, b.r), up = mix(a.up, b.up), at = steep ? b.round : a.round + part * round;
  const flat = r * Math.cos(up);
  const eye = [flat * Math.cos(at), flat * Math.sin(at), r * Math.sin(up)];
  const upright = String(from.up) === "0,0,1" && String(to.up) === "0,0,1";
  return { target, up: upright ? to.up : mixed(from.up, to.up), fov: mix(from.fov, to.fov),
    eye: upright ? eye.map((v, i) => target[i] + v) : mixed(from.eye, to.eye) };
}

function polar({ eye, target }) {
  const [x, y, z] = eye.map((v, i) => v - target[i]), r = Math.hypot(x, y, z);
  return { r, up: Math.asin(z / r), round: Math.atan2(y, x) };
}
