// The marks of the story's chart as SVG. Axes, ticks and curves come with the step: nothing here
// knows a lesson. A part is text; where something is to be found again it has a class.
"use strict";

const FRAME = { left: 46, right: 14, top: 25, bottom: 34 };

// the word by which page.md names a chart, a curve or a series
function slug(text) {
  return String(text).toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "");
}

// the colour of a role, for things and for words; other colours are taken as they are
const ROLE_COLORS = { target: "target", source: "source", truth: "truth", highlight: "highlight",
  correspondence: "match-ink", match: "match-ink", neutral: "match-ink", outlier: "wrong-fill",
  wrong: "wrong-fill", other: "other", x: "wrong-fill", y: "truth", z: "target" };
function colorOf(role) { return ROLE_COLORS[role] ? `var(--${ROLE_COLORS[role]})` : role; }
function inkOf(role) {
  const name = (ROLE_COLORS[role] ?? "").replace(/-(ink|fill)$/, "");
  return name ? `var(--${name}-ink)` : role;
}

// an axis with its ends, its ticks and their words
function axisOf(axis, words) {
  if (!Array.isArray(axis)) return axis;
  const ticks = words ?? [];
  return { low: axis[0], high: axis[1], ticks, words: ticks.map(number) };
}

// a plot laid out in a box of w x h pixels: where its values are
function laid(plot, w, h) {
  const x = axisOf(plot.x, plot.ticks?.x), y = axisOf(plot.y, plot.ticks?.y);
  const { left, right, bottom } = FRAME, [up, across] = namesOfAxes(plot);
  const crowded = across && 7 * (up.length + across.length) + 60 > w;  // each name has its own line
  const top = FRAME.top + (crowded ? 14 : 0), wide = w - left - right, high = h - top - bottom;
  return {
    plot, w, h, x, y, up, across, top,
    px: (value) => left + ((value - x.low) / (x.high - x.low)) * wide,
    py: (value) => h - bottom - ((value - y.low) / (y.high - y.low)) * high,
    value: (px) => Math.min(x.high, Math.max(x.low,
      x.low + ((px - left) / wide) * (x.high - x.low))),
  };
}

const namesOfAxes = (plot) =>
  [plot.y_label || named(plot), (plot.x_label ?? plot.xLabel ?? "").trim()];

function line(points) {
  return points.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");
}

// ticks that have room: every second one where there are too many
function thinned(axis, room) {
  const every = Math.ceil(axis.ticks.length / Math.max(1, room));
  const from = every > 1 && (axis.ticks.length - 1) % every ? 1 : 0;
  return axis.ticks.map((tick, i) => [tick, axis.words[i], i])
    .filter(([, , i]) => i % every === from);
}

function axes(at) {
  const { w, h, x, y, px, py, up, across, top } = at, { left, right, bottom } = FRAME;
  const parts = thinned(y, (h - top - bottom) / 26).map(([tick, word]) =>
    `<line class="axis" x1="${left}" x2="${w - right}" y1="${py(tick)}" y2="${py(tick)}"/>` +
    `<text x="${left - 7}" y="${py(tick) + 4}" text-anchor="end">${escape(word)}</text>`);
  parts.push(...thinned(x, (w - left - right) / 56).map(([tick, word]) =>
    `<text x="${px(tick)}" y="${h - bottom + 26}" text-anchor="middle">${escape(word)}</text>`));
  parts.push(`<text x="${left - 38}" y="12">${escape(up)}</text>`);
  if (across) parts.push(
    `<text x="${w - right}" y="${top - 13}" text-anchor="end">${escape(across)} →</text>`);
  return parts;
}

// the points of a curve that stand within the axes, in pieces without holes
function pieces(at, { x, y }, keep) {
  const found = [[]];
  x.forEach((value, i) => {
    const inside = value >= at.x.low - 1e-9 && value <= at.x.high + 1e-9 && y[i] !== null &&
      y[i] <= at.y.high + 1e-9 && y[i] >= at.y.low - 1e-9 && (!keep || keep(value));
    if (inside) found.at(-1).push([at.px(value), at.py(y[i])]);
    else if (found.at(-1).length) found.push([]);
  });
  return found.filter((piece) => piece.length);
}

