// A lesson whose files are edited while it is open: the page takes the new one, or says what is wrong with it.
"use strict";

const edited = {
  takes: 0,

  start() {
    source.tells.lesson = ({ lesson }) => this.take(lesson);
    source.tells.notice = ({ text }) => this.notice(text);
  },

  async take(lesson) {
    const takes = ++this.takes, handles = ({ knobs }) => knobs.some((knob) => knob.by === "gizmo");
    if (handles(lesson) !== handles(LESSON)) return void location.reload(); // the stage has other buttons
    for (const name of Object.keys(LESSON)) delete LESSON[name];
    Object.assign(LESSON, lesson);
    knobs.start();
    if (page.run) knobs.show(page.run);
    const answer = await fetch(`?lesson=${encodeURIComponent(lesson.name)}`);
    const found = new DOMParser().parseFromString(await answer.text(), "text/html");
    if (takes !== this.takes) return; // saved again meanwhile
    const top = $("#article").scrollTop, kept = $("#article > nav.top");
    $("#article").replaceChildren(...(kept ? [kept] : []), ...[...$("#article", found).children].filter((part) => !part.matches("nav.top")));
    $("#article").scrollTop = top;
    document.title = found.title;
    article.recall();
    for (const part of [thisRun, text]) part.start();
    progress.around();
    page.draw();
    this.notice("");
  },

  notice(text) {
    let box = $("#notice");
    if (!box) {
      box = element("p", { id: "notice" });
      box.setAttribute("role", "alert");
      $("#view").append(box);
    }
    box.hidden = !text;
    box.textContent = text;
  },
};

document.addEventListener("DOMContentLoaded", () => edited.start());
