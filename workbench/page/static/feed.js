// Shows recorded steps in viser's client, which waits in the frame as for a server: what a server would send is made here.
// What is shown is made equal to the step that is wanted, whatever was shown before, so that any step follows any other.
"use strict";

const GLIDE = 250; // milliseconds in which a thing that only moves gets to its new place
const NARROWEST = 1.2; // width of a picture by its height; in a narrower one a scene is seen from farther away
const WIDEST = 1.6; // up to this width by height, what was in view stays in view in a picture that becomes narrower
const MESHES = new Set(["MeshMessage", "GlbMessage"]);
const IDENTITY = { wxyz: [1, 0, 0, 0], position: [0, 0, 0], visible: true };

// the nodes of a scene by name after each step: {add: the message that made it, props, wxyz, position, visible}
function nodesOfSteps(steps) {
  let nodes = new Map();
  return steps.map((messages) => {
    nodes = new Map(nodes);
    const change = (name, values) => nodes.has(name) && nodes.set(name, { ...nodes.get(name), ...values });
    for (const message of messages) {
      const { type, name } = message;
      if (message.props && name !== undefined) {
        nodes.delete(name); // what is made anew comes last
        nodes.set(name, { ...IDENTITY, add: message, props: message.props });
      } else if (type === "SceneNodeUpdateMessage") change(name, { props: { ...nodes.get(name)?.props, ...message.updates } });
      else if (type === "SetOrientationMessage") change(name, { wxyz: message.wxyz });
      else if (type === "SetPositionMessage") change(name, { position: message.position });
      else if (type === "SetSceneNodeVisibilityMessage") change(name, { visible: message.visible });
      else if (type === "RemoveSceneNodeMessage") {
        for (const other of [...nodes.keys()]) if (other === name || other.startsWith(`${name}/`)) nodes.delete(other);
      }
    }
    return nodes;
  });
}

