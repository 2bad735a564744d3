// Plays the runs of a lesson's page. Every run is a file of its own that calls `replay(name, data)`; viser's page, which
// draws the scene, is loaded once and given the data of one run at a time. Nothing is fetched, so pages open from disk.
"use strict";

const runs = {};      // name -> data, once its file has come
let shell = null;     // viser's page: [before its data, after its data]
let current = null;   // {name, data, k, playing, timer}

const $ = (selector, root = document) => root.querySelector(selector);

function replay(name, data) { runs[name] = data; }
function viserPage(before, after) { shell = [before, after]; }

function load(file) {
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = file;
    script.onload = resolve;
    script.onerror = () => reject(new Error(`${file} could not be loaded`));
    document.head.append(script);
  });
}

async function open(name, k) {
  pause();
  const player = $("#player");
  player.setAttribute("aria-busy", "true");
  player.parentElement.closest("#stage")?.scrollTo(0, 0);
  try {
    if (!shell) await load(player.dataset.root + "viser.js");
    if (!runs[name]) await load(`${player.dataset.runs}${name}.js`);
  } catch (error) {
    say(error.message, "wrong");
    return;
  }
  const data = runs[name];
  const last = data.steps.length - 1;
  current = { name, data, k: 0, playing: false, timer: 0, frame: null, focused: document.activeElement };
  document.querySelectorAll("[data-run]").forEach((button) =>
    button.setAttribute("aria-pressed", String(button.dataset.run === name)));
  $("#step").max = last;
  const beside = player.dataset.runs + name;
  $("#rrd").href = player.dataset.runs + data.recording;
  $("#rrd").download = data.recording;
  $("#embed").href = `${beside}.html`;
  $("#reopen").textContent = data.reopen;
  $("#iframe-line").textContent = `<iframe src="${new URL(`${beside}.html`, location.href)}" width="800" height="600"></iframe>`;
  showScene(data);
  show(Math.max(0, Math.min(last, k ?? data.first)));
  player.removeAttribute("aria-busy");
}

// opens the run of a button, which may be far below the replay
function bring(name) {
  if (matchMedia("(max-width:1100px)").matches) $("#player").scrollIntoView();
  return open(name);
}

// the 3D scene ------------------------------------------------------------------------------------------------------

function showScene(data) {
  const frame = document.createElement("iframe");
  frame.title = "3D scene of this step; drag to turn it, scroll to come nearer";
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  const page = shell[0] + data.scene + shell[1];
  frame.srcdoc = page.replace("{darkMode:false}", `{darkMode:${dark}}`);
  current.frame = frame;
  $("#scene").replaceChildren(frame);
  const wait = setInterval(() => {
    if (!current || current.frame !== frame) return clearInterval(wait);
    if (seek()) clearInterval(wait);
  }, 100);
}

// viser's player has a box with the time in seconds; step k stands from second k to second k + 1
function seek() {
  const inside = current.frame.contentDocument;
  const box = inside && $("input", inside);
  if (!box) return false;
  const setter = Object.getOwnPropertyDescriptor(inside.defaultView.HTMLInputElement.prototype, "value").set;
  setter.call(box, String(current.k + 0.5));
  box.dispatchEvent(new inside.defaultView.Event("input", { bubbles: true }));
  if (!inside.hasOwnProperty("ours")) { // the page's own controls drive it: its bar goes, our keys work in it too
    inside.ours = true;
    box.blur();
    const bar = box.closest(".mantine-Paper-root");
    if (bar) bar.style.display = "none";
    inside.addEventListener("keydown", (event) => {
      const verb = KEYS[event.key];
      if (!verb || event.key.startsWith("Arrow") || event.target.closest("input")) return;
      event.preventDefault();
      act(verb);
    });
    if (document.activeElement === current.frame) current.focused.focus({ preventScroll: true });
  }
  return true;
}

// one step ----------------------------------------------------------------------------------------------------------

function show(k) {
  const { data } = current;
  const last = data.steps.length - 1;
  current.k = Math.max(0, Math.min(last, k));
  const step = data.steps[current.k];
  say(step.caption, step.tone);
  $("#count").textContent = `Step ${current.k} of ${last}`;
  $("#step").value = current.k;
  $("#step").setAttribute("aria-valuetext", `Step ${current.k} of ${last}`);
  $("#legend").innerHTML = data.things[step.legend];
  showSeries(data);
  showThings(step.shown.map((number) => data.things[number]));
  seek();
}

