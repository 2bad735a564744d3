// What the scene shows of the step that is seen: its nodes, what stands out of them, the pinned step behind them, the handles.
"use strict";

const sceneView = {
  nodes: null,   // of the step
  path: "",      // what stands out, because somebody reads of it
  hide: [],      // paths of what is left out
  swift: false,  // whether what moves is put there without gliding
  pinned: null,  // {nodes, run} of the step that stands behind

  // shows a step; `by` is how many steps it follows what is shown, 0 where it does not
  step(nodes, by) {
    this.nodes = nodes;
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const far = page.face === "story" ? 2 : 1;
    const glide = by !== 0 && Math.abs(by) <= far && !still && !this.path && !this.swift;
    this.again({ glide, next: by === 1 });
    stage.arrived();
  },

  again(how) {
    if (!this.nodes) return;
    const kept = this.hide.length ? without(this.nodes, this.hide) : this.nodes;
    const seen = this.path ? lit(kept, this.path) : kept;
    feed.show(handles.with(this.pinned ? withGhosts(seen, this.pinned.nodes) : seen), how);
  },

  light(path) {
    if (path === this.path) return;
    this.path = path;
    this.again();
  },

  // keeps the step that is shown behind the next ones, or lets it go
  pin(on = !this.pinned) {
    if (on && !(page.run && this.nodes)) return;
    this.pinned = on ? { nodes: this.nodes, run: page.run } : null;
    if (page.run) page.told({ id: page.run.id, pinned: this.series() });
    this.again();
  },

  // the curves of the pinned run
  series() { return this.pinned?.run.series ?? null; },
};

// scenes that come in bytes, a step at a time: what was sent once is not sent again
const arriving = {
  wire: new Wire(),
  stage: null,  // how the scene is first seen
  seen: null,   // {run, k}: of which step the scene is
  drawn: null,  // {run, k, nodes} of a step that has come and is not shown

  anew() { Object.assign(this, { wire: new Wire(), stage: null, seen: null, drawn: null }); },

  // shows a step's scene; a story lets one pass that is only on the way to the one it wants
  drew(bytes) {
    const { run, k, nodes, stage: how } = this.wire.read(bytes);
    if (how) feed.open(this.stage = how);
    this.drawn = { run, k, nodes: this.wire.nodes(nodes) };
    if (page.face === "bench" || storyStage.awaits(k)) this.flush();
  },

  flush() {
    if (!this.drawn) return;
    const { run, k, nodes } = this.drawn, by = this.seen?.run === run ? k - this.seen.k : 0;
    this.drawn = null;
    this.seen = { run, k };
    sceneView.step(nodes, by);
  },
};
