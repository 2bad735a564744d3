// The course around a lesson: ticks for what was done in this browser, and the lessons before and after this one. COURSE
// holds all lessons in order, {name, title}.
"use strict";

const course = {
  // what was done of the lesson that is open
  note() {
    if (typeof LESSON === "undefined") return;
    const answered = $$("form.question.answered").length, before = kept.get(`done ${LESSON.name}`) ?? {};
    kept.set(`done ${LESSON.name}`, {
      answered, questions: LESSON.questions.length, seen: Boolean(before.seen || (page.run && page.run.seen)),
    });
  },

  ticks() {
    for (const card of $$("[data-card]")) {
      const done = kept.get(`done ${card.dataset.card}`);
      if (!done) continue;
      const all = done.answered >= done.questions && (done.questions || done.seen);
      const said = done.questions ? `${done.answered} of ${done.questions} questions answered` : done.seen ? "seen to its end" : "opened";
      $(".done", card).textContent = all ? `✓ done: ${said}` : said;
      card.classList.toggle("all", Boolean(all));
    }
  },

  around() {
    const nav = $("#around");
    if (!nav || typeof COURSE === "undefined") return;
    const here = COURSE.findIndex((one) => one.name === LESSON.name);
    const link = (one, words, rel) => one && element("a", { rel, href: nav.dataset.address.replace("LESSON", one.name) },
      element("small", { textContent: words }), one.title);
    nav.replaceChildren(...[link(COURSE[here - 1], "← before", "prev"), link(COURSE[here + 1], "next →", "next")].filter(Boolean));
  },
};

if ($("body.course")) {
  const dark = kept.get("dark") ?? matchMedia("(prefers-color-scheme: dark)").matches;
  document.documentElement.dataset.theme = dark ? "dark" : "light";
}
addEventListener("visibilitychange", () => course.note());
addEventListener("pagehide", () => course.note());
addEventListener("pageshow", () => course.ticks()); // also when one comes back to it
document.addEventListener("DOMContentLoaded", () => course.around());