// a whole curve; where `seen` is given only near what has been visited
function wholeCurve(at, curve, seen) {
  const keep = seen && ((x) => seen.some(([low, high]) => x >= low && x <= high));
  return pieces(at, curve, keep).map((piece) =>
    `<path class="whole" stroke="${colorOf(curve.color)}" d="${line(piece)}"/>`);
}

// the height of a curve at x; undefined outside of it
function heightAt(curve, x) {
  const i = curve.x.findIndex((value) => value >= x);
  if (i < 0 || (i === 0 && curve.x[0] > x + 1e-9)) return undefined;
  if (i === 0) return curve.y[0];
  const part = (x - curve.x[i - 1]) / (curve.x[i] - curve.x[i - 1]);
  return curve.y[i - 1] + part * (curve.y[i] - curve.y[i - 1]);
}

// what a mark says that is above the axis: it stands at its edge
function beyond(at, one) {
  const x = at.px(one.x), left = x > 0.6 * at.w, words = `${one.name} ${number(one.y)} ${at.plot.unit ?? ""} ↑`;
  return `<text class="over" x="${x + (left ? -14 : 14)}" y="${at.top + 5}" ` +
    `text-anchor="${left ? "end" : "start"}" style="fill:${inkOf(one.color)}">${escape(words.replace("  ", " "))}</text>`;
}

// where a curve is lowest, between its points: the vertex of the parabola through three of them
function vertex(points, low) {
  const i = points.findIndex(([, v]) => v === low), [a, b, c] = [points[i - 1], points[i], points[i + 1]];
  if (!a || !c) return b[0];
  const bend = a[1] - 2 * b[1] + c[1];
  return b[0] + (bend ? (0.25 * (a[1] - c[1]) * (c[0] - a[0])) / bend : 0);
}

// a second curve of this step: dashed, its lowest point a ring, its name where it is highest
function secondCurve(at, curve) {
  const parts = pieces(at, curve), all = parts.flat();
  if (!all.length) return [];
  const color = colorOf(curve.color), [, y] = all.reduce((a, b) => (b[1] > a[1] ? b : a));
  const lowest = vertex(all, y);
  const [first, end] = [all[0], all.at(-1)], valley = y > Math.max(first[1], end[1]) + 4;
  const high = first[1] < end[1] ? first : end, wide = 6.6 * curve.name.length;
  const right = high === end && high[0] - 16 - wide > FRAME.left;
  const [u, v, anchor] = valley
    ? [Math.min(at.w - 70, Math.max(FRAME.left + 60, (first[0] + end[0]) / 2)), at.top + 14, "middle"]
    : [high[0] + (right ? -16 : 16), high[1] + 5, right ? "end" : "start"];
  const said = at.h > 90 ? `<text class="over" x="${u}" y="${Math.max(at.top + 12, v)}" ` +
    `text-anchor="${anchor}" style="fill:${inkOf(curve.color)}">${escape(curve.name)}</text>` : "";
  const ring = valley ? `<circle class="low" cx="${lowest}" cy="${y}" r="6" stroke="${color}"/>` : "";
  return [...parts.map((piece) => `<path class="second" stroke="${color}" d="${line(piece)}"/>`),
    ring, said];
}

