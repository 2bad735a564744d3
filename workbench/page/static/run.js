// What can be done with the run that is open: a recording of it, a link to it, the command that opens it.
"use strict";

const thisRun = {
  file: null,  // the link to the recording, where that is a file

  start() {
    const section = $("#this-run");
    if (!section) return;
    const said = element("output", { ariaLive: "polite" });
    const button = (textContent, act) => element("button", { type: "button", textContent, onclick: (event) => act(event.target, said) });
    const buttons = [button("Copy link", () => this.copy(this.link(), "The link to this step is copied.", said)),
      button("Copy command", () => this.copy(page.run?.command, "The command is copied.", said))];
    if (source.recording) buttons.push(button("Download recording", (own) => this.record(own, said)));
    else buttons.push(this.file = element("a", { className: "button", textContent: "Download recording", hidden: true }));
    if (source.alone) buttons.push(button("Copy for a page of your own", () => this.copy(this.frame(), "A line that shows this step of the run in a page of your own is copied.", said)));
    section.replaceChildren($("h2", section), element("div", { className: "acts" }, ...buttons), said);
    section.hidden = false;
    keys.others.c = () => buttons[0].click();
    const count = LESSON.presets.length;
    keys.numbered = LESSON.presets.map((preset) => () => page.open(preset.name, null));
    keys.more = [["C", "copy a link to this step"]];
    if (count) keys.more.push([count > 9 ? "1–9, 0" : `1–${count}`, count > 9 ? "experiments 1 to 10" : "experiments"]);
    if (count > 10) keys.more.push([`Shift + 1${count > 11 ? `–${count > 19 ? "9, 0" : count - 10}` : ""}`, `experiments 11 to ${Math.min(20, count)}`]);
  },

  link() {
    if (!page.run?.query) return null;
    const here = location.href.replace(/[?#].*$/, "");
    return `${here}${page.run.query}&step=${page.k}`;
  },

  frame() {
    const address = source.alone();
    const title = [LESSON.title, page.run?.title].filter(Boolean).join(": ");
    return address && `<iframe src="${address}#step=${page.k}" width="960" height="600" title="${escape(title)}"></iframe>`;
  },

  // where the recording is a file beside the page, it is linked
  show(run) {
    if (!this.file) return;
    const address = run && source.recorded?.(run);
    this.file.hidden = !address;
    if (address) Object.assign(this.file, { href: address, download: run.recording });
  },

  // copies a text; where the browser forbids that, it is there to be copied by hand
  async copy(text, words, said) {
    if (!text) return;
    try {
      await navigator.clipboard.writeText(text);
      said.replaceChildren(words);
    } catch {
      const field = element("input", { value: text, readOnly: true, ariaLabel: "To be copied" });
      said.replaceChildren(field);
      field.select();
    }
  },

  async record(button, said) {
    button.disabled = true;
    said.replaceChildren("Writing the run …");
    try {
      const answer = await source.recording();
      if (!answer.ok) throw new Error(await answer.text());
      const name = decodeURIComponent(/filename\*=utf-8''([^;]+)/.exec(answer.headers.get("content-disposition"))[1]);
      const link = element("a", { href: URL.createObjectURL(await answer.blob()), download: name });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 60000);
      said.replaceChildren(`${name} is in your downloads; open it with `, element("code", { textContent: `workbench replay ${name}` }), ".");
    } catch (error) {
      said.replaceChildren(error.message);
    } finally {
      button.disabled = false;
    }
  },
};
