// Lets a published page compute: Python in a worker, asked for by a button and never by itself. What it computes takes the
// way of what a live server tells. PYTHON: {from: Python's folder, core: the archive, sizes: file -> bytes, bytes: of all,
// knobs, params: run -> what differs from the defaults}.
"use strict";

const compute = {
  worker: null,
  count: 0,          // of workers so far
  about: null,       // what the worker says of the lesson: {params, exercises, versions}
  live: false,       // whether the run that is open is computed here
  params: null,      // of the run that is open, or is on its way
  at: null,          // the step that is wanted of a run that is on its way
  buttons: [], whys: [],
  recordedSeen: false,  // whether a recorded run was seen since the last computed one

  offer() {
    const made = (put) => {
      const button = element("button", { type: "button", className: "compute", onclick: () => this.start(),
        title: "Loads Python into this page: then every knob moves, and your own function runs" });
      const why = element("output", { className: "why" });
      put(button, why);
      this.whys.push(why);
      return button;
    };
    this.buttons = [made((...both) => $("#tools").append(...both))];
    if ($("#to-bench")) this.buttons.push(made((...both) => $("#to-bench").before(...both)));
    const turn = $("#story .to-bench");  // where the story hands over, also on a phone
    if (turn) this.buttons.push(made((...both) => turn.after(" ", ...both)));
    this.offered();
  },

  offered(words = "Compute here") {
    const size = Math.max(1, Math.round(PYTHON.bytes / 1e6)), sized = Object.keys(PYTHON.sizes).length;
    this.say(sized ? `${words}: ${size} MB once` : `${words}: Python of ${new URL(PYTHON.from).host}`, false);
  },

  say(text, busy = true) {
    document.body.classList.toggle("computes", text.endsWith(" computes"));
    for (const button of this.buttons) Object.assign(button, { textContent: text, disabled: busy });
  },

  // why it cannot be, in one line; the recorded page goes on
  refused(text) {
    this.worker?.terminate();
    this.worker = null;
    for (const why of this.whys) why.textContent = text;
    this.offered("Try again");
  },

  start() {
    if (location.protocol === "file:")
      return this.refused("A browser lets no page compute that was opened from a disk. Behind any web server, such as python -m http.server, this one does.");
    if (typeof WebAssembly === "undefined" || typeof Worker === "undefined")
      return this.refused("This browser has no WebAssembly, and Python needs it. What is recorded plays all the same.");
    this.say("Python is coming …");
    for (const why of this.whys) why.textContent = "";
    this.guard().then(() => this.begun(), (error) => this.refused(error.message));
  },

  begun() {
    this.count += 1;
    const from = new URL(PYTHON.from, location.href).href, core = new URL(PYTHON.core, location.href).href;
    const code = `import ${JSON.stringify(new URL("../page/computing.js", location.href).href)};`;
    const own = URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
    const worker = this.worker = new Worker(own, { type: "module" });
    worker.onmessage = ({ data: { tell, ...more } }) => {
      if (worker === this.worker && Object.hasOwn(this.heard, tell)) this.heard[tell].call(this, more);
    };
    worker.onerror = (event) => this.refused(`Python cannot run here${event.message ? `: ${event.message}` : ""}. What is recorded plays all the same.`);
    this.post({ verb: "start", from, core, sizes: PYTHON.sizes, lesson: LESSON.name });
  },

  // what runs here may ask Python's folder and no other place; a worker that is made of a blob keeps to it as well, and words
  // that it sends into the page bring no script with them. The scene's frame, which has scripts within, was there before.
  async guard() {
    if (this.guarded) return;
    await shelf.client();
    const frame = stage.frame;
    if (frame.contentDocument?.readyState !== "complete" || frame.contentDocument.URL === "about:blank")
      await new Promise((done) => frame.addEventListener("load", done, { once: true }));
    this.guarded = true;
    const site = new URL("../", location.href).href, from = new URL(PYTHON.from, location.href).href;
    const places = [...new Set([`${site}python/`, from])].join(" ");
    document.head.append(element("meta", { httpEquiv: "Content-Security-Policy",
      content: `connect-src ${places}; worker-src blob: ${site} ${from}; script-src ${site} ${from} blob: 'wasm-unsafe-eval'; img-src ${site} data: blob:; font-src ${site} data:; media-src 'none'; frame-src 'none'; object-src 'none'; base-uri 'none'; form-action 'none'` }));
  },

  // ends whatever runs, a loop without end too; Python comes again, from the browser's own store
  stop() {
    this.worker?.terminate();
    this.start();
  },

  post(message) { this.worker.postMessage(message); },
  id: (run) => `here ${compute.count}.${run}`,

  heard: {
    loading({ done, all }) {
      this.say(all ? `Python: ${Math.min(99, Math.round((100 * done) / all))} %` : "Python is coming …");
    },
    failed({ text }) { this.refused(`Python could not start: ${text}. What is recorded plays all the same.`); },
    ready(about) {
      this.about = about;
      this.say(`Python ${about.versions.python.split(".").slice(0, 2).join(".")} computes`);
      this.ready();
    },
    run({ run, stopped, ...more }) {
      if (!this.live) return;
      page.told({ ...more, id: this.id(run), query: "", pinned: sceneView.series() });
      if (handles.on) sceneView.again();
      if (stopped) page.say(stopped, "wrong");
    },
    step({ run, k, step, things, scene }) {
      if (!this.live) return void arriving.wire.read(scene);  // not shown, but what is in it is not sent again
      this.at = null;
      page.came(this.id(run), k, step, things);
      if (this.recordedSeen && arriving.stage) feed.open(arriving.stage);  // a recorded run stood there
      this.recordedSeen = false;
      arriving.drew(scene);
    },
    picked({ values }) { this.change(values); },
    trouble({ text }) {
      page.say(text, "wrong");
      bench.failed(text);
    },
    used(used) { bench.used(used); },
    report({ report }) { bench.told(report); },
  },

  // Python is here: what the page lacked of knobs, handles and numbers it has from now on
  ready() {
    arriving.anew();
    if (this.recorded) return void this.again();
    const recorded = this.recorded = { open: source.open.bind(source), seek: source.seek.bind(source) };
    Object.assign(source, {
      change: (values) => this.change(values),
      click: (p_origin, v_ray) => this.live && this.post({ verb: "click", k: page.k, p_origin, v_ray }),
      handles: (on) => { handles.on = on; sceneView.again(); },
      seek: (k) => (this.live ? this.post({ verb: "seek", k }) : recorded.seek(k)),
      flush: () => this.live && arriving.flush(),
      open: (name, step) => {
        this.rest();
        this.params = this.paramsOf(name || source.open_?.name || RECORDED.open);
        return recorded.open(name, step);
      },
    });
    this.params = this.paramsOf(page.run?.name ?? RECORDED.open);
    page.listeners.push({ told: (run) => this.named(run) });
    LESSON.knobs = PYTHON.knobs;
    knobs.start();
    handles.start();
    page.tools();
    if (typeof storyWords !== "undefined") storyWords.computes();
    if (this.about.exercises.length) bench.made(this.about.exercises).catch((error) => page.say(error.message, "wrong"));
    this.named(page.run);
  },

  // Python is here again, after a stop
  again() {
    if (this.live) this.begin(this.params, page.k);
    bench.idle();
  },

  paramsOf: (run) => ({ ...compute.about.params, ...PYTHON.params[run] }),

  // a recorded run says nothing of its params
  named(run) {
    if (!run || this.live || run.params) return;
    run.params = this.params;
    knobs.show(run);
  },

  rest() {
    if (this.live) this.post({ verb: "rest" });
    Object.assign(this, { live: false, at: null, recordedSeen: true });
  },

  // the run with these values in place of those that are open, at the same place
  change(values) {
    const ended = page.run?.finished && page.k > 0 && page.k === page.known() - 1;
    this.begin({ ...this.params, ...values }, this.at ?? (ended ? -1 : page.k));
  },

  begin(params, at) {
    source.wanted += 1;  // a recorded run that is on its way is wanted no more
    Object.assign(this, { params, at, live: true });
    this.post({ verb: "begin", params, at });
  },
};

addEventListener("load", () => compute.offer());
