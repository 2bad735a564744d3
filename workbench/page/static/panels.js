// What stands beside the scene: tiles of curves, pictures, tables and code, each of which can be enlarged.
"use strict";

const panels = {
  large: null,  // the key of what is enlarged
  laid: false,  // whether something is shown that belongs to no step

  show() {
    const tiles = this.of(page.run, page.step());
    const focused = document.activeElement?.closest("#tiles .tile")?.dataset.key; // more of the run takes no focus away
    $("#tiles").replaceChildren(...tiles.map((tile) => this.tile(tile)));
    [...$("#tiles").children].find((one) => one.dataset.key === focused)?.focus({ preventScroll: true });
    const enlarged = tiles.find((tile) => tile.key === this.large);
    const box = $("#large");
    box.hidden = !enlarged && !this.laid;
    if (!enlarged) return;
    const top = $(".body", box) ? $(".body", box).scrollTop : 0;
    const body = this.fill(enlarged.whole());
    body.scrollTop = top;
    const line = $(".here", body);
    if (line && !exercise.scrolled(body)) body.scrollTop = line.offsetTop - body.offsetTop - 0.5 * body.clientHeight;
  },

  // {key, title, small: HTML, whole(): element, and of charts chart(size): element} of everything that can be shown
  of(run, step) {
    if (!run || !step) return [];
    const found = [], charts = new Map();
    for (const one of run.series) charts.set(one.chart, [...(charts.get(one.chart) ?? []), one]);
    for (const [chart, lines] of charts) if (this.begun(run, chart, lines)) found.push(this.series(run, chart, lines));
    step.shown.map((n) => run.things[n]).filter(Boolean).forEach((thing, i) => found.push(this.thing(thing, i)));
    if (step.code && run.things[step.code.source]) found.push(this.code(run.things[step.code.source], step.code));
    return found.sort((a, b) => Boolean(b.telling) - Boolean(a.telling));
  },

  // whether a chart over the steps has a point yet among those that are shown; what is pinned is shown whole
  begun(run, chart, lines) {
    const upto = run.seen ? Infinity : run.played, has = (v) => (v ?? null) !== null;
    return lines.some((l) => l.values.some((v, i) => i <= upto && has(v))) ||
      (run.pinned ?? []).some((l) => l.chart === chart && l.values.some(has));
  },

  series(run, chart, lines) {
    const axes = run.charts[chart], upto = run.seen ? Infinity : run.played, log = lines[0].log;
    const told = lines.filter((l) => (l.values[page.k] ?? null) !== null).map((l) => [l.name, measured(l.values[page.k], l.unit)]);
    const said = told.map((words) => words.join(" "));
    const curve = (l, kind, name) => ({
      name, kind, color: l.color, marks: [], x: l.values.map((_, i) => i),
      y: l.values.map((v) => (v !== null && log ? (v > 0 ? Math.log10(v) : null) : v)),
    });
    const pinned = (run.pinned ?? []).filter((l) => l.chart === chart).map((l) => curve(l, "pinned", `${l.name}, pinned`));
    const curves = lines.map((l) => curve(l, "line", l.name));
    const data = { ...axes, title: [axes.head, said.join(" · ")].filter(Boolean).join(": ") || chart, xLabel: "step", curves };
    const marks = [page.k, ...exercise.marks(run)];
    // what is pinned is shown to its end: it has been seen
    const framed = (size) => plot({ ...data, curves: [...pinned, ...curves.map((c) => cut(c, upto))] }, marks, size);
    const whole = () => {
      const drawn = framed();
      const more = element("button", { type: "button", textContent: "Show the whole run", onclick: () => { run.seen = true; this.show(); } });
      return element("div", {}, drawn, ...(run.seen || upto >= page.known() - 1 ? [] : [more]));
    };
    return { key: `series ${chart}`, telling: chart === LESSON.telling, title: said.join(" · ") || chart, value: told.length === 1 ? told[0] : null, small: sparkline(data, marks, upto), chart: framed, whole };
  },

  thing(thing, i) {
    if (thing.kind === "html") {
      const made = element("div", { innerHTML: thing.html });
      const title = $("strong", made)?.textContent ?? "Table";
      return { key: `table ${title}`, telling: title === LESSON.telling, title, small: `<span class="sign">▤</span>`, whole: () => made };
    }
    if (thing.kind === "plot") {
      const data = flattened(page.run, thing);
      return { key: `plot ${thing.name}`, telling: thing.title === LESSON.telling, title: thing.title,
        small: sparkline(data, []), chart: (size) => plot(data, [], size), whole: () => plot(data, []) };
    }
    if (thing.kind === "curves") {
      const marks = thing.curves.flatMap((c) => c.marks);
      return { key: `curves ${thing.title}`, telling: thing.title.startsWith(LESSON.telling || "-"), title: thing.title, small: sparkline(thing, marks), chart: (size) => plot(thing, marks, size), whole: () => plot(thing, marks) };
    }
    const whole = () => element("figure", {}, element("figcaption", { textContent: thing.title }),
      element("img", { src: thing.url, alt: thing.title, className: thing.width < 200 ? "pixels" : "" }),
      element("div", { className: "wb-legend", innerHTML: `<span>${thing.bar}</span>` }));
    return { key: `picture ${i}`, telling: thing.title === LESSON.telling, title: thing.title, small: `<img src="${thing.url}" alt="">`, whole };
  },

  code(source, at) {
    const whole = () => {
      const box = element("div", { className: "wb-code" });
      box.innerHTML = `<p><b>${escape(source.name)}</b>: the marked line is where this step was yielded.</p><div class="lines" tabindex="0">${source.html}</div>` +
        `<table><thead><tr><th>Variable</th><th>Shape or type</th><th>Value or range</th></tr></thead><tbody>${
          at.locals.map((row) => `<tr>${row.map((cell, i) => `<td>${i ? escape(cell) : `<code>${escape(cell)}</code>`}</td>`).join("")}</tr>`).join("")}</tbody></table>`;
      $(`[data-line="${at.line}"]`, box)?.classList.add("here");
      exercise.source(box, at);
      return box;
    };
    return { key: "code", title: "Code", small: `<span class="sign">{ }</span>`, whole };
  },

  // of one value the name may be cut off, but not the value
  tile({ key, title, small, value, telling, chart }) {
    const words = value ? `<span>${escape(value[0])}</span><b>${escape(value[1])}</b>` : `<span>${escape(title)}</span>`;
    const button = element("button", { type: "button", className: telling && chart ? "tile main" : "tile", title, innerHTML: `${small}<span>${words}</span>` });
    button.dataset.key = key;
    button.setAttribute("aria-pressed", String(key === this.large));
    button.onclick = () => this.enlarge(key === this.large ? null : key);
    return button;
  },

  // shows something that belongs to no step, until it is closed
  lay(title, body) {
    this.large = null;
    this.laid = true;
    this.show();
    this.fill(element("h2", { textContent: title }), body);
    $("#large").hidden = false;
    $("#large .close").focus();
  },

  // puts something into the box for what is large; returns the part of it that scrolls
  fill(...parts) {
    const close = element("button", { type: "button", className: "close", textContent: "×", ariaLabel: "Close", onclick: () => this.enlarge(null) });
    const body = element("div", { className: "body", tabIndex: 0 }, ...parts);
    $("#large").replaceChildren(close, body);
    return body;
  },

  enlarge(key) {
    this.large = key;
    this.laid = false;
    this.show();
  },
};
