// The one line of controls under the scene, and playing.
"use strict";

const transport = {
  playing: false, timer: 0,

  show() {
    const last = page.last(), k = page.k;
    Object.assign($("#step"), { min: page.from, max: last, value: k });
    $("#step").setAttribute("aria-valuetext", `Step ${k} of ${last}`);
    $("#count").textContent = `${k} / ${last}${page.run && page.run.finished ? "" : "…"}`;
  },

  act(verb) {
    if (!page.run) return;
    if (page.face === "story") return story.act(verb);
    if (verb === "play") return this.playing ? this.pause() : this.play();
    this.pause();
    if (verb === "last") return page.end();
    page.seek({ first: page.from, back: Math.max(0, page.k - 1), next: page.k + 1 }[verb]);
  },

  play() {
    if (page.run.finished && page.k >= page.last()) page.seek(page.from);
    this.playing = true;
    this.sign();
    this.again(1 / this.speed());
  },

  pause() {
    clearTimeout(this.timer);
    this.playing = false;
    this.sign();
  },

  again(seconds) {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.tick(), 1000 * seconds);
  },

  tick() {
    if (!this.playing) return;
    const on = page.k < page.last();
    if (on || (page.loops && page.run.finished)) {
      page.seek(on ? page.k + 1 : page.from);
      this.again(1 / this.speed());
    } else if (page.run.finished) this.pause();
    else this.again(0.05); // the next step is still being computed
  },

  // steps per second: what was chosen, else what plays the run in about 25 s
  speed() {
    const chosen = Number($("#speed").value);
    return chosen || Math.min(8, Math.max(0.5, page.known() / 25));
  },

  sign() {
    const button = $('[data-act="play"]');
    $("path", button).setAttribute("d", this.playing ? "M4 3h3v10H4zM9 3h3v10H9z" : "M4 2.5v11L13.5 8z");
    button.setAttribute("aria-label", this.playing ? "Pause (K)" : "Play (K)");
  },
};

const keys = {
  verbs: { n: "next", ArrowRight: "next", p: "back", ArrowLeft: "back", " ": "play", k: "play", Home: "first", End: "last" },
  more: [],  // [key, what it does]: those that other parts of the page add
  numbered: [],  // what 1 to 9, 0, and these with Shift, do
  others: {},  // key -> function: what the other parts of the page add

  // what every key does, as rows of a table; those of what this home cannot do are not in it
  told() {
    if (page.face === "story") return keys.table(story.keys());
    const rows = [["N, →", "next step"], ["P, ←", "step back"], ["K, space", "play or pause"], ["Home, End", "first step, end of the run"],
      ["T", "light or dark"], ["Esc", "close what is enlarged"], ["?", "these keys"]];
    if (source.reset) rows.push(["R", "back to the default run"], ["I", "keep this run behind the next, or let it go"]);
    if (this.others.h) rows.push(["H", "handles in the scene"]);
    if (this.others.s) rows.push(["S", "knobs"]);
    return keys.table(rows.concat(this.more));
  },

  table: (rows) => element("table", {}, ...rows.map(([key, what]) =>
    element("tr", {}, element("th", { textContent: key }), element("td", { textContent: what })))),

  pressed(event) {
    const typing = event.target.closest("input:not(#step), select, textarea, pre");
    const chosen = event.key === " " && event.target.closest("button, a, summary");
    if (typing || chosen || event.ctrlKey || event.metaKey || event.altKey) return;
    const letter = event.key.length === 1, digit = letter && /^(?:Digit|Numpad)(\d)$/.exec(event.code);
    if (page.face === "story") return story.key(event);
    const verb = this.verbs[letter ? event.key.toLowerCase() : event.key]; // with Caps Lock too
    const other = digit ? this.numbered[(Number(digit[1]) || 10) - 1 + (event.shiftKey ? 10 : 0)] : this.others[event.key.toLowerCase()];
    if (!verb && !other) return;
    event.preventDefault();
    verb ? transport.act(verb) : other();
  },
};
