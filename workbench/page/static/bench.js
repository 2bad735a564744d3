// A student's function on a page that computes: written here, run, judged, and kept in this browser alone.
"use strict";

const bench = {
  all: new Map(),  // exercise -> {told: what is known of it, box, state, editor}
  at: null,        // the one that was run last
  driving: null,   // the one whose function drives the lesson
  wanted: null,    // {one, text} that Python was given
  verdict: null,   // what the checks found, below the one that was run last

  // Python is here: each exercise of the page gets a place to write in
  async made(exercises) {
    await this.loaded();
    this.verdict = element("div", { className: "watched" });
    const at = $("#exercise .task pre");
    if (at) at.before(element("p", { textContent: "On a computer of your own:" }));
    const tasks = $$("#exercise .task"), named = (name) => tasks.find((task) => $("h3", task).textContent === name);
    for (const told of exercises) if (named(told.name)) this.put(named(told.name), told);
  },

  loaded() {
    return new Promise((done, failed) => document.head.append(element("script", { src: "../page/codemirror.js", onload: done,
      onerror: () => failed(new Error("The editor could not be loaded.")) })));
  },

  key: (name) => `my ${LESSON.name} ${name}`,

  put(task, told) {
    const one = { told, state: element("output", {}), text: kept.get(this.key(told.name)) ?? told.starter };
    const button = (text, onclick, title = "") => element("button", { type: "button", textContent: text, onclick, title });
    const file = element("input", { type: "file", accept: ".py", hidden: true, onchange: () => this.opened(one, file) });
    const place = element("div", { className: "writing" });
    one.run = button("Run", () => this.run(one), "Ctrl+Enter in the text");
    one.run.classList.add("button");
    one.stop = button("Stop", () => this.stop(one), "Ends your code, even a loop without end");
    one.stop.disabled = true;
    one.own = button("The lesson's own again", () => this.use(one, ""));
    one.own.hidden = true;
    one.box = element("div", { className: "bench" }, place, element("div", { className: "acts" }, one.run, one.stop, one.own,
      button("Download my file", () => this.download(one), "Ready to be handed in, and to go on with at home"),
      button("Open a file", () => file.click()), file, button("Begin anew", () => this.anew(one))), one.state);
    $("p", task).after(one.box);
    one.editor = this.editor(place, one);
    this.all.set(told.name, one);
  },

  editor(parent, one) {
    const { EditorView, EditorState, python, keymap } = CodeMirror;
    const save = () => { kept.set(this.key(one.told.name), one.editor.state.doc.toString()); };
    let later;
    return new EditorView({ parent, state: EditorState.create({ doc: one.text, extensions: [
      CodeMirror.lineNumbers(), CodeMirror.history(), CodeMirror.indentOnInput(), CodeMirror.bracketMatching(),
      CodeMirror.closeBrackets(), CodeMirror.highlightActiveLine(), CodeMirror.indentUnit.of("    "), EditorState.tabSize.of(4),
      CodeMirror.syntaxHighlighting(CodeMirror.classHighlighter), python(),
      EditorView.contentAttributes.of({ "aria-label": `Your ${one.told.name}: Escape, then Tab, leaves the text` }),
      keymap.of([{ key: "Mod-Enter", run: () => (this.run(one), true) }, ...CodeMirror.closeBracketsKeymap,
        ...CodeMirror.defaultKeymap, ...CodeMirror.historyKeymap, CodeMirror.indentWithTab]),
      EditorView.updateListener.of(({ docChanged }) => { if (docChanged) { clearTimeout(later); later = setTimeout(save, 300); } }),
    ] }) });
  },

  write(one, text) {
    one.editor.dispatch({ changes: { from: 0, to: one.editor.state.doc.length, insert: text } });
  },

  anew(one) {
    const before = one.editor.state.doc.toString();
    if (before === one.told.starter) return;
    this.write(one, one.told.starter);
    this.say(one, "Your text is gone from here; Ctrl+Z in it brings it back.");
  },

  async opened(one, file) {
    const [given] = file.files;
    file.value = "";
    if (!given) return;
    if (given.size > 200000) return this.say(one, `${given.name} has more than 200 kB.`);
    this.write(one, await given.text());
    this.say(one, `${given.name} is open.`);
  },

  download(one) {
    const link = element("a", { href: URL.createObjectURL(new Blob([one.editor.state.doc.toString()], { type: "text/x-python" })), download: one.told.file });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  },

  say(one, text) { one.state.textContent = text; },

  run(one) {
    if (!one.stop.disabled) return;
    this.at = one;
    this.verdict.remove();
    this.busy(one, true);
    this.say(one, "Running …");
    one.slow = setTimeout(() => this.say(one, "Still running. A loop without end ends by Stop; your text stays."), 4000);
    this.use(one, one.editor.state.doc.toString());
  },

  use(one, text) {
    this.wanted = { one, text };
    compute.post({ verb: "use", name: one.told.name, text });
  },

  // Python has taken the text, or says why it cannot
  used({ trouble, source: mine }) {
    if (!this.wanted) return;
    const { one, text } = this.wanted;
    this.wanted = null;
    one.own.hidden = !text || Boolean(trouble);
    if (trouble) {
      this.driving = null;
      return this.told({ said: trouble }, mine);
    }
    this.mine = text ? mine : null;
    if (!text) {
      this.gone();
      return compute.begin(compute.params, page.k);
    }
    const run = one.told.preset || "default", same = this.driving === one;
    this.driving = one;
    compute.begin(same ? compute.params : compute.paramsOf(run), same && compute.live ? page.k : 0);
    compute.post({ verb: "judge", name: one.told.name, text });
  },

  // what the checks found, by name, with the first difference to the reference
  told(report, mine = this.mine) {
    const one = this.at, name = one.told.name;
    this.done(one);
    const run = one.told.preset || "default", code = () => element("code", { textContent: name });
    this.verdict.replaceChildren(...(this.driving !== one ? [] : [
      element("p", { hidden: true }, "Your ", code(), " drives this lesson. Where the two differ, the run of the reference is the faint ghost."),
      element("p", { hidden: true, className: "mistake" }, "This run never calls ", code(), ", so it looks the same whatever it does. ",
        element("button", { type: "button", textContent: `Open “${one.told.title || "the lesson's own run"}”`, onclick: () => compute.begin(compute.paramsOf(run), 0) })),
      element("p", {}, element("button", { type: "button", id: "difference", disabled: true, textContent: "Go to the first difference" }))]),
      element("div", { className: "report", role: "status" }));
    if (this.driving === one) [true, false].forEach((called, i) => { this.verdict.children[i].dataset.called = called; });
    one.box.append(this.verdict);
    exercise.told({ source: mine, report });
    exercise.show(page.run);
  },

  // no function of theirs drives the lesson any more
  gone() {
    this.driving = null;
    this.verdict.remove();
    exercise.told({ source: null, report: { said: "" } });
  },

  busy(one, is) {
    one.run.disabled = is;
    one.stop.disabled = !is;
  },

  done(one) {
    clearTimeout(one.slow);
    this.busy(one, false);
    this.say(one, "");
  },

  stop(one) {
    this.done(one);
    this.wanted = null;
    one.own.hidden = true;
    this.gone();
    this.say(one, "Stopped. Python comes back in a moment; your text is as it was.");
    one.run.disabled = true;
    compute.stop();
  },

  // Python is back after a stop
  idle() {
    for (const one of this.all.values()) {
      this.busy(one, false);
      this.say(one, "");
    }
  },

  // Python failed on a text in a way that it has no words for
  failed(text) {
    const one = this.at;
    if (one && !one.stop.disabled) this.told({ said: text });
  },
};
