// What was done in this browser: lessons that were opened, and ticks on the course page.
"use strict";

const progress = {
  visit(lesson) { kept.set("visited", { ...kept.get("visited"), [lesson]: true }); },

  // what a card says of its lesson: done is what has all its questions answered
  said(lesson, questions) {
    const answered = Object.keys(kept.get(`answers ${lesson}`) ?? {}).length;
    if (!answered && !(kept.get("visited") ?? {})[lesson]) return "";
    const count = questions ? `, ${Math.min(answered, questions)} of ${questions} questions answered` : "";
    return `✓ ${answered >= questions ? "done" : "opened"}${count}`;
  },

  tick() {
    for (const card of $$("[data-questions]")) {
      const said = this.said(card.dataset.lesson, Number(card.dataset.questions));
      $(".done", card).textContent = said;
      card.classList.toggle("all", said.startsWith("✓ done"));
    }
  },
};

document.addEventListener("DOMContentLoaded", () => {
  if (document.body.dataset.lesson) return progress.visit(document.body.dataset.lesson);
  const dark = kept.get("dark") ?? matchMedia("(prefers-color-scheme: dark)").matches;
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  progress.tick();
});
addEventListener("pageshow", () => document.body.dataset.lesson || progress.tick());
