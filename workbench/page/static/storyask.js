// Questions in their scene: the stage stands at its frozen start, the answer is played and then
// said, and the words behind it open.
"use strict";

const storyAsk = {
  waiting: new Map(),  // question -> function that takes what came of it

  start() {
    for (const form of $$("#story .ask")) {
      const range = $("[type=range]", form);
      for (const words of this.later(form)) words.hidden = true;
      form.addEventListener("change", () => this.given(form) && this.ready(form));
      form.addEventListener("submit", (event) => {
        event.preventDefault();
        this.answer(form, this.given(form));
      });
      $("[data-skip]", form).onclick = () => this.answer(form, null);
      for (const input of $$("input:not([type=radio], [type=range])", form))
        input.addEventListener("input", () => this.ready(form, this.given(form) !== undefined));
      if (range) {
        range.addEventListener("input", () => this.put(form, Number(range.value)));
        $(".given", form).textContent =
          `${this.said(form, range.min)} to ${this.said(form, range.max)}`;
      }
      for (const label of $$("label", form)) this.wrapped(label);
    }
    this.recall();
  },

  // the words of a choice in one element, so that they stand beside their button
  wrapped(label) {
    const input = $("input[type=radio]", label);
    if (!input) return;
    const words = element("span", {}, ...[...label.childNodes].filter((node) => node !== input));
    label.append(words);
  },

  later: (form) => $$(".later", form.closest(".scene")).filter((words) =>
    form.compareDocumentPosition(words) & Node.DOCUMENT_POSITION_FOLLOWING),

  isOpen: (form) => !form.classList.contains("done"),

  ready(form, on = true) { $(".go", form).disabled = !on; },

  given(form) {
    const chosen = $("input[type=radio]:checked", form), range = $("[type=range]", form);
    if (chosen) return chosen.value;
    if (range) return form.dataset.moved ? range.value : undefined;
    const typed = $("input:not([type=radio])", form);
    return typed ? numberIn(typed.value) : undefined;
  },

  // a number is said by the slider or in the chart, where it is a flag
  put(form, value) {
    const range = $("[type=range]", form), at = $(".given", form);
    range.value = value;
    form.dataset.moved = "yes";
    if (at) at.textContent = this.said(form, range.value);
    range.setAttribute("aria-valuetext", this.said(form, range.value));
    this.ready(form);
    if (form.dataset.flag) this.flag(Number(range.value));
  },

  said(form, value) {
    const unit = form.dataset.unit ?? "", tight = ["deg", "°"].includes(unit);
    return `${String(value).replace("-", "−")}${tight ? "°" : unit && ` ${unit}`}`;
  },

  flag(x) {
    storyChart.flag = x;
    storyChart.show();
  },

  // the stage stands in a scene: a flag may be put while its question is open, and is seen after it
  entered(scene) {
    const form = scene && $(".ask[data-flag]", scene), range = form && $("[type=range]", form);
    const open = form && this.isOpen(form) && !form.classList.contains("asked");
    storyChart.put = open && range ? (x) => this.put(form, x) : null;
    storyChart.flag = form?.dataset.moved ? Number(range.value) : null;
  },

  async answer(form, given) {
    if (given === undefined || form.classList.contains("asked")) return;
    const { question } = form.dataset, start = STORY.starts[question] ?? {};
    form.classList.add("asked");
    for (const input of $$("input", form)) input.disabled = true;
    storyChart.put = null;
    if (given === null) delete form.dataset.moved;
    const told = await new Promise((resolve) => {
      this.waiting.set(question, resolve);
      source.predict(question, given, { stay: true });
    });
    if (told.trouble) return this.again(form, told.trouble);
    await story.took(async () => {
      const { seen = { step: "stop" }, ...asked } = start;
      const place = { ...story.placeAt(form), ...asked, from: undefined };
      const here = (seen.run ?? place.run) === place.run;  // else its picture is another run's
      if (!(await storyStage.go(place))) return;
      if (here) await storyStage.play(seen.step, 7, { back: true });
      else await storyStage.go({ ...place, ...seen });
    }, { lasts: () => story.here?.el !== form });  // other words are read: it is their hand's
    this.tell(form, { ...told, given });
    const kept_ = kept.get(`answers ${LESSON.name}`) ?? {}, before = kept_[question];
    kept.set(`answers ${LESSON.name}`, { ...kept_, [question]: { ...before, story: { ...told, given } } });
  },

  again(form, trouble) {
    form.classList.remove("asked");
    for (const input of $$("input", form)) input.disabled = false;
    $(".reply", form).textContent = trouble;
    this.entered(story.scene);
  },

  answered(answer) {
    this.waiting.get(answer.question)?.(answer);
    this.waiting.delete(answer.question);
  },

  // what happened, and why what was said is wrong
  tell(form, { given, right, truth, why, reply }) {
    const skipped = given === null || given === undefined;
    form.classList.add("asked", "done");
    story.answered(form);
    for (const label of $$("label:has([type=radio])", form)) {
      const { value } = $("input", label);
      label.classList.toggle("right", value === truth);
      label.classList.toggle("missed", !skipped && value === given && !right);
    }
    const radio = $("[type=radio]", form), known = reply ? [reply] : [];
    const truly = radio ? [] : [skipped ? `It is ${this.worded(truth)}.` : why
      ? `You said ${this.said(form, given)}.`
      : `You said ${this.said(form, given)}, it is ${this.worded(truth)}.`];
    if (skipped) this.shown(form, truth);
    const words = right ? [why] : skipped ? [why || truly[0]] : [...truly, ...known, why];
    $(".reply", form).replaceChildren(...(right ? [element("b", { textContent: "Right. " })] : []),
      words.filter(Boolean).join(" "));
    for (const one of this.later(form)) one.hidden = false;
    this.entered(story.scene);
    story.measure();
    storyChart.show();
  },

  // where a reader said no number, the slider stands at the right one
  shown(form, truth) {
    const range = $("[type=range]", form), value = parseFloat(truth);
    if (!range || !Number.isFinite(value)) return;
    range.value = value;
    $(".given", form).textContent = this.said(form, range.value);
  },

  worded: (truth) => String(truth).replace(/^-/, "−").replace(/ deg$/, "°"),

  // what was answered in this browser before
  recall() {
    const before = kept.get(`answers ${LESSON.name}`) ?? {};
    for (const form of $$("#story .ask")) {
      const told = before[form.dataset.question]?.story;
      if (!told) continue;
      for (const input of $$("input", form)) {
        if (input.type === "radio") input.checked = input.value === told.given;
        else if (told.given !== null) {
          input.value = told.given;
          form.dataset.moved = "yes";
        }
        input.disabled = true;
      }
      this.tell(form, told);
    }
  },
};
