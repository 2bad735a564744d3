// The article: links that run things, experiments, and questions that are answered before one looks.
"use strict";

const article = {
  start() {
    document.addEventListener("click", (event) => {
      const link = event.target.closest("[data-run]");
      if (!link || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      const step = link.dataset.step === undefined ? null : Number(link.dataset.step);
      page.open(link.dataset.run, step);
      if (getComputedStyle($("#stage")).position === "static") $("#stage").scrollIntoView();  // elsewhere it is in view
    });
    document.addEventListener("submit", (event) => {
      const form = event.target.closest("form.question");
      if (!form) return;
      event.preventDefault();
      this.answer(form, event.submitter && event.submitter.value === "skip");
    });
    const light = (kind, on) => document.addEventListener(kind, ({ target }) => {
      const term = target.closest(".term, [data-things]");
      if (term) stage.light(on ? term.dataset.thing ?? term.dataset.things.split("|")[0] : "");
    });
    light("pointerover", true);
    light("focusin", true);
    light("pointerout", false);
    light("focusout", false);
    this.recall();
  },

  // shows what was answered in this browser before
  recall() {
    const before = kept.get(`answers ${LESSON.name}`) ?? {};
    for (const form of $$("form.question")) {
      const said = before[form.dataset.question];
      if (said) this.tell(form, said);
    }
  },

  answer(form, skip) {
    const chosen = $("input[type=radio]:checked", form), typed = $("input:not([type])", form);
    const given = skip ? null : chosen ? chosen.value : typed ? numberIn(typed.value) : undefined;
    if (given === undefined) $("output", form).textContent = `${typed ? "Type a number" : "Choose an answer"} first, or skip.`;
    else source.predict(form.dataset.question, given);
  },

  // what came of a prediction; it stays answered in this browser
  answered(answer) {
    page.tell("answered", answer);
    const { question, given, right, truth, why, reply, trouble } = answer;
    const form = $(`form.question[data-question="${CSS.escape(question)}"]`);
    if (!form) return;
    if (trouble) return void ($("output", form).textContent = trouble);
    const chosen = $("input[type=radio]", form), quoted = (answer) => chosen ? `“${answer}”` : answer;
    const verdict = given === null ? `The answer: ${quoted(truth)}.` : `Right: ${quoted(truth)}.`;
    const refuted = [`You said ${quoted(given)}.`, reply, `The run says ${quoted(truth)}.`];
    const said = [...(given === null || right ? [verdict] : refuted), why].filter(Boolean).join(" ");
    this.tell(form, { said, right, skipped: given === null });
    kept.set(`answers ${LESSON.name}`, { ...kept.get(`answers ${LESSON.name}`), [question]: { said, right, skipped: given === null } });
  },

  tell(form, { said, right, skipped }) {
    form.classList.toggle("right", right && !skipped);
    form.classList.add("answered");
    $("output", form).textContent = said;
  },

  // marks the experiment that is open, and the links to the step that is seen
  show(run, k) {
    const usual = run.name === "default" ? LESSON.presets.filter((preset) => !Object.keys(preset.params).length) : [];
    const open = [run.name, ...usual.map((preset) => preset.name)];
    for (const button of $$("button[data-run]")) button.setAttribute("aria-pressed", String(open.includes(button.dataset.run)));
    for (const link of $$("a[data-run]")) {
      const step = Number(link.dataset.step), at = step < 0 ? run.known + step : step;
      const here = (!link.dataset.run || link.dataset.run === run.name) && link.dataset.step !== undefined && at === k && (step >= 0 || run.finished);
      link.setAttribute("aria-current", String(here));
    }
  },
};
