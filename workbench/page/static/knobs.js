// Knobs in a drawer over the scene: made from the lesson's params, where a home can change them.
"use strict";

const knobs = {
  inputs: {},  // name -> [input, ...], one for each entry of a vector

  start() {
    const drawer = $("#drawer");
    if (!drawer) return;
    const reset = element("button", { type: "button", textContent: "Reset", onclick: () => source.reset() });
    drawer.replaceChildren(...LESSON.knobs.map((knob) => this.row(knob)), ...files.rows(), reset);
    $("#set").onclick = () => this.toggle();
  },

  toggle() {
    const drawer = $("#drawer");
    drawer.hidden = !drawer.hidden;
    $("#set").setAttribute("aria-expanded", String(!drawer.hidden));
  },

  row(knob) {
    const unit = knob.unit ? ` (${knob.unit})` : "";
    const box = element("fieldset", { className: "knob" }, element("legend", { textContent: `${knob.label}${unit}`, title: knob.hint }));
    const parts = knob.kind === "bool" || knob.kind === "choice" ? [""] : knob.parts;
    this.inputs[knob.name] = parts.map((part, i) => {
      const input = this.input(knob, part);
      const change = () => source.change({ [knob.name]: this.value(knob) });
      input.addEventListener(knob.kind === "choice" || knob.kind === "bool" ? "change" : "input", change);
      const shown = element("output");
      const label = element("label", { title: knob.hint }, element("span", { textContent: part }), input, shown);
      input.setAttribute("aria-label", `${knob.label} ${part}${unit}`.trim());
      box.append(label);
      return input;
    });
    return box;
  },

  input(knob) {
    if (knob.kind === "choice") return element("select", {}, ...knob.choices.map((c) => element("option", { value: c, textContent: c })));
    if (knob.kind === "bool") return element("input", { type: "checkbox" });
    return element("input", { type: "range", min: knob.low, max: knob.high, step: knob.step });
  },

  value(knob) {
    const values = this.inputs[knob.name].map((input) => input.type === "checkbox" ? input.checked : input.tagName === "SELECT" ? input.value : Number(input.value));
    return knob.kind === "floats" || knob.kind === "ints" ? values : values[0];
  },

  // sets every knob to the params of the run, without that being a wish; one that a hand is on leads
  show(params) {
    for (const knob of LESSON.knobs) {
      const values = [params[knob.name]].flat();
      (this.inputs[knob.name] ?? []).forEach((input, i) => {
        const said = input.parentElement.querySelector("output");
        if (input.type === "checkbox") input.checked = values[i];
        else if (input !== document.activeElement || input.tagName === "SELECT") input.value = values[i];
        if (input.type === "range") said.textContent = number(values[i]);
      });
    }
  },
};
