// Shows nodes in viser's client, which waits in the frame as for a server: what a server would send is made here, and what the
// client would tell a server is heard here. What is shown is made equal to what is wanted, whatever was shown before.
"use strict";

const GLIDE = 250; // milliseconds in which a thing that only moves gets to its new place
const NARROWEST = 1.2; // width of a picture by its height; in a narrower one as much is seen in its width
const WIDEST = 1.6; // up to this width by height, what was in view stays in view in a picture that becomes narrower
const SURFACES = new Set(["MeshMessage", "GlbMessage"]);
const IN_PLACE = new Set(["PointCloudMessage", "LineSegmentsMessage", "TransformControlsMessage"]); // changed without being made anew

const feed = window.feed = { // viser's client in the frame looks for it
  client: null,        // its end of the wire
  realm: null,         // its window
  shown: new Map(),    // name -> node, with its props and the name it has in the client
  wanted: new Map(),   // name -> node
  made: 0,             // how many nodes got a name of their own
  gliding: 0,          // the frame request of what glides
  stage: null,         // {light, camera, own: the camera it came with} of the scene that is open
  led: null,           // the camera where somebody else leads it
  keeps: NARROWEST,    // width by height of what stays in view
  watching: null,      // tells of another size of the frame
  picks: false,        // whether clicks are heard
  dark: false,
  heard: {},           // what the client says -> function: who hears it

  // the client is there, for the first time or because its frame was loaded again: it has nothing
  connect(client) {
    Object.assign(this, { client, realm: stage.frame.contentWindow, arrays: new WeakMap() });
    this.shown.clear();
    this.come(this.realm);
    this.say({ type: "connected" });
    this.theme(this.dark);
    this.clicks(this.picks);
    if (this.stage) {
      this.send(this.stage.light);
      this.aim(true);
    }
    this.show(this.wanted);
    (this.watching ??= new ResizeObserver(() => this.fit())).observe(stage.frame);
  },

  hear(message) { this.heard[message.type]?.(message); },

  send(messages) { if (this.client && messages.length) this.say({ type: "message_batch", messages }); },

  say(data) { this.client.onmessage({ data }); },

  theme(dark) {
    this.dark = dark;
    this.send([{ type: "ThemeConfigurationMessage", titlebar_content: null, control_layout: "floating", control_width: "medium",
      show_logo: false, show_share_button: false, dark_mode: dark, colors: null }]);
    this.again();
  },

  // a scene opens: its light, and its camera unless it is the one that was there, which a person may have turned since
  open(told) {
    const before = this.stage, camera = this.led ?? told.camera;
    const isNew = JSON.stringify(before?.camera) !== JSON.stringify(camera);
    this.stage = { ...told, camera, own: told.camera };
    this.send(told.light);
    if (isNew) this.aim(!before);
  },

  // takes the camera from the scenes and puts it somewhere; null gives it back where it is
  lead(camera) {
    this.led = camera;
    if (!camera || !this.stage) return;
    this.stage.camera = camera;
    this.aim();
  },

  // puts the camera where the scene wants it
  aim(initial = false) {
    const { eye, target, up } = this.stage.camera;
    this.send([
      { type: "SetCameraUpDirectionMessage", position: up, initial }, { type: "SetCameraPositionMessage", position: eye, initial },
      { type: "SetCameraLookAtMessage", look_at: target, initial },
    ]);
    labels.seen(this.stage.camera);
    this.fit(initial); // and of its angle the words hear there
  },

  // lets a picture that has become narrower show as much in its width as it did; the camera stays where it is
  fit(initial = false) {
    if (!this.stage) return;
    const { clientWidth: width, clientHeight: height } = stage.frame, aspect = width / height || NARROWEST;
    this.keeps = Math.max(this.keeps, Math.min(aspect, WIDEST));
    const fov = 2 * Math.atan(Math.tan(this.stage.camera.fov / 2) * Math.max(1, this.keeps / aspect));
    this.send([{ type: "SetCameraFovMessage", fov, initial }]);
    labels.seen({ fov });
  },

  clicks(on) {
    this.picks = on;
    this.send([{ type: "ScenePointerEnableMessage", event_type: "click", modifiers: on ? [null] : [], owner: "" }]);
  },

  // shows these nodes; `glide` lets what only moves move, `next` says that they follow what is shown
  show(wanted, { glide = false, next = false } = {}) {
    this.wanted = wanted;
    if (!this.client) return;
    cancelAnimationFrame(this.gliding);
    const { sent, moves } = this.changes(wanted, next);
    if (glide && moves.length) {
      this.send(sent);
      this.glide(moves);
    } else {
      this.send(sent);
      this.send(moves.flatMap(([, to, now]) => this.placed(now, to)));
    }
    labels.show(this.shown);
  },

  // shows the same as things are now: another theme, or a picture that has been made
  again() { this.show(this.wanted); },

  changes(wanted, next) {
    const sent = [], moves = [];
    const remove = (name, node) => {
      for (const [below, part] of this.shown) if (below.startsWith(`${name}/`)) remove(below, part); // first, since they go with it
      this.shown.delete(name);
      if (node.kind.type !== "Label") sent.push({ type: "RemoveSceneNodeMessage", name: node.name, owner: "" });
    };
    for (const [name, node] of this.shown) if (!wanted.has(name)) remove(name, node);
    let veiled = false; // by a surface that is new: the client draws in the order in which things were made
    for (const [name, node] of wanted) {
      const props = propsOf(node, this.dark), old = this.shown.get(name), base = this.under(name), { kind } = node;
      if (!props) continue; // shown as soon as it is made
      const changed = old && old.base === base ? differing(old, kind, props) : null;
      const again = changed && veiled && !next && kind.type === "LineSegmentsMessage";
      const toWords = old && !changed && kind.type === "Label"; // the client knows no words: none takes the place of what was
      if (again || toWords || (old && old.base !== base)) remove(name, old);
      const now = { ...node, props, base, name: again ? `${base}~~${++this.made}` : old && old.base === base ? old.name : base };
      this.shown.set(name, now);
      if (!changed || again) {
        sent.push(...this.added(now));
        veiled ||= SURFACES.has(kind.type);
        continue;
      }
      const keys = Object.keys(changed);
      if (keys.length && kind.type !== "Label") sent.push({ type: "SceneNodeUpdateMessage", name: now.name, owner: "", updates: this.theirs(changed) });
      const from = old.at ?? old;
      if (String([from.wxyz, from.position]) === String([node.wxyz, node.position])) continue;
      if (keys.length && kind.type !== "Label") sent.push(...this.placed(now, node)); // what changes does not glide
      else moves.push([from, node, now]);
    }
    return { sent, moves };
  },

  added(node) {
    const { kind, name, props } = node;
    if (kind.type === "Label") return [];
    return [{ type: kind.type, name, props: this.theirs(props), owner: "", virtual: false }, ...this.placed(node, node),
      { type: "SetSceneNodeVisibilityMessage", name, visible: kind.visible, owner: "" }];
  },

  placed(node, { wxyz, position }) {
    if (node.kind.type === "Label") return [];
    return [{ type: "SetOrientationMessage", name: node.name, wxyz, owner: "" }, { type: "SetPositionMessage", name: node.name, position, owner: "" }];
  },

  // properties with arrays of the client's own window: it knows no others
  theirs(props) {
    return Object.fromEntries(Object.entries(props).map(([key, value]) => {
      if (!ArrayBuffer.isView(value)) return [key, value];
      if (!this.arrays.has(value)) this.arrays.set(value, new this.realm[value.constructor.name](value.buffer, value.byteOffset, value.length));
      return [key, this.arrays.get(value)];
    }));
  },

  // a node's name below that of its parent, which goes with it
  under(name) {
    const cut = name.lastIndexOf("/"), parent = cut > 0 && this.shown.get(name.slice(0, cut));
    return parent ? parent.name + name.slice(cut) : name;
  },

  glide(moves) {
    const start = performance.now();
    const frame = (time) => {
      const part = Math.min(1, Math.max(0, (time - start) / GLIDE)), eased = part * part * (3 - 2 * part);
      this.send(moves.flatMap(([from, to, now]) => {
        now.at = part < 1 ? between(from, to, eased) : undefined;
        return this.placed(now, now.at ?? to);
      }));
      labels.place();
      if (part < 1) this.gliding = requestAnimationFrame(frame);
    };
    frame(start);
  },
};
feed.ready = new Promise((resolve) => { feed.come = resolve; }); // the client's window

