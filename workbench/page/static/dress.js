// What a lesson without a story shows as a story does: the open experiment's title and line, one large chart,
// and the names of places under the slider.
"use strict";

const dress = {
  shown: "",  // what the chart was drawn of

  start() {
    page.listeners.push({ drawn: () => this.show() });
    addEventListener("resize", () => { this.shown = ""; this.show(); });
  },

  show() {
    if (!page.run) return;
    this.open(page.run);
    this.places(page.run);
    this.chart();
  },

  // the experiment that is open; of the default run the lesson's own line
  open(run) {
    const usual = run.name === "default", none = (preset) => !Object.keys(preset.params).length;
    const preset = LESSON.presets.find((one) => (usual ? none(one) : one.name === run.name));
    $("#open b").textContent = preset ? preset.title : usual ? LESSON.title : "";
    $("#open span").textContent = preset ? preset.line : usual ? LESSON.summary : "";
  },

  // start, stop, and the steps that the text or a caption names; each is a button
  places(run) {
    const last = Math.max(1, page.known() - 1), told = run.places ?? [];
    const linked = $$("#article a[data-run][data-step]").filter((link) => link.dataset.run === run.name)
      .map((link) => [Number(link.dataset.step), link.textContent])
      .map(([at, words]) => [at < 0 ? (run.finished ? run.known + at : -1) : at, words]);
    const named = [...told, ...linked].filter(([at, words]) => at >= 0 && at <= last && words.length <= 24);
    const row = [], sign = 7 / ($("#places").clientWidth || 480);
    const extent = ([at, words]) => {
      const wide = sign * words.length + 0.02, from = at === 0 ? 0 : at === last ? 1 - wide : at / last - wide / 2;
      return [from, from + wide];
    };
    for (const place of [...named.filter(([at]) => at === 0 || at === last), ...named]) {
      const [from, to] = extent(place);
      if (row.map(extent).every(([low, high]) => to <= low || high <= from)) row.push(place);
    }
    $("#places").replaceChildren(...row.map(([at, words]) => {
      const button = element("button", { type: "button", textContent: words, onclick: () => { transport.pause(); page.seek(at); } });
      button.className = at === 0 ? "first" : at === last ? "last" : "";
      button.style.left = `${(100 * at) / last}%`;
      if (at === page.k) button.setAttribute("aria-current", "true");
      return button;
    }));
  },

  // the chart that tells most, where it has begun; its place stays once a run has had it
  chart() {
    const box = $("#main-chart"), tile = panels.of(page.run, page.step()).find((one) => one.telling && one.chart);
    const kept = box.dataset.run === String(page.run.id);
    document.body.classList.toggle("charted", Boolean(tile) || (kept && !box.hidden));
    if (tile) box.dataset.run = page.run.id;
    box.hidden = !tile && !kept;
    if (!tile || !box.clientWidth) return;
    box.replaceChildren(tile.chart({ ...CHART, width: box.clientWidth, height: box.clientHeight - 26 }));
  },
};