// the names of whole curves, each where it covers no other curve and no other name
function namesOf(at, curves, others) {
  if (at.h < 100) return [];
  const taken = [], room = { left: FRAME.left, right: at.w - FRAME.right };
  return curves.map((curve) => {
    const wide = 6.6 * curve.name.length, half = wide / 2, places = [];
    for (const part of [0.92, 0.75, 0.58, 0.4, 0.22]) for (const up of [-12, 20]) {
      const x = at.x.low + part * (at.x.high - at.x.low), y = heightAt(curve, x);
      if (y === undefined || y === null) continue;
      const u = Math.min(room.right - half, Math.max(room.left + half, at.px(x)));
      const box = { u, v: at.py(y) + up, left: u - half, right: u + half };
      const inside = box.v > at.top + 8 && box.v < at.h - FRAME.bottom - 2;
      places.push({ ...box, bad: (inside ? 0 : 4) + clashes(at, box, [...curves, ...others], taken) });
    }
    if (!places.length) return "";
    const best = places.reduce((a, b) => (b.bad < a.bad ? b : a));
    taken.push(best);
    return `<text class="over" x="${best.u}" y="${best.v}" text-anchor="middle" ` +
      `style="fill:${inkOf(curve.color)}">${escape(curve.name)}</text>`;
  });
}

// how much words in a box would cover
function clashes(at, { v, left, right }, curves, taken) {
  const over = taken.filter((one) => one.left < right && left < one.right && Math.abs(one.v - v) < 15);
  const crossed = curves.filter((curve) => [0, 0.25, 0.5, 0.75, 1].some((part) => {
    const y = heightAt(curve, at.value(left + part * (right - left)));
    return y !== undefined && y !== null && at.py(y) > v - 13 && at.py(y) < v + 5;
  }));
  return 3 * over.length + crossed.length;
}

// bands on the axis, with a rim at each end
function bands(at, found) {
  if (!found.length) return [];
  const { px, h, x } = at, y = h - FRAME.bottom + 4;
  const rail = `<rect class="rail" x="${px(x.low)}" width="${px(x.high) - px(x.low)}" ` +
    `y="${y}" height="7" rx="2"/>`;
  return [rail, ...found.map(({ low, high, color, name }) => {
    const [a, b] = [Math.max(low, x.low), Math.min(high, x.high)].map(px);
    const rims = [[low, a], [high, b]].filter(([v]) => v > x.low && v < x.high).map(([, u]) =>
      `<line class="rim" x1="${u}" x2="${u}" y1="${y - 3}" y2="${y + 10}"/>`);
    return `<rect x="${a}" width="${Math.max(0, b - a)}" y="${y}" height="7" rx="2" ` +
      `fill="${colorOf(color)}"><title>${escape(name)}</title></rect>${rims.join("")}`;
  })];
}

// where a mark has been up to now, and where it began
function trail(at, points, color) {
  if (!points.length) return [];
  const half = (at.x.high - at.x.low) / 2, parts = [[]];
  points.forEach(([x, y], i) => {
    if (i && Math.abs(x - points[i - 1][0]) > half) parts.push([]); // once around
    parts.at(-1).push([at.px(x), at.py(y)]);
  });
  const [x, y] = parts[0][0], ink = inkOf(color);
  return [...parts.map((part) => `<path class="trail" stroke="${ink}" d="${line(part)}"/>`),
    `<circle class="first" cx="${x}" cy="${y}" r="3.5" stroke="${ink}"/>`];
}

// the reader's flag, with its foot on the curve
function flagAt(at, x) {
  const curve = at.plot.whole?.[0], high = curve && heightAt(curve, x);
  const u = at.px(x), y = at.py(Math.min(at.y.high, high ?? at.y.low));
  const top = Math.max(2, y - 34), cloth = u + 60 > at.w ? -17 : 17;
  return [`<line class="flag" x1="${u}" x2="${u}" y1="${y}" y2="${top}"/>`,
    `<path class="cloth" d="M${u} ${top}l${cloth} 6 ${-cloth} 6z"/>`,
    `<text class="you over" x="${u + cloth + Math.sign(cloth) * 3}" y="${top + 11}" ` +
    `text-anchor="${cloth < 0 ? "end" : "start"}">you</text>`];
}

// what a chart of curves is of: the label of its values, and its title where that is a mere unit
const UNIT = /^([kcm]?m[²³]?|rad|°|px|%|×|s)$/;
const named = ({ title, yLabel }) => (UNIT.test(yLabel) ? `${title} (${yLabel})` : yLabel || title);

