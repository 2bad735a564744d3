// The one chart of the story. What is in it comes with the step; here it is laid out, its mark
// rolls to its new place, and the hand drags that mark or puts a flag.
"use strict";

const storyChart = {
  flag: null,        // where the reader put a flag, on the x axis; null where there is none
  put: null,         // what hears of a flag that is put into the chart
  seen: new Map(),   // name of a plot -> the stretches of its x axis that have been visited
  last: null,        // {run, name, x}: where the mark was
  rolled: new Map(), // mark -> where it is drawn
  rolling: 0,
  at: null,          // the layout of the plot that is shown
  held: false,

  start() {
    const figure = $("#story-chart");
    figure.addEventListener("pointerdown", (event) => {
      if (!this.drags() || event.button) return;
      this.held = true;
      figure.setPointerCapture(event.pointerId);
      figure.classList.add("held");
      this.dragged(event);
    });
    figure.addEventListener("pointermove", (event) => this.held && this.dragged(event));
    for (const end of ["pointerup", "pointercancel"]) figure.addEventListener(end, () => {
      this.held = false;
      figure.classList.remove("held");
    });
  },

  // whether a hand can do something here: put a flag, or move the mark
  drags() {
    return Boolean(this.at) && (this.put || this.at.plot.marks.some((m) => m.knob || m.steps));
  },

  dragged(event) {
    const x = this.at.value(event.clientX - $("#story-chart").getBoundingClientRect().left);
    if (this.put) return this.put(x);
    const mark = this.at.plot.marks.find((one) => one.knob || one.steps);
    if (mark) storyWords.dragged(mark, x);
  },

  // draws what the place names of the step that is seen
  show() {
    const { place } = storyStage, { run, k } = page, figure = $("#story-chart");
    if (page.face !== "story" || !place || !page.step() || !storyStage.is(run, place)) return;
    const names = (place.chart ?? "").split(",").filter(Boolean);
    figure.classList.toggle("none", !names.length);
    this.at = null;
    const w = Math.max(220, figure.clientWidth), h = Math.max(80, figure.clientHeight);
    if (names.length) this.drawn(names, run, k, w, h);
    figure.classList.toggle("drag", Boolean(this.drags()));
  },

  drawn(names, run, k, w, h) {
    const found = names.map((name) => this.named(run, k, name));
    if (names.length === 1 && found[0]?.plot) return this.plot(found[0].plot, run, k, w, h);
    const end = storyStage.found(run, "stop") ?? run.known - 1, rows = found.filter(Boolean);
    const height = (h - 24) / Math.max(1, rows.length);
    const parts = rows.flatMap((row, i) => row.chart
      ? seriesRow(run, row.chart, { w, top: i * height + 2, height: height - (rows.length > 1 ? 6 : 2),
        k, end: k > end ? run.known - 1 : end, last: i === rows.length - 1 })
      : row.curves ? this.curves(row.curves, w, h) : []);
    this.lay(parts, w, h, names.join(", "));
  },

  // what a name means at a step: {plot}, {curves}, {chart: of series}
  named(run, k, name) {
    const [base, near] = name.split("@");
    const things = run.steps[k].shown.map((n) => run.things[n]).filter(Boolean);
    const plot = things.find((one) => one.kind === "plot" && one.name === base);
    if (plot) return { plot: this.filled(run, plot, near) };
    const chart = Object.keys(run.charts ?? {}).find((title) => slug(title) === base) ??
      run.series.find((one) => slug(one.path) === base || slug(one.name) === base)?.chart;
    if (chart) return { chart };
    const curves = things.find((one) => one.kind === "curves" &&
      (one.name === base || slug(one.title.split(":")[0]) === base));
    return curves ? { curves } : null;
  },

  // a plot with its curves, which are kept beside it since they stay the same from step to step
  filled(run, plot, near) {
    const line = (one) => (typeof one === "number" ? run.things[one] : one);
    const axes = near === "near" && plot.near ? plot.near : {};
    return { ...plot, ...axes, whole: plot.whole.map(line), seconds: plot.seconds.map(line) };
  },

  plot(plot, run, k, w, h) {
    const at = this.at = laid(plot, w, h), hidden = storyStage.place.hide ?? [];
    const shown = (kind, one) => !hidden.includes(kind) && !hidden.includes(slug(one.name));
    const marks = plot.marks.filter((one) => shown("mark", one));
    const seconds = plot.seconds.filter((one) => shown("second", one));
    const visited = this.visited(plot, run, marks[0], at), seen = hidden.includes("curve");
    const free = marks[0] && !marks[0].steps && !seen;
    const parts = [...axes(at),
      ...bands(at, plot.bands.filter((one) => shown("band", one))),
      ...plot.whole.flatMap((one) => wholeCurve(at, one, seen ? visited : null)),
      ...seconds.flatMap((one) => secondCurve(at, one)),
      ...(seconds.length || plot.whole.length > 1 ? namesOf(at, plot.whole, seconds) : []),
      ...(free && k > 0 ? trail(at, this.trace(run, k, plot.name), marks[0].color) : []),
      ...(this.flag === null ? [] : flagAt(at, this.flag)),
      ...marks.filter((one) => one.y > at.y.high).map((one) => beyond(at, one)),
      ...marks.map((one, i) => `<circle class="ball" data-mark="${i}" ` +
        `r="${h > 140 ? 8.5 : 6.5}" fill="${colorOf(one.color)}"/>`)];
    const said = marks.map((one) => `${one.name} at ${this.word(at, one)}`).join("; ");
    this.lay(parts, w, h, `${plot.y_label || plot.title}${said ? `: ${said}` : ""}`);
    const inside = marks.map((one) => [at.px(one.x), at.py(Math.min(at.y.high, one.y))]);
    this.roll(inside, `${run.id} ${plot.name} ${w} ${h} ${at.x.low}`);
  },

  word(at, { x, y }) {
    const behind = at.x.words[0]?.replace(/^[−\d.,\s]+/, "") ?? "";
    const value = at.plot.log ? 10 ** y : y;
    return `${number(x)}${behind}, ${number(value)} ${at.plot.unit ?? ""}`.trim();
  },

  // where a mark of this plot has been in the run up to now; nothing where a step is not known here
  trace(run, k, name) {
    const points = [];
    for (let i = 0; i <= k; i++) {
      const plot = run.steps[i]?.shown.map((n) => run.things[n])
        .find((one) => one?.kind === "plot" && one.name === name);
      if (!plot?.marks[0]) return points.length && points.length === i ? [] : points;
      points.push([plot.marks[0].x, plot.marks[0].y]);
    }
    return points;
  },

  // the stretches of the x axis where the mark has been; a quick hand leaves no holes
  visited(plot, run, mark, at) {
    const range = at.x.high - at.x.low, { last } = this, small = range / 60;
    const seen = this.seen.get(plot.name) ?? [];
    if (!mark) return seen;
    const by = last?.of === `${run.name} ${plot.name}` && Math.abs(mark.x - last.x) < range / 3;
    const from = by ? last.x : mark.x;
    this.last = { of: `${run.name} ${plot.name}`, x: mark.x };
    const all = [...seen, [Math.min(from, mark.x) - small, Math.max(from, mark.x) + small]]
      .sort(([a], [b]) => a - b);
    const joined = [];
    for (const [low, high] of all) {
      if (joined.length && low <= joined.at(-1)[1]) joined.at(-1)[1] = Math.max(joined.at(-1)[1], high);
      else joined.push([low, high]);
    }
    this.seen.set(plot.name, joined);
    return joined;
  },

  // a chart of curves of this step, as the workbench has it
  curves(thing, w, h) {
    const at = laid(thing, w, h), parts = axes(at), lines = [];
    for (const curve of thing.curves) {
      const role = cssRole(curve);
      parts.push(...drawn({ ...curve, color: colorOf(role) }, at.px, at.py));
      if (curve.kind === "line") lines.push({ ...curve, color: role });
    }
    if (lines.length > 1) parts.push(...namesOf(at, lines, []));
    for (const mark of thing.curves.flatMap((one) => one.marks ?? [])) parts.push(
      `<line class="rim" x1="${at.px(mark)}" x2="${at.px(mark)}" y1="${at.top}" ` +
      `y2="${h - FRAME.bottom}"/>`);
    return parts;
  },

  lay(parts, w, h, label) {
    const svg = $("#story-chart svg");
    svg.setAttribute("viewBox", `0 0 ${w} ${h}`);
    svg.setAttribute("aria-label", `Chart: ${label}`);
    svg.innerHTML = parts.join("");
  },

  // the marks glide as the picture does
  roll(to, of) {
    cancelAnimationFrame(this.rolling);
    const balls = $$("#story-chart .ball"), same = this.rolledOf === of;
    const from = to.map((place, i) => (same && this.rolled.get(i)) || place);
    const far = Math.max(0, ...to.map(([x, y], i) => Math.hypot(x - from[i][0], y - from[i][1])));
    const swift = isStill() || far > 260 || sceneView.swift, start = performance.now();
    this.rolledOf = of;
    const frame = (time) => {
      const part = swift ? 1 : Math.min(1, Math.max(0, (time - start) / 240));
      const eased = part * part * (3 - 2 * part);
      balls.forEach((ball, i) => {
        const place = to[i].map((v, j) => from[i][j] + (v - from[i][j]) * eased);
        this.rolled.set(i, place);
        ball.setAttribute("cx", place[0]);
        ball.setAttribute("cy", place[1]);
      });
      if (part < 1) this.rolling = requestAnimationFrame(frame);
    };
    frame(start);
  },
};
