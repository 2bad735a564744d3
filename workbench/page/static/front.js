// The front door: the first toy, light and dark, which chapter is in view, and what a lesson of the
// map builds on.
"use strict";

const theme = {
  set(dark) { document.documentElement.dataset.theme = dark ? "dark" : "light"; },
  turn() {
    const dark = document.documentElement.dataset.theme !== "dark";
    theme.set(dark);
    kept.set("dark", dark);
    loop.show();
  },
};
theme.set(kept.get("dark") ?? matchMedia("(prefers-color-scheme: dark)").matches);
$("#theme").onclick = theme.turn;
addEventListener("keydown", (event) => {
  if (event.key.toLowerCase() !== "t" || event.ctrlKey || event.metaKey || event.altKey) return;
  theme.turn();
});

// the toy: a rabbit, its motion (metres, radians), and the matrix of it
const toy = {
  svg: $("#toy svg"), x: 0, y: 0, turn: 0, held: null,
  KEYS: {
    ArrowLeft: [-1, 0, 0], ArrowRight: [1, 0, 0], ArrowUp: [0, 1, 0], ArrowDown: [0, -1, 0],
    ",": [0, 0, 1], ".": [0, 0, -1],
  },
  STEP: 0.02, TURN: Math.PI / 60,  // of a key: metres, radians
  NEAR: 0.045, ALONG: 0.09,        // this near orange clicks into place: metres, radians
  REACH: [0.8, 0.6],               // how far it may go, metres

  begin() {
    const [x, y, degrees] = this.svg.dataset.start.split(" ").map(Number);
    this.start = { x, y, turn: degrees * Math.PI / 180 };
    Object.assign(this, this.start);
    this.svg.addEventListener("pointerdown", (event) => this.took(event));
    // a finger on orange moves it, and scrolls beside it; touch-action is not heard within an SVG
    this.svg.addEventListener("touchstart", (event) => {
      if (this.part(event.target) && event.touches.length === 1) event.preventDefault();
    }, { passive: false });
    this.svg.addEventListener("pointermove", (event) => this.held && this.dragged(this.at(event)));
    for (const kind of ["pointerup", "pointercancel"])
      this.svg.addEventListener(kind, () => this.held && this.let());
    this.svg.addEventListener("keydown", (event) => this.key(event));
    this.draw();
  },

  // where a pointer is: metres, y upwards
  at({ clientX, clientY }) {
    const place = new DOMPoint(clientX, clientY).matrixTransform(this.svg.getScreenCTM().inverse());
    return [place.x, -place.y];
  },

  part: (target) => ["ring", "grab"].find((name) => target.classList.contains(name)),

  took(event) {
    const kind = this.part(event.target);
    if (!kind || event.button) return;
    event.preventDefault();
    this.svg.focus({ preventScroll: true });
    this.svg.setPointerCapture(event.pointerId);
    this.svg.classList.add("held");
    this.held = { kind, from: this.at(event), x: this.x, y: this.y, turn: this.turn };
  },

  dragged([x, y]) {
    const { kind, from } = this.held;
    if (kind === "grab") this.go(this.held.x + x - from[0], this.held.y + y - from[1], this.turn);
    else {
      const angle = (px, py) => Math.atan2(py - this.y, px - this.x);
      this.go(this.x, this.y, this.held.turn + angle(x, y) - angle(...from));
    }
  },

  let() {
    this.held = null;
    this.svg.classList.remove("held");
    this.click();
    this.tell();
  },

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { x, y, turn } = this.start, by = this.KEYS[event.key];
    if (!by && event.key !== "Home") return;
    event.preventDefault();
    if (by) this.go(this.x + by[0] * this.STEP, this.y + by[1] * this.STEP, this.turn + by[2] * this.TURN);
    else this.go(x, y, turn);
    clearTimeout(this.settling);
    this.settling = setTimeout(() => { this.click(); this.tell(); }, 500);
  },

  go(x, y, turn) {
    const within = (value, most) => Math.max(-most, Math.min(most, value));
    this.x = within(x, this.REACH[0]);
    this.y = within(y, this.REACH[1]);
    this.turn = Math.atan2(Math.sin(turn), Math.cos(turn));
    this.draw();
  },

  isHome(share = 1) {
    return Math.hypot(this.x, this.y) < share * this.NEAR && Math.abs(this.turn) < share * this.ALONG;
  },

  // what lies nearly on blue lies on it
  click() { if (this.isHome()) this.go(0, 0, 0); },

  draw() {
    const { x, y, turn } = this, c = Math.cos(turn), s = Math.sin(turn), home = this.isHome(1e-6);
    $(".it", this.svg).setAttribute("transform", `translate(${x} ${-y}) rotate(${-turn * 180 / Math.PI})`);
    $(".link", this.svg).setAttribute("d", home ? "" : `M0 0L${x} ${-y}`);
    this.svg.classList.toggle("done", home);
    const cells = $$("#toy td");
    [c, -s, x, s, c, y].forEach((value, i) => { cells[i].textContent = this.said(value); });
    $("#toy .said").hidden = home;
    $("#toy .home").hidden = !home;
  },

  said: (value) => value.toFixed(2).replace(/^-(0\.00)$/, "$1").replace("-", "−"),

  // for those who do not see it
  tell() {
    const degrees = Math.round(this.turn * 180 / Math.PI), { x, y } = this;
    $("#toy [role=status]").textContent = this.isHome(1e-6) ? "Orange lies on blue. The matrix is ones and zeros."
      : `Turned by ${this.said(degrees).replace(".00", "")}°, ${this.said(Math.abs(x))} to the ${x < 0 ? "left" : "right"}, `
        + `${this.said(Math.abs(y))} ${y < 0 ? "down" : "up"}.`;
  },
};
toy.begin();

