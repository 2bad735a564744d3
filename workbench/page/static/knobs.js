// Knobs in a drawer beside the scene: made from the lesson's params, where a home can change them.
"use strict";

const knobs = {
  inputs: {},  // name -> [[slider, number] or [input], ...], one for each entry of a vector

  start() {
    const rows = source.change ? LESSON.knobs.map((knob) => this.row(knob)) : source.sweep ? sweeps.made() : [];
    const own = source.change && typeof files !== "undefined" ? files.rows() : [];
    const reset = element("button", { type: "button", textContent: "Reset", title: "Back to the default run (R)", onclick: () => source.reset() });
    this.first = element("div", {}, ...rows);
    this.idle = element("details", { hidden: true }, element("summary"));
    $("#drawer").replaceChildren(element("div", { className: "knobs" }, this.first, this.idle, ...own, reset));
    $("#set").onclick = () => this.toggle();
  },

  toggle() {
    const drawer = $("#drawer");
    drawer.hidden = !drawer.hidden;
    $("#set").setAttribute("aria-expanded", String(!drawer.hidden));
    if (!drawer.hidden) $("input, select, button", drawer).focus({ preventScroll: true });
  },

  row(knob) {
    const range = knob.low === undefined ? "" : `${number(knob.low)} to ${number(knob.high)}${knob.unit ? ` ${this.unit(knob)}` : ""}`;
    const box = element("fieldset", { className: "knob" }, element("legend", {}, `${knob.label} `, element("small", { textContent: range })));
    const hint = element("p", { className: "hint", id: `hint-${knob.name}`, textContent: knob.hint });
    const parts = knob.parts ?? [""];
    this.inputs[knob.name] = parts.map((part, i) => {
      const inputs = this.made(knob, i);
      const whole = inputs.length === 1 ? "whole" : "";
      for (const input of inputs) {
        input.setAttribute("aria-label", [knob.label, part, knob.unit && `(${knob.unit})`].filter(Boolean).join(" "));
        input.setAttribute("aria-describedby", hint.id);
      }
      if (inputs[1]) inputs[1].setAttribute("aria-label", `${inputs[0].getAttribute("aria-label")}, as a number`);
      box.append(element("label", { className: whole }, element("span", { textContent: part }), ...inputs));
      return inputs;
    });
    box.append(hint, element("p", { className: "why" }));
    box.dataset.knob = knob.name;
    return box;
  },

  unit: (knob) => (knob.unit === "deg" ? "°" : knob.unit),

  made(knob, i) {
    if (knob.kind === "choice") {
      const select = element("select", {}, ...knob.choices.map((c) => element("option", { value: c, textContent: c.replaceAll("_", " ") })));
      select.addEventListener("change", () => this.wish(knob));
      return [select];
    }
    if (knob.kind === "bool") {
      const box = element("input", { type: "checkbox" });
      box.addEventListener("change", () => this.wish(knob));
      return [box];
    }
    const limits = { min: knob.low, max: knob.high, step: knob.step };
    const slider = element("input", { type: "range", ...limits }), typed = element("input", { type: "number", ...limits, step: "any" });
    slider.addEventListener("input", () => { typed.value = this.shown(slider.value); this.wish(knob); });
    typed.addEventListener("change", () => {
      const value = Math.min(knob.high, Math.max(knob.low, Number(typed.value)));
      if (typed.value === "" || !Number.isFinite(value)) return void (typed.value = this.shown(slider.value));
      typed.value = this.shown(value);
      slider.value = value;
      this.wish(knob, i, value);
    });
    return [slider, typed];
  },

  // tells what is wanted; a typed number is not rounded to the slider's step
  wish(knob, typedAt, typed) {
    const values = this.inputs[knob.name].map(([input], i) =>
      i === typedAt ? typed : input.type === "checkbox" ? input.checked : input.tagName === "SELECT" ? input.value : Number(input.value));
    source.change({ [knob.name]: knob.kind === "floats" || knob.kind === "ints" ? values : values[0] });
  },

  shown: (value) => String(Number(Number(value).toPrecision(5))),

  // sets every knob to the params of the run, without that being a wish; one that a hand is on leads
  show({ params: known, files: open, aside }) {
    const params = { ...(aside ? {} : open), ...known };  // a file that is open counts by its name
    for (const knob of LESSON.knobs) {
      const values = [params[knob.name]].flat();
      (this.inputs[knob.name] ?? []).forEach((inputs, i) => inputs.forEach((input) => {
        if (input.type === "checkbox") input.checked = values[i];
        else if (input !== document.activeElement || input.tagName === "SELECT") input.value = input.type === "number" ? this.shown(values[i]) : values[i];
      }));
      this.ground(knob, params);
    }
    this.sort();
  },

  // what has an effect stands first, in the lesson's order; what has none is folded below
  sort() {
    const boxes = LESSON.knobs.map((knob) => this.box(knob)).filter(Boolean);
    const later = (box) => (other) => boxes.indexOf(other) > boxes.indexOf(box);
    for (const box of boxes) {
      const home = box.disabled ? this.idle : this.first;
      if (box.parentElement !== home) home.insertBefore(box, [...home.children].find(later(box)) ?? null);
    }
    const count = this.idle.children.length - 1;
    this.idle.hidden = !count;
    $("summary", this.idle).textContent = `${count} more ${count === 1 ? "has" : "have"} no effect here`;
  },

  box: (knob) => $(`.knob[data-knob="${CSS.escape(knob.name)}"]`),

  // greys a knob out that has no effect under what the others say, and says why
  ground(knob, params) {
    const box = this.box(knob);
    if (!box) return;
    const missing = Object.entries(knob.needs ?? {}).filter(([name, wanted]) => !wanted.includes(params[name] ?? null));
    const said = ([name, wanted]) => {
      const label = [...LESSON.knobs, ...LESSON.files].find((one) => one.name === name)?.label ?? name;
      if (wanted[0] === null) return `no file of your own is open as ${label}`;
      return `${label} is ${wanted.map((value) => value === true ? "on" : value === false ? "off" : value).join(" or ")}`;
    };
    const idle = !missing.length && (page.run?.idle ?? []).includes(knob.name);
    box.disabled = missing.length > 0 || idle;
    $(".why", box).textContent = idle ? "Has no effect in this run."
      : missing.length ? `Has an effect only where ${missing.map(said).join(" and ")}.` : "";
  },
};