// the properties in which a node that is shown differs; null where it is to be made anew
function differing(old, kind, props) {
  if (old.props === props) return {};
  if (old.kind.type !== kind.type || old.kind.visible !== kind.visible) return null;
  const found = {};
  for (const [key, value] of Object.entries(props)) {
    const before = old.props[key];
    if (value === before || (!ArrayBuffer.isView(value) && JSON.stringify(value) === JSON.stringify(before))) continue;
    if (kind.type === "Label") return { text: value };
    if (!IN_PLACE.has(kind.type) || (ArrayBuffer.isView(value) && value.length !== before?.length)) return null;
    found[key] = value;
  }
  return found;
}

// a pose on the way: turned along the shorter arc at an even pace, moved along a line
function between(from, to, part) {
  const dot = from.wxyz.reduce((sum, value, i) => sum + value * to.wxyz[i], 0), sign = dot < 0 ? -1 : 1;
  const angle = Math.acos(Math.min(1, Math.abs(dot))), sine = Math.sin(angle);
  const [a, b] = sine < 1e-6 ? [1 - part, part] : [Math.sin((1 - part) * angle) / sine, Math.sin(part * angle) / sine];
  return {
    wxyz: from.wxyz.map((value, i) => a * value + sign * b * to.wxyz[i]),
    position: from.position.map((value, i) => (1 - part) * value + part * to.position[i]),
  };
}
