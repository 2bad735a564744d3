// What the scene shows of the step that is seen: its nodes, what stands out of them, the pinned step behind them, the handles.
"use strict";

const sceneView = {
  nodes: null,   // of the step
  path: "",      // what stands out, because somebody reads of it
  pinned: null,  // {nodes, run} of the step that stands behind

  // shows a step; `by` is how many steps it follows what is shown, 0 where it does not
  step(nodes, by) {
    this.nodes = nodes;
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.again({ glide: Math.abs(by) === 1 && !still && !this.path, next: by === 1 });
    stage.arrived();
  },

  again(how) {
    if (!this.nodes) return;
    const seen = this.path ? lit(this.nodes, this.path) : this.nodes;
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
