// What one can touch in the story's words: numbers that are dragged, links that show a place, picks
// of what-ifs, and words whose things stand out while they are pointed at.
"use strict";

const storyWords = {
  numbers: [],         // {el, kind: knob | steps, name, place, form}
  series: new Map(),   // "run series" -> its values, as far as they are known

  start() {
    for (const el of $$("#story .num")) this.number(el);
    for (const link of $$("#story a[data-go]")) link.addEventListener("click", (event) => {
      if (event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      const place = this.placeOf(link);
      story.took(() => storyStage.go(place));
    });
    for (const pick of $$("#story .pick")) pick.addEventListener("click", () => this.pick(pick));
    this.lights();
  },

  // the place that a link or a pick leads to, in the scene of its words
  placeOf(el) {
    const [, run, step] = /^([^@]*)(?:@(.*))?$/.exec(el.dataset.go), words = story.placeAt(el);
    const at = step === undefined ? undefined : Number.isNaN(Number(step)) ? step : Number(step);
    return { ...words, run, step: at ?? 0, plays: at === undefined, knob: undefined };
  },

  async pick(pick) {
    const card = pick.closest(".what-if"), place = this.placeOf(pick);
    await story.took(async () => {
      story.plate(`${card.dataset.title}: ${pick.textContent}`, card.dataset.line);
      this.picked = pick;
      this.press();
      const view = card.dataset.view ?? place.view, chart = card.dataset.chart ?? place.chart;
      const came = await storyStage.go({ ...place, view, chart });
      if (came && place.plays) storyStage.play("stop", 7);
    });
  },

  press() {
    for (const one of $$("#story .pick")) one.setAttribute("aria-pressed", String(one === this.picked));
  },
  unpick() {
    this.picked = null;
    this.press();
  },

  // words in the colour of a thing light it up
  lights() {
    for (const word of $$("#story :is(.target,.source,.truth,.match,.correspondence)")) {
      const path = ["target", "source", "truth", "match", "correspondence"]
        .find((role) => word.classList.contains(role));
      const thing = path === "match" || path === "correspondence" ? "matches" : path;
      word.addEventListener("pointerenter", () => stage.light(thing));
      word.addEventListener("pointerleave", () => stage.light(""));
    }
  },

  // numbers ---------------------------------------------------------------------------------------

  number(el) {
    const { knob, steps } = el.dataset, kind = knob ? "knob" : "steps", name = knob ?? steps;
    const place = story.placeAt(el), form = formOf(el.textContent);
    const one = { el, kind, name, place, form, sweep: null, data: null };
    if (knob && !this.turnable(one)) return;
    this.numbers.push(one);
    Object.assign(el, { tabIndex: 0, title: "Drag, or use the arrow keys" });
    el.setAttribute("role", "slider");
    el.setAttribute("aria-label", this.label(el));
    this.draggable(one);
    this.keyed(one);
    together(el);
  },

  // the home has learnt to compute: every knob's number turns, at any value
  computes() {
    for (const one of this.numbers) if (one.kind === "knob" && this.turnable(one)) one.sweep = null;
    const known = new Set(this.numbers.map(({ el }) => el));
    for (const el of $$("#story .num")) if (!known.has(el)) this.number(el);
  },

  // the words before a number say what it is
  label(el) {
    const range = document.createRange();
    range.setStart(el.parentElement, 0);
    range.setEndBefore(el);
    return range.toString().split(/[.:!?]\s/).pop().trim().slice(-60) || "Number";
  },

  // whether this home can turn the knob: computed live, from a sweep on a site
  turnable(one) {
    if (source.change) {
      const found = LESSON.knobs.find((knob) => knob.name === one.name && knob.low !== undefined);
      const { low = found?.low, high = found?.high } = one.el.dataset;  // less than the knob has
      one.data = found && { ...found, low: Number(low), high: Number(high) };
      return Boolean(found);
    }
    const named = (sweep) => (sweep.knob ?? sweep.names[0].split(":")[0]) === one.name;
    const of = ({ run = "default" }) => canonical(run) === canonical(one.place.run);
    one.sweep = RECORDED.sweeps.find((sweep) => named(sweep) && of(sweep));
    return Boolean(one.sweep);
  },

  // {count, at, value(i)}: where a number stands among its values
  dial(one) {
    if (one.kind === "steps") {
      const values = this.valuesOf(one), here = this.isOf(one);
      if (here) one.at = page.k;
      return { count: values.length, at: one.at ?? this.opened(one), value: (i) => values[i] };
    }
    if (one.sweep) {
      const { values, places, runs } = one.sweep, here = page.run && places[page.run.name];
      if (here && this.isSwept(one)) one.at = here[0];
      const at = one.at ?? Math.max(0, runs.indexOf(one.place.run));
      return { count: values.length, at, value: (i) => Number(values[i]) };
    }
    const { low, high, step } = one.data, grain = step > 0 ? step : (high - low) / 200;
    const wished = storyStage.place?.knob?.[one.name], { run } = page;
    const now = wished ?? (this.isOf(one) ? run.params?.[one.name] : undefined);
    if (now !== undefined) one.at = (now - low) / grain;
    const written = one.form.value === null ? low : one.form.value / one.form.scale(one.data.unit);
    return { count: Math.round((high - low) / grain) + 1, at: one.at ?? (written - low) / grain,
      value: (i) => low + i * grain };
  },

  isOf: (one) => Boolean(page.run) && canonical(storyStage.place?.run) === canonical(one.place.run) &&
    storyStage.is(page.run, storyStage.place),
  isSwept: (one) => page.run && (canonical(page.run.name) === canonical(one.place.run) ||
    one.sweep.runs.includes(page.run.name)),

  // the values of a run's steps, which are those of the number
  valuesOf(one) {
    const key = `${one.place.run} ${one.name}`;
    if (this.isOf(one)) {
      const found = page.run.series.find((s) => [s.path, s.name, slug(s.name)].includes(one.name));
      if (found) {
        this.series.set(key, found.values);
        one.unit = found.unit;
      }
    }
    return this.series.get(key) ?? [];
  },

  opened(one) { return typeof one.place.step === "number" ? one.place.step : 0; },

  go(one, i) {
    const { count } = this.dial(one);
    const to = Math.max(0, Math.min(Math.max(0, count - 1), Math.round(i))), { place } = one;
    if (one.kind === "steps" && !count) return;
    one.at = to;
    const wish = one.kind === "steps" ? { ...place, from: undefined, step: to }
      : one.sweep ? { ...place, from: undefined, run: one.sweep.runs[to] }
        : { ...place, from: undefined, knob: { [one.name]: tidy(this.dial(one).value(to)) } };
    story.took(() => storyStage.go(wish, { glide: false }));
    this.tell(one);
  },

  draggable(one) {
    const { el } = one, px = one.kind === "steps" ? 3 : one.sweep ? 13 : 4;
    let from = null;
    el.addEventListener("pointerdown", (event) => {
      if (event.button) return;
      from = [event.clientX, this.dial(one).at];
      el.setPointerCapture(event.pointerId);
      el.classList.add("held");
      el.focus({ preventScroll: true });
      event.preventDefault();
    });
    el.addEventListener("pointermove", (event) => {
      if (!from) return;
      const i = Math.round(from[1] + (event.clientX - from[0]) / px);
      if (i !== Math.round(this.dial(one).at)) this.go(one, i);
    });
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"])
      el.addEventListener(end, () => { from = null; el.classList.remove("held"); });
  },

  keyed(one) {
    const by = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 };
    one.el.addEventListener("keydown", (event) => {
      const { at, count } = this.dial(one), ends = { Home: 0, End: count - 1 };
      if (event.key === "Enter") $("#step").focus();  // from the words to the stage
      const to = ends[event.key] ?? (by[event.key] && Math.round(at) + by[event.key]);
      if (to === undefined) return;
      event.preventDefault();
      this.go(one, to);
    });
  },

  // a mark of the chart that is dragged to x moves what it names
  dragged(mark, x) {
    const words = this.numbers.find((one) => one.name === (mark.knob || mark.steps) &&
      (one.kind === "knob" || this.isOf(one)));
    if (mark.steps) {
      const found = page.run.series.find((s) => [s.path, s.name].includes(mark.steps));
      if (!found) return;
      const k = nearest(found.values, x);
      if (k === page.k) return;
      return words ? this.go(words, k) : story.took(() =>
        storyStage.go({ ...storyStage.place, step: k }, { glide: false }));
    }
    if (!words) return;
    const { count, value } = this.dial(words);
    const k = nearest(Array.from({ length: count }, (_, i) => value(i)), x);
    if (k !== Math.round(this.dial(words).at)) this.go(words, k);
  },

  // shows what every number says now, and which links lead to what is seen
  show() {
    for (const one of this.numbers) this.tell(one);
    const { run, k } = page;
    for (const link of $$("#story a[data-go]")) {
      const { run: name, step } = this.placeOf(link);
      const here = storyStage.is(run, { run: name }) && storyStage.found(run, own(step)) === k;
      link.setAttribute("aria-current", String(here));
    }
  },

  tell(one) {
    const { at, count, value } = this.dial(one), i = Math.max(0, Math.min(count - 1, Math.round(at)));
    if (!count) return;
    const unit = one.data?.unit ?? one.sweep?.unit ?? one.unit, exact = value(i);
    if (!Number.isFinite(exact)) return;
    const said = one.form.said(exact * one.form.scale(unit));
    if (one.el.textContent !== said) one.el.textContent = said;
    one.el.setAttribute("aria-valuenow", tidy(exact));
    one.el.setAttribute("aria-valuetext", said);
    one.el.setAttribute("aria-valuemin", tidy(Math.min(value(0), value(count - 1))));
    one.el.setAttribute("aria-valuemax", tidy(Math.max(value(0), value(count - 1))));
  },

  // the places under the slider of a run whose steps are the values of a number: the chart's ticks
  ticks(run) {
    const one = this.numbers.find((other) => other.kind === "steps" && this.isOf(other));
    const at = storyChart.named(run, page.k, storyStage.place.chart?.split(",")[0] ?? "")?.plot?.x;
    const values = one && at ? this.valuesOf(one) : [];
    if (!values.length) return null;
    const low = Math.min(...values), high = Math.max(...values), slack = 1e-6 * (high - low);
    const places = at.ticks.map((tick, i) => [tick, at.words[i]])
      .filter(([tick]) => tick >= low - slack && tick <= high + slack)
      .map(([tick, word]) => [nearest(values, tick), word]);
    const kept = [...new Map(places.reverse())].sort(([a], [b]) => a - b);
    return kept.length > 1 ? kept : null;  // an axis of something else says nothing of the steps
  },
};

