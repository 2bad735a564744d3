// Taking a run along: its link, its recording, a line that embeds it, and the command that opens it live.
"use strict";

const take = {
  open() {
    const { run } = page;
    if (run) beside.lay("Take this run along", element("div", { className: "take" }, ...this.rows(run)));
  },

  rows(run) {
    const rows = [this.line("Link to this step", location.href)];
    if (run.recording) {
      const address = `${RECORDED.runs}${run.recording}`;
      rows.push(element("p", {}, element("a", { href: address, download: run.recording, textContent: "Download the recording for Rerun (.rrd)" })));
    }
    if (run.alone) {
      const frame = `<iframe src="${new URL(run.alone, location.href)}" width="960" height="600" title="${escape(document.title)}"></iframe>`;
      rows.push(this.line("In a page of your own", frame));
    }
    if (run.command) rows.push(this.line("Live, where the workbench is installed", run.command));
    return rows;
  },

  line(what, words) {
    const copy = element("button", { type: "button", textContent: "Copy" });
    copy.onclick = async () => {
      try {
        await navigator.clipboard.writeText(words);
        copy.textContent = "Copied";
      } catch { // a page from disk may not: the text is marked, and Ctrl+C takes it
        getSelection().selectAllChildren(shown);
      }
    };
    const shown = element("code", { textContent: words });
    return element("p", {}, element("span", { textContent: what }), copy, shown);
  },
};

document.addEventListener("DOMContentLoaded", () => {
  if ($("#take")) $("#take").onclick = () => take.open();
});
