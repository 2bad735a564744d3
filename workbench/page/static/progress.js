// What was done in this browser: told on the course page; and the lessons before and after the one that is open. COURSE holds
// all lessons in order, {name, title, needs}.
"use strict";

const progress = {
  visit(lesson, questions) {
    kept.set("visited", { ...kept.get("visited"), [lesson]: questions });
    kept.set("last", lesson);
  },

  // what is known of a lesson: {said, share, all}; of a story how many scenes were seen, else how
  // many questions are answered; null where it was never open
  of(lesson) {
    const story = kept.get(`scenes ${lesson}`), questions = (kept.get("visited") ?? {})[lesson];
    if (story?.seen?.length) {
      const { seen: { length: seen }, of } = story, count = Math.min(seen, of);
      return { said: count < of ? `${count} of ${of} scenes` : `✓ all ${of} scenes`, share: count / of, all: count === of };
    }
    if (questions === undefined) return null;
    const answered = Math.min(Object.keys(kept.get(`answers ${lesson}`) ?? {}).length, questions);
    const all = answered === questions;
    if (!questions) return { said: "✓ opened", share: 1, all };
    if (!answered) return { said: "✓ opened", share: 0, all };
    return { said: `${all ? "✓ " : ""}${answered} of ${questions} questions`, share: answered / questions, all };
  },

  tick() {
    for (const card of $$("[data-card]")) {
      const done = this.of(card.dataset.card), bar = $(".bar", card);
      $(".done", card).textContent = done?.said ?? "";
      bar.hidden = !done?.share;
      $("span", bar).style.width = `${100 * (done?.share ?? 0)}%`;
      card.classList.toggle("all", Boolean(done?.all));
    }
    if ($("#again")) this.again();
  },

  // the way back to where one was; behind a lesson that is done, to the next one that is not
  again() {
    const cards = $$("[data-card]"), last = kept.get("last");
    const at = cards.findIndex((card) => card.dataset.card === last), link = $("#again");
    const rest = cards.slice(at), is = (card) => this.of(card.dataset.card);
    const card = at < 0 ? undefined : rest.find((one) => !is(one)?.all);
    link.hidden = !card;
    $("#begin").classList.toggle("button", !card);
    link.classList.toggle("button", Boolean(card));
    if (!card) return;
    const to = $("h3 a", card), known = kept.get(`scenes ${card.dataset.card}`), same = card === cards[at];
    const scene = same && known?.at ? `#${encodeURIComponent(known.at)}` : "";
    link.href = to.getAttribute("href") + scene;
    link.textContent = same
      ? `Continue: ${[to.textContent, scene && known.title].filter(Boolean).join(", ")} →` : `Next: ${to.textContent} →`;
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
    progress.around();
  }
});
addEventListener("pageshow", () => progress.tick()); // also when one comes back to it