function say(text, tone) {
  const caption = $("#caption");
  caption.textContent = text;
  caption.className = tone;
}

function showSeries(data) {
  const charts = new Map();
  for (const one of data.series) charts.set(one.chart, [...(charts.get(one.chart) ?? []), one]);
  $("#series").replaceChildren(...[...charts].map(([chart, lines]) => {
    const said = lines.filter((l) => l.values[current.k] !== null)
      .map((l) => `${l.name} ${number(l.values[current.k])} ${l.unit}`.trim()).join(" · ");
    const log = lines[0].log, axes = data.charts[chart];
    return plot({
      ...axes, title: [axes.head, said].filter(Boolean).join(": ") || chart, xLabel: "step",
      curves: lines.map((l) => ({
        name: l.name, color: l.color, kind: "line", marks: [], x: l.values.map((_, i) => i),
        y: l.values.map((v) => (log ? (v > 0 ? Math.log10(v) : null) : v)),
      })),
    }, [current.k]);
  }));
}

function showThings(things) {
  $("#things").replaceChildren(...things.map((thing) => {
    if (thing.kind === "html") return element("div", { innerHTML: thing.html });
    if (thing.kind === "curves") return plot(thing, thing.curves.flatMap((c) => c.marks));
    const figure = element("figure", {});
    figure.append(element("img", { src: thing.url, alt: thing.title, className: thing.width < 200 ? "pixels" : "" }),
      element("figcaption", { innerHTML: thing.bar || "" }));
    figure.prepend(element("figcaption", { textContent: thing.title }));
    return figure;
  }));
}

// curves ------------------------------------------------------------------------------------------------------------

const WIDTH = 340, HEIGHT = 170, LEFT = 52, RIGHT = 10, TOP = 8, BOTTOM = 34;

// the axes, their ticks and words come with the data: every home has the same
function plot({ title, xLabel, yLabel, curves, x: across, y: up }, marks) {
  const px = (x) => LEFT + ((x - across.low) / (across.high - across.low)) * (WIDTH - LEFT - RIGHT);
  const py = (y) => HEIGHT - BOTTOM - ((y - up.low) / (up.high - up.low)) * (HEIGHT - TOP - BOTTOM);
  const parts = [];
  up.ticks.forEach((y, i) => parts.push(
    `<line class="grid" x1="${LEFT}" x2="${WIDTH - RIGHT}" y1="${py(y)}" y2="${py(y)}"/>`,
    `<text x="${LEFT - 5}" y="${py(y) + 4}" text-anchor="end">${escape(up.words[i])}</text>`));
  across.ticks.forEach((x, i) => parts.push(
    `<text x="${px(x)}" y="${HEIGHT - BOTTOM + 14}" text-anchor="middle">${escape(across.words[i])}</text>`));
  for (const curve of curves) parts.push(...drawn(curve, px, py));
  for (const mark of marks) {
    parts.push(`<line class="mark" x1="${px(mark)}" x2="${px(mark)}" y1="${TOP}" y2="${HEIGHT - BOTTOM}"/>`);
  }
  parts.push(`<text x="${(LEFT + WIDTH) / 2}" y="${HEIGHT - 4}" text-anchor="middle">${escape(xLabel)}</text>`,
    `<text transform="translate(11 ${(HEIGHT - BOTTOM) / 2}) rotate(-90)" text-anchor="middle">${escape(yLabel)}</text>`);
  const box = element("figure", { className: "plot" });
  const key = curves.length > 1
    ? curves.map((c) => `<span><i style="background:${c.color}"></i>${escape(c.name)}</span>`).join("") : "";
  box.innerHTML = `<figcaption>${escape(title)}</figcaption>` +
    `<svg viewBox="0 0 ${WIDTH} ${HEIGHT}" role="img" aria-label="${escape(title)}">${parts.join("")}</svg>` +
    `<div class="wb-legend">${key}</div>`;
  return box;
}