// the chapter that is in view
const links = $$(".line a"), chapters = links.map((link) => $(link.getAttribute("href")));
function mark() {
  const line = innerHeight * 0.4;
  const here = chapters.findLastIndex((one) => one.getBoundingClientRect().top < line);
  links.forEach((link, i) => {
    if (i === here) link.setAttribute("aria-current", "true");
    else link.removeAttribute("aria-current");
  });
}
addEventListener("scroll", mark, { passive: true });
addEventListener("resize", mark);
mark();

// on the map: all that a lesson builds on, and nothing else, stands out while it is looked at
const boxes = new Map($$(".map a").map((box) => [box.dataset.name, box]));
function below(name, found = new Set()) {
  if (found.has(name) || !boxes.has(name)) return found;
  found.add(name);
  for (const need of boxes.get(name).dataset.needs.split(" ")) below(need, found);
  return found;
}
function light(name) {
  const found = name ? below(name) : new Set();
  $(".map svg")?.classList.toggle("lit", Boolean(name));
  for (const [own, box] of boxes) box.classList.toggle("on", found.has(own));
  for (const way of $$(".map [data-way]"))
    way.classList.toggle("on", way.dataset.way.split(" ").every((one) => found.has(one)));
}
for (const [name, box] of boxes) {
  for (const kind of ["pointerenter", "focus"]) box.addEventListener(kind, () => light(name));
  for (const kind of ["pointerleave", "blur"]) box.addEventListener(kind, () => light(null));
}

// a run as a loop, as light or dark as the page: only what is shown is loaded. It moves where the
// reader allows motion, and stops when they say so
const loop = {
  figure: $("#loop"), button: $("#loop button"), calm: matchMedia("(prefers-reduced-motion: reduce)"),
  show() {
    const [still, moving] = this.figure?.dataset[document.documentElement.dataset.theme].split(" ") ?? [];
    if (still) this.image.src = this.on ? moving : still;
  },
  play(on) {
    this.on = on;
    this.show();
    this.button.textContent = on ? "Pause" : "Play";
  },
  begin() {
    const unscripted = document.createElement("template");  // within it no picture is loaded
    unscripted.innerHTML = $("noscript", this.figure).textContent;
    this.image = unscripted.content.firstChild;
    this.button.hidden = false;
    this.button.onclick = () => this.play(!this.on);
    this.calm.onchange = () => this.play(!this.calm.matches);
    this.play(!this.calm.matches);
    this.figure.prepend(this.image);
  },
};
if (loop.figure) loop.begin();
