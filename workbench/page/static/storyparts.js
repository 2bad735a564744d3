// What the page has around a story's words: the line above them, dots, plate, chart, marks, and the
// way from one face to the other.
"use strict";

const storyParts = {
  build({ scenes }) {
    this.top();
    this.dots(scenes);
    this.stage();
    this.turnScene();
    for (const link of $$('#story a[href^="#"]:not([data-go])')) link.addEventListener("click", (event) => {
      const i = story.named(link.getAttribute("href"));
      if (i < 0) return;
      event.preventDefault();
      story.to(i);
    });
    for (const box of $$("#story pre")) box.tabIndex = 0;
    const back = element("button", { type: "button", id: "to-story", textContent: "Story",
      title: "The story of this lesson (W)", onclick: () => story.turn("story") });
    $("#article nav.top")?.prepend(back);
  },

  top() {
    const course = $("#article nav.top a"), minutes = STORY.minutes && `${STORY.minutes} min`;
    const button = (id, text, words, act) => {
      const made = element("button", { type: "button", id, textContent: text, title: words, onclick: act });
      made.setAttribute("aria-label", words);
      return made;
    };
    const nav = element("nav", { id: "story-top" },
      element("a", { href: course?.getAttribute("href") ?? "#", textContent: "Geometry workbench" }),
      element("span", { textContent: [STORY.chapter, minutes].filter(Boolean).join(" · ") }),
      button("story-theme", "◐", "Light or dark (T)", () => keys.others.t()),
      button("story-help", "?", "Keys (?)", () => keys.others["?"]()));
    nav.setAttribute("aria-label", "Course");
    $("#story").prepend(nav);
  },

  dots(scenes) {
    const dots = scenes.map((scene, i) => element("a", { href: `#${scene.id}`, onclick: (event) => {
      event.preventDefault();
      story.to(i);
    } }, element("span", { textContent: scene.dataset.title })));
    const nav = element("nav", { id: "dots" }, ...dots);
    nav.setAttribute("aria-label", "Scenes");
    $("#story").after(nav);
    this.seen = new Set(kept.get(`scenes ${LESSON.name}`)?.seen ?? []);
  },

  stage() {
    const back = element("button", { type: "button", id: "back", textContent: "↩ back to the text",
      title: "Back to the text (B)", hidden: true, onclick: () => story.give() });
    const bench = element("button", { type: "button", id: "to-bench", textContent: "Workbench",
      title: "All knobs, charts and code of this run (W)", onclick: () => story.turn("bench") });
    $("#stage").prepend(element("header", { id: "plate" },
      element("div", {}, element("b"), element("span")), back, bench));
    $("#view").append(element("p", { id: "wait", textContent: "The picture is on its way …", hidden: true }));
    const chart = element("figure", { id: "story-chart" });
    chart.innerHTML = '<svg role="img"></svg>';
    $("#caption").after(chart);
    const step = $("#step");
    if (!step.parentElement.classList.contains("rail")) {
      const rail = element("span", { className: "rail" });
      step.replaceWith(rail);
      rail.append(step);
    }
    step.parentElement.append(element("div", { id: "marks" }));
  },

  // the last scene hands over to the workbench, and to the lesson that follows
  turnScene() {
    const scene = $("#story .turn") ?? $("#story .scene:last-of-type");
    if (!scene) return;
    if (scene.matches(".turn") && !$("[data-bench]", scene)) scene.append(element("p", {},
      element("button", { type: "button", className: "button to-bench", textContent: "Open the workbench",
        onclick: () => story.turn("bench") })));
    for (const link of $$("[data-bench]")) link.addEventListener("click", (event) => {
      event.preventDefault();
      story.turn("bench");
    });
    const nav = element("nav", { id: "story-around" });
    nav.setAttribute("aria-label", "Lessons before and after");
    $("#story").append(nav);
    queueMicrotask(() => this.around(nav));
  },

  around(nav) {
    const address = $("#around")?.dataset.address;
    if (!address || typeof COURSE === "undefined") return;
    const here = COURSE.findIndex((one) => one.name === LESSON.name);
    const link = (one, rel, words) => one && element("a", { rel, textContent: words(one.title),
      href: address.replace("LESSON", one.name) });
    nav.replaceChildren(...[link(COURSE[here - 1], "prev", (title) => `← ${title}`),
      link(COURSE[here + 1], "next", (title) => `${title} →`)].filter(Boolean));
  },

  // the dot of the scene that is read; what was read is kept in this browser
  mark(scene) {
    if (!scene) return;
    this.seen.add(scene.id);
    $$("#dots a").forEach((dot, i) => {
      const own = story.scenes[i];
      dot.classList.toggle("seen", this.seen.has(own.id));
      if (own === scene) dot.setAttribute("aria-current", "true");
      else dot.removeAttribute("aria-current");
    });
    kept.set(`scenes ${LESSON.name}`, { seen: [...this.seen], at: scene.id,
      title: scene.dataset.title, of: story.scenes.length });
  },

  // in the scene's frame: a wheel scrolls the story, with Ctrl it comes nearer; a hand stops the camera
  tidied(inside) {
    inside.addEventListener("pointerdown", () => storyStage.turned(), { capture: true });
    inside.addEventListener("wheel", (event) => {
      if (page.face !== "story" || event.ctrlKey) return;
      event.stopImmediatePropagation();
      event.preventDefault();
      const unit = event.deltaMode === 1 ? 18 : event.deltaMode === 2 ? innerHeight : 1;
      scrollBy({ top: unit * event.deltaY, behavior: "instant" });
    }, { capture: true, passive: false });
  },
};