function drawn(curve, px, py) {
  if (curve.kind === "dots") {
    return curve.x.map((x, i) => curve.y[i] === null ? "" : `<circle r="2.5" cx="${px(x)}" cy="${py(curve.y[i])}" fill="${curve.color}"/>`);
  }
  if (curve.kind === "bars") { // each stands on zero at its own x, as wide as the nearest two are apart
    const gaps = curve.x.slice(1).map((x, i) => x - curve.x[i]).filter((gap) => gap > 0);
    const half = 0.48 * (gaps.length ? Math.min(...gaps) : 1);
    return curve.x.map((x, i) => curve.y[i] === null ? "" :
      `<rect x="${px(x - half)}" width="${px(x + half) - px(x - half)}" y="${py(Math.max(curve.y[i], 0))}" ` +
      `height="${Math.abs(py(0) - py(curve.y[i]))}" fill="${curve.color}" fill-opacity="0.6"/>`);
  }
  const pieces = [[]];
  curve.x.forEach((x, i) => {
    if (curve.y[i] === null) pieces.push([]);
    else pieces.at(-1).push(`${px(x).toFixed(1)},${py(curve.y[i]).toFixed(1)}`);
  });
  return pieces.map((p) => p.length === 1
    ? `<circle r="2" cx="${p[0].split(",")[0]}" cy="${p[0].split(",")[1]}" fill="${curve.color}"/>`
    : `<polyline points="${p.join(" ")}" stroke="${curve.color}"/>`);
}

function number(value) {
  const said = Number(Number(value).toPrecision(3)), size = Math.abs(said);
  const text = size && (size < 1e-3 || size >= 1e6) ? said.toExponential().replace("e+", "e") : said.toLocaleString("en", { maximumFractionDigits: 6 });
  return text.replaceAll("-", "−");
}

// controls ----------------------------------------------------------------------------------------------------------

function play() {
  if (current.k >= current.data.steps.length - 1) show(0);
  current.playing = true;
  $("#play").textContent = "Pause";
  const tick = () => {
    if (current.k >= current.data.steps.length - 1) return pause();
    show(current.k + 1);
    current.timer = setTimeout(tick, 1000 / Number($("#speed").value));
  };
  current.timer = setTimeout(tick, 1000 / Number($("#speed").value));
}

function pause() {
  if (!current) return;
  clearTimeout(current.timer);
  current.playing = false;
  $("#play").textContent = "Play";
}

function act(verb) {
  if (!current) return;
  if (verb === "play") return current.playing ? pause() : play();
  pause();
  show({ first: 0, back: current.k - 1, next: current.k + 1, last: Infinity }[verb]);
}

const KEYS = {
  n: "next", ArrowRight: "next", p: "back", ArrowLeft: "back", " ": "play", k: "play", Home: "first", End: "last",
};

document.addEventListener("keydown", (event) => {
  const verb = KEYS[event.key];
  const typing = event.target.closest("input:not([type=range]), select, textarea, pre");
  const pressed = event.key === " " && event.target.closest("button, a, summary");
  if (!verb || typing || pressed || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  act(verb);
});

// questions ---------------------------------------------------------------------------------------------------------

function answer(form, given) {
  const { truth, right, why, run, step } = JSON.parse(form.dataset.answer);
  const said = given === null ? `The answer: ${truth}.`
    : (typeof right === "string" ? given === right : Math.abs(given - right[0]) <= right[1])
      ? `Right: ${truth}.` : `You said ${given}; the run says ${truth}.`;
  $("output", form).textContent = `${said} ${why}`;
  open(run, step);
}

document.addEventListener("submit", (event) => {
  const form = event.target.closest("form.question");
  if (!form) return;
  event.preventDefault();
  const by = event.submitter;
  if (by && by.value === "skip") return answer(form, null);
  const chosen = $("input[type=radio]:checked", form), typed = $("input[type=number]", form);
  if (chosen) answer(form, chosen.value);
  else if (typed && typed.value !== "") answer(form, Number(typed.value));
  else $("output", form).textContent = "Choose or type an answer first, or skip.";
});

// helpers -----------------------------------------------------------------------------------------------------------

function element(name, properties) { return Object.assign(document.createElement(name), properties); }

function escape(text) {
  return String(text).replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" }[c]));
}

document.addEventListener("DOMContentLoaded", () => {
  const player = $("#player");
  if (!player) return;
  document.querySelectorAll("[data-act]").forEach((button) => button.addEventListener("click", () => act(button.dataset.act)));
  document.querySelectorAll("[data-run]").forEach((button) => button.addEventListener("click", () => bring(button.dataset.run)));
  $("#step").addEventListener("input", (event) => { pause(); show(Number(event.target.value)); });
  open(player.dataset.open);
});