const feed = window.feed = { // viser's page in the frame looks for it
  client: null,        // viser's end of the wire
  waiting: [],         // what is sent before it is there
  shown: new Map(),    // name -> node, with the name it has in the client
  made: 0,             // how many nodes got a name of their own
  gliding: 0,          // the frame request of what glides
  camera: "",          // how the scene that is open is first seen
  keeps: NARROWEST,    // width by height of what stays in view
  dark: false,

  // what stands in front of viser's page: its worker, which would open a websocket, is this page
  before: "<script>window.Worker=class{constructor(){this.postMessage=(said)=>said.type==='set_server'&&parent.feed.connect(this)}" +
    "terminate(){}}<\/script>",

  connect(client) {
    this.client = client;
    this.say({ type: "connected" });
    this.send(this.waiting.splice(0));
    for (const kind of ["pointerdown", "wheel"]) stage.frame.contentDocument.addEventListener(kind, () => { this.turned = true; }, { passive: true });
    new ResizeObserver(() => this.aim()).observe(stage.frame);
  },

  send(messages) {
    if (!messages.length) return;
    if (this.client) this.say({ type: "message_batch", messages });
    else this.waiting.push(...messages);
  },

  say(data) { this.client.onmessage({ data }); },

  theme(dark) {
    this.dark = dark;
    this.send([{ type: "ThemeConfigurationMessage", titlebar_content: null, control_layout: "floating", control_width: "medium",
      show_logo: false, show_share_button: false, dark_mode: dark, colors: null }]);
  },

  // a scene opens: its light, and its camera unless it is the one that was there, which a person may have turned since
  open(first) {
    const of = (start) => first.filter((message) => message.type.startsWith(start));
    const cameras = of("SetCamera"), camera = JSON.stringify(cameras);
    const still = first.filter((message) => message.name === undefined && !message.type.startsWith("SetCamera"));
    const root = first.filter((message) => message.name === "" && message.type === "SetOrientationMessage");
    const order = ["SetCameraUpDirectionMessage", "SetCameraPositionMessage", "SetCameraLookAtMessage", "SetCameraFovMessage"];
    const isFirst = !this.camera;
    this.send([...(isFirst ? root : []), ...still]); // the client puts the camera back where it was when the root is turned
    if (camera === this.camera) return;
    Object.assign(this, { camera, seen: isFirst ? cameras : order.flatMap(of), turned: false });
    this.aim(isFirst);
  },

  // puts the camera where the recording had it, as far away as a narrow picture needs; not where a person has turned it since
  aim(initial = false) {
    if (this.turned || !this.seen) return;
    const { clientWidth: width, clientHeight: height } = stage.frame, aspect = width / height || NARROWEST;
    this.keeps = Math.max(this.keeps, Math.min(aspect, WIDEST));
    const far = Math.max(1, this.keeps / aspect);
    const target = this.seen.find((message) => message.type === "SetCameraLookAtMessage")?.look_at;
    const eye = (p) => p.map((value, i) => target[i] + far * (value - target[i]));
    this.send(this.seen.map((message) => ({ ...message, ...(initial ? {} : { initial: false }),
      ...(message.type === "SetCameraPositionMessage" && target ? { position: eye([...message.position]) } : {}) })));
  },

  // shows these nodes; `glide` lets what only moves move, `next` says that they follow what is shown
  show(wanted, { glide = false, next = false } = {}) {
    cancelAnimationFrame(this.gliding);
    const { sent, moves } = this.changes(wanted, next);
    if (glide && moves.length) {
      this.send(sent);
      this.glide(moves);
    } else this.send([...sent, ...moves.flatMap(([, to, name]) => pose(name, to))]);
  },

  changes(wanted, next) {
    const sent = [], moves = [];
    for (const [name, node] of this.shown) {
      if (wanted.has(name)) continue;
      sent.push({ type: "RemoveSceneNodeMessage", name: node.name, owner: "" });
      this.shown.delete(name);
    }
    let veiled = false; // by a surface that is new: the client draws in the order in which things were made
    for (const [name, node] of wanted) {
      const old = this.shown.get(name), base = this.under(name);
      const same = old && old.add === node.add && old.base === base;
      const again = same && veiled && !next && node.add.type === "LineSegmentsMessage";
      if (again || (old && old.base !== base)) sent.push({ type: "RemoveSceneNodeMessage", name: old.name, owner: "" });
      const now = { ...node, base, name: again ? `${base}~~${++this.made}` : old && old.base === base ? old.name : base };
      this.shown.set(name, now);
      if (!same || again) {
        sent.push({ ...node.add, name: now.name, props: node.props }, ...pose(now.name, node), visibility(now));
        veiled ||= MESHES.has(node.add.type);
        continue;
      }
      const updates = Object.fromEntries(Object.entries(node.props).filter(([key, value]) => value !== old.props[key]));
      if (Object.keys(updates).length) sent.push({ type: "SceneNodeUpdateMessage", name: now.name, owner: "", updates });
      if (node.visible !== old.visible) sent.push(visibility(now));
      const from = old.at ?? old;
      if (String([from.wxyz, from.position]) !== String([node.wxyz, node.position])) moves.push([from, node, now.name, now]);
    }
    return { sent, moves };
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
      this.send(moves.flatMap(([from, to, name, now]) => {
        now.at = part < 1 ? between(from, to, eased) : undefined;
        return pose(name, now.at ?? to);
      }));
      if (part < 1) this.gliding = requestAnimationFrame(frame);
    };
    frame(start);
  },
};

function pose(name, { wxyz, position }) {
  return [{ type: "SetOrientationMessage", name, wxyz, owner: "" }, { type: "SetPositionMessage", name, position, owner: "" }];
}

function visibility({ name, visible }) { return { type: "SetSceneNodeVisibilityMessage", name, visible, owner: "" }; }

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