// scalars over the steps of the run itself, as one row of a chart; drawn up to the step k
function seriesRow(run, chart, { w, top, height, k, end, last }) {
  const lines = run.series.filter((one) => one.chart === chart), about = run.charts[chart];
  const { y } = about, { left } = FRAME, low = top + height;
  const right = Math.min(w / 3, Math.max(82, ...lines.map((one) => endRoom(one, lines.length > 1))));
  const px = (step) => left + (step / Math.max(1, end)) * (w - left - right);
  const py = (v) => low - ((v - y.low) / (y.high - y.low)) * (height - 18);
  const said = (v, l) => (l.log ? (v > 0 ? Math.log10(v) : null) : v);
  const ticks = thinned(y, Math.max(2, (height - 18) / 26));
  const parts = ticks.map(([tick, word]) =>
    `<line class="axis" x1="${left}" x2="${w - right}" y1="${py(tick)}" y2="${py(tick)}"/>` +
    `<text x="${left - 7}" y="${py(tick) + 4}" text-anchor="end">${escape(word)}</text>`);
  const taken = [];
  for (const one of lines) {
    const upto = Math.min(k, end), points = one.values.slice(0, end + 1)
      .map((v, i) => [px(i), v === null || said(v, one) === null ? null : py(said(v, one)), i])
      .filter(([, v]) => v !== null), shown = points.filter(([, , i]) => i <= upto);
    const color = colorOf(cssRole(one)), ink = inkOf(cssRole(one));
    if (shown.length > 1) parts.push(`<path class="line" stroke="${color}" d="${line(shown)}"/>`);
    if (!shown.length) continue;
    const [x, v] = shown.at(-1);
    parts.push(`<circle r="5" cx="${x}" cy="${v}" fill="${color}"/>`);
    const free = (place) => taken.every((other) => Math.abs(other - place) >= 16);
    const at = [v, v + 16, v - 16, v - 32].find((place) => free(place) && place <= low) ?? v;
    taken.push(at);
    const words = endWords(one, one.values[shown.at(-1)[2]], lines.length > 1);
    parts.push(`<text class="value over" x="${x + 10}" y="${at + 4}" style="fill:${ink}">` +
      `${escape(words)}</text>`);
  }
  const label = about.yLabel ?? "", same = label.toLowerCase().startsWith(chart.toLowerCase());
  const head = same ? label : [about.head || chart, label].filter(Boolean).join(", ");
  parts.push(`<text class="head over" x="${left}" y="${top + 8}" ` +
    `style="fill:${inkOf(cssRole(lines[0]))}">${escape(head)}</text>`);
  if (last) parts.push(`<text x="${left}" y="${low + 17}">0</text>`,
    `<text x="${w - right}" y="${low + 17}" text-anchor="end">${end} steps</text>`);
  return parts;
}

// what stands behind the end of a line: its value, with its name where there are several
function endWords(one, value, several) {
  const digits = Math.max(2, `${Math.trunc(Math.abs(value))}`.length);
  return (several ? `${one.name} ` : "") + measured(Number(value.toPrecision(digits)), one.unit);
}

// pixels that the longest of these words takes, whichever step is shown
function endRoom(one, several) {
  const words = one.values.filter((value) => value !== null).map((v) => endWords(one, v, several));
  return 14 + 8.4 * Math.max(0, ...words.map((text) => text.length));
}

// the role of a series: it comes as a colour of the palette, or as the role itself
const CSS_ROLES = { "0,114,178": "target", "230,159,0": "source", "0,158,115": "truth",
  "213,94,0": "outlier", "204,121,167": "highlight", "86,180,233": "other" };
function cssRole({ color }) {
  if (ROLE_COLORS[color]) return color;
  const hex = /^#(..)(..)(..)$/.exec(color)?.slice(1).map((part) => parseInt(part, 16));
  return CSS_ROLES[hex ?? (String(color).match(/\d+/g) ?? []).slice(0, 3)] ?? "neutral";
}
