// What was done in this browser, told on the course page; and the lessons before and after the one that is open. COURSE holds
// all lessons in order, {name, title, needs}.
"use strict";

const progress = {
  visit(lesson, questions) { kept.set("visited", { ...kept.get("visited"), [lesson]: questions }); },

  // what a card says of its lesson: done is what has all its questions answered
  said(lesson) {
    const questions = (kept.get("visited") ?? {})[lesson];
    if (questions === undefined) return "";
    const answered = Object.keys(kept.get(`answers ${lesson}`) ?? {}).length;
    const count = questions ? `, ${Math.min(answered, questions)} of ${questions} questions answered` : "";
    return `✓ ${answered >= questions ? "done" : "opened"}${count}`;
  },

  tick() {
    for (const card of $$("[data-card]")) {
      const said = this.said(card.dataset.card);
      $(".done", card).textContent = said;
      card.classList.toggle("all", said.startsWith("✓ done"));
    }
  },

  around() {
    const nav = $("#around");
    if (!nav || typeof COURSE === "undefined") return;
    const here = COURSE.findIndex((one) => one.name === LESSON.name);
    const link = (one, words, rel) => one && element("a", { rel, href: nav.dataset.address.replace("LESSON", one.name) },
      element("small", { textContent: words }), element("span", { textContent: one.title }));
    nav.replaceChildren(...[link(COURSE[here - 1], "← before", "prev"), link(COURSE[here + 1], "next →", "next"),
      this.ways("Builds on", COURSE.filter((one) => COURSE[here]?.needs.includes(one.name)), nav),
      this.ways("Leads to", COURSE.filter((one) => one.needs.includes(LESSON.name)), nav)].filter(Boolean));
  },

  ways(words, lessons, nav) {
    const links = lessons.flatMap((one, i) => [i ? ", " : "",
      element("a", { href: nav.dataset.address.replace("LESSON", one.name), textContent: one.title })]);
    return lessons.length && element("p", {}, `${words} `, ...links);
  },
};

document.addEventListener("DOMContentLoaded", () => {
  if (typeof LESSON !== "undefined") {
    progress.visit(LESSON.name, LESSON.questions.length);
    return progress.around();
  }
  const dark = kept.get("dark") ?? matchMedia("(prefers-color-scheme: dark)").matches;
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  progress.tick();
});
addEventListener("pageshow", () => progress.tick()); // also when one comes back to it
