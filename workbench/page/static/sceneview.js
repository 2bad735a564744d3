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