// keeps a comma behind a number on its line
function together(el) {
  const behind = el.nextSibling, [mark] = /^[.,;:!?)]*/.exec(behind?.data ?? "");
  if (!mark) return;
  const pair = element("span", { className: "together" });
  el.replaceWith(pair);
  pair.append(el, mark);
  behind.data = behind.data.slice(mark.length);
}

// how a number is written: its digits after the point, and what stands behind it
function formOf(text) {
  const [, digits, behind] = /^\s*([−+-]?[\d.,]*)(.*?)\s*$/.exec(text);
  const places = (digits.split(".")[1] ?? "").length;
  const value = digits ? Number(digits.replace("−", "-").replaceAll(",", "")) : null;
  const wide = { mm: 1000, cm: 100, "%": 100 };
  return {
    value,
    scale: (unit) => (unit === behind.trim() ? 1 : unit === "m" || unit === "" ? wide[behind.trim()] ?? 1 : 1),
    said: (number) => {
      const said = number.toFixed(places);
      return (Number(said) ? said : said.replace("-", "")).replace("-", "−") + behind;
    },
  };
}

function nearest(values, x) {
  return values.reduce((best, value, i) =>
    (Math.abs(value - x) < Math.abs(values[best] - x) ? i : best), 0);
}

const tidy = (value) => Number(value.toPrecision(10));
