// Charts as SVG. The axes, their ticks and words come with the data: every home has the same.
"use strict";

const CHART = { width: 340, height: 190, left: 52, right: 10, top: 8, bottom: 34 };

// a whole chart; `marks` are vertical lines
function plot({ title, xLabel, yLabel, curves, x: across, y: up }, marks, size = CHART) {
  const { width, height, left, right, top, bottom } = size;
  const px = (x) => left + ((x - across.low) / (across.high - across.low)) * (width - left - right);
  const py = (y) => height - bottom - ((y - up.low) / (up.high - up.low)) * (height - top - bottom);
  const parts = [];
  up.ticks.forEach((y, i) => parts.push(
    `<line class="grid" x1="${left}" x2="${width - right}" y1="${py(y)}" y2="${py(y)}"/>`,
    `<text x="${left - 5}" y="${py(y) + 4}" text-anchor="end">${escape(up.words[i])}</text>`));
  across.ticks.forEach((x, i) => parts.push(
    `<text x="${px(x)}" y="${height - bottom + 14}" text-anchor="middle">${escape(across.words[i])}</text>`));
  for (const curve of curves) parts.push(...drawn(curve, px, py));
  for (const mark of marks) parts.push(stroke(mark, px, top, height - bottom));
  parts.push(`<text x="${(left + width) / 2}" y="${height - 4}" text-anchor="middle">${escape(xLabel)}</text>`,
    `<text transform="translate(11 ${(height - bottom) / 2}) rotate(-90)" text-anchor="middle">${escape(yLabel)}</text>`);
  const key = curves.length > 1
    ? curves.map((c) => `<span><i style="background:${c.color}"></i>${escape(c.name)}</span>`).join("") : "";
  const box = element("figure", { className: "plot" });
  box.innerHTML = `<figcaption>${escape(title)}</figcaption>` +
    `<svg viewBox="0 0 ${width} ${height}" role="img" aria-label="${escape(title)}">${parts.join("")}</svg>` +
    `<div class="wb-legend">${key}</div>`;
  return box;
}

const ROLES = { target: "#0072b2", source: "#e69f00", correspondence: "#999999", truth: "#009e73",
  wrong: "#d55e00", highlight: "#cc79a7", neutral: "#6e7681", other: "#56b4e9" };

// a story's large chart as curves; bands lie along its lower edge
function flattened(run, { title, x_label: xLabel, y_label: yLabel, x, y, ...parts }) {
  const line = (one) => (typeof one === "number" ? run.things[one] : one);
  const made = (one, kind, dashed) => ({ ...one, kind: dashed ? "pinned" : kind, marks: [],
    color: ROLES[one.color] ?? one.color, y: one.y.map((v) => (v > y.high ? null : v)) });
  const lines = parts.whole.map(line).filter(Boolean), seconds = parts.seconds.map(line).filter(Boolean);
  const bands = parts.bands.map((one) => ({ ...one, x: [one.low, one.high], y: [y.low, y.low] }));
  const marks = parts.marks.map((one) => ({ ...one, x: [one.x], y: [one.y] }));
  return { title, xLabel, yLabel, x, y, curves: [...bands.map((one) => made(one, "line")),
    ...lines.map((one) => made(one, "line")), ...seconds.map((one) => made(one, "line", true)),
    ...marks.map((one) => made(one, "dots"))] };
}

// the same chart without words, as small as a thumb
function sparkline({ curves, x: across, y: up }, marks, upto = Infinity) {
  const px = (x) => 2 + ((x - across.low) / (across.high - across.low)) * 116;
  const py = (y) => 46 - ((y - up.low) / (up.high - up.low)) * 44;
  const parts = curves.flatMap((curve) => drawn(cut(curve, upto), px, py));
  for (const mark of marks) parts.push(stroke(mark, px, 1, 47));
  return `<svg viewBox="0 0 120 48" aria-hidden="true" preserveAspectRatio="none">${parts.join("")}</svg>`;
}

// a vertical line: where one is, or, given as {at, title}, what is worth a look
function stroke(mark, px, top, bottom) {
  const { at, title } = mark.title ? mark : { at: mark };
  return `<line class="${title ? "mark noted" : "mark"}" x1="${px(at)}" x2="${px(at)}" y1="${top}" y2="${bottom}">${
    title ? `<title>${escape(title)}</title>` : ""}</line>`;
}

function cut(curve, upto) {
  return upto === Infinity ? curve : { ...curve, y: curve.y.map((y, i) => (curve.x[i] <= upto ? y : null)) };
}

function drawn(curve, px, py) {
  const { color } = curve;
  if (curve.kind === "dots") {
    return curve.x.map((x, i) => curve.y[i] === null ? "" : `<circle r="2.5" cx="${px(x)}" cy="${py(curve.y[i])}" fill="${color}"/>`);
  }
  if (curve.kind === "bars") { // each stands on zero at its own x, as wide as the nearest two are apart
    const gaps = curve.x.slice(1).map((x, i) => x - curve.x[i]).filter((gap) => gap > 0);
    const half = 0.48 * (gaps.length ? Math.min(...gaps) : 1);
    return curve.x.map((x, i) => curve.y[i] === null ? "" :
      `<rect x="${px(x - half)}" width="${px(x + half) - px(x - half)}" y="${py(Math.max(curve.y[i], 0))}" ` +
      `height="${Math.abs(py(0) - py(curve.y[i]))}" fill="${color}" fill-opacity="0.6"/>`);
  }
  const pieces = [[]];
  curve.x.forEach((x, i) => {
    if (curve.y[i] === null) pieces.push([]);
    else pieces.at(-1).push(`${px(x).toFixed(1)},${py(curve.y[i]).toFixed(1)}`);
  });
  const dash = curve.kind === "pinned" ? ' stroke-dasharray="5 4" opacity="0.6"' : "";
  return pieces.filter((p) => p.length).map((p) => p.length === 1
    ? `<circle r="2" cx="${p[0].split(",")[0]}" cy="${p[0].split(",")[1]}" fill="${color}"/>`
    : `<polyline points="${p.join(" ")}" stroke="${color}"${dash}/>`);
}
