// A student's function that drives the lesson: what the checks found, the first difference, and its source.
"use strict";

const exercise = {
  mine: null,  // {name, html} of the student's file
  flag: null,

  start() {
    if (source.tells) source.tells.exercise = (told) => this.told(told);
    document.addEventListener("click", (event) => {
      if (event.target.closest("#difference")) this.go();
    });
  },

  go() {
    if (page.run?.mark == null) return;
    transport.pause();
    page.seek(page.run.mark);
  },

  told({ source: mine, report }) {
    this.mine = mine;
    const box = $("#exercise .report");
    if (!box) return;
    const checks = (report.checks ?? []).map((check) => element("li", { className: check.word },
      element("b", { textContent: check.mark }), ` ${check.promise} `, element("i", { textContent: check.points }),
      element("p", { textContent: check.message })));
    box.replaceChildren(element("p", { className: "count", textContent: report.said }),
      ...(report.mistake ? [element("p", { className: "mistake", textContent: report.mistake })] : []),
      element("ul", {}, ...checks),
      ...[["In this run your code printed:", report.ran], ["In the checks it printed:", report.printed]].flatMap(
        ([where, text]) => (text ? [element("p", { textContent: where }), element("pre", { textContent: text })] : [])));
    panels.show();
  },

  marks(run) { return run.mark == null ? [] : [{ at: run.mark, title: "first difference" }]; },

  // what is true of the run: whether it calls the function; the mark over the slider, and the button that goes there
  show(run) {
    for (const said of $$("#exercise [data-called]")) said.hidden = said.dataset.called !== String(run?.called);
    const at = run?.mark ?? null, button = $("#difference");
    if (button) button.disabled = at === null;
    if (at === null) return this.flag?.remove();
    const slider = $("#step");
    if (!slider.parentElement.classList.contains("rail")) {
      const rail = element("span", { className: "rail" });
      slider.replaceWith(rail);
      rail.append(slider);
    }
    this.flag ??= element("button", { type: "button", className: "flag", onclick: () => this.go() });
    const words = `First difference to the reference: step ${at}`;
    Object.assign(this.flag, { title: words, ariaLabel: words });
    this.flag.style.left = `calc(8px + (100% - 16px) * ${at / Math.max(1, page.known() - 1)})`;
    if (!this.flag.isConnected) slider.after(this.flag);
  },

  // the student's own source before that of the algorithm that calls it; where it failed the line is marked
  source(box, at) {
    if (!this.mine) return;
    const mine = element("div", { innerHTML: `<p><b>${escape(this.mine.name)}</b>${page.run?.called === false ? ": this run does not call your function." : ": your function."}</p><div class="lines" tabindex="0">${this.mine.html}</div>` });
    if (at.wrong) {
      $(".here", box)?.classList.remove("here"); // the eye goes to one line
      $(`[data-line="${at.wrong}"]`, mine)?.classList.add("here", "wrong");
    }
    box.classList.add("two");
    box.prepend(mine);
  },

  // brings the marked line of each of two sources into sight; tells whether there are two
  scrolled(body) {
    for (const lines of $$(".two .lines", body)) {
      const line = $(".here", lines);
      if (line) lines.scrollTop = line.offsetTop - lines.offsetTop - 0.5 * lines.clientHeight;
    }
    return $(".two", body) !== null;
  },
};
