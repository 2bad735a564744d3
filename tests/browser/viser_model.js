// A page with viser's client modelled, as far as its scene tree goes (viser 1.1.1: MessageHandler.tsx, SceneTreeState.ts):
// nodes come and go and are placed at once; properties and visibility wait for the end of what is handled together, or for the
// next message that makes or removes a node of that name. An added node takes the place of one of its name and keeps its pose
// and visibility; a removal takes what is below with it.
"use strict";

const clock = { now: 0, frames: [], number: 0 };
performance.now = () => clock.now;
window.requestAnimationFrame = (act) => { clock.frames.push([++clock.number, act]); return clock.number; };
window.cancelAnimationFrame = (number) => { clock.frames = clock.frames.filter(([one]) => one !== number); };

// lets time pass, with one picture at its end
function tick(milliseconds = 0) {
  clock.now += milliseconds;
  for (const [, act] of clock.frames.splice(0)) act(clock.now);
}

function finish() {
  for (let k = 0; clock.frames.length; k++) {
    if (k > 99) throw new Error("it moves for ever");
    tick(50);
  }
}

class Client {
  constructor() { Object.assign(this, { nodes: new Map(), poses: new Map(), queue: [], said: [], wrong: [], made: 0, busy: false, dark: null, camera: {} }); }

  onmessage({ data }) {
    if (data.type === "connected") { this.connected = true; return; }
    if (data.type !== "message_batch") throw new Error(`a client is not told ${data.type}`);
    this.said.push(...data.messages);
    this.queue.push(...data.messages);
    if (!this.busy) this.handle();
  }

  // all that has come is handled together
  handle() {
    const parked = new Map();
    const drain = (name) => { for (const apply of parked.get(name) ?? []) apply(); parked.delete(name); };
    const park = (name, apply) => parked.set(name, [...(parked.get(name) ?? []), () => (this.nodes.has(name) ? apply(this.nodes.get(name)) : this.wrong.push(`${name} is not there`))]);
    for (const message of this.queue.splice(0)) {
      const { type, name } = message;
      if ("props" in message) { drain(name); this.add(message); }
      else if (type === "RemoveSceneNodeMessage") { drain(name); this.remove(name); }
      else if (type === "SceneNodeUpdateMessage") { this.foreign(message.updates); park(name, (node) => { node.props = { ...node.props, ...message.updates }; }); }
      else if (type === "SetSceneNodeVisibilityMessage") park(name, (node) => { node.visible = message.visible; });
      else if (type === "SetOrientationMessage") this.place(name, { wxyz: message.wxyz });
      else if (type === "SetPositionMessage") this.place(name, { position: message.position });
      else if (type === "ThemeConfigurationMessage") this.dark = message.dark_mode;
      else if (type.startsWith("SetCamera")) this.camera[type] = message.position ?? message.look_at ?? message.fov;
    }
    for (const name of parked.keys()) drain(name);
  }

  add({ type, name, props }) {
    this.foreign(props);
    const before = this.nodes.get(name);
    this.nodes.delete(name);
    this.nodes.set(name, { type, props, visible: before?.visible ?? true, made: ++this.made });
  }

  remove(name) {
    for (const one of [...this.nodes.keys()]) if (one === name || one.startsWith(`${name}/`)) { this.nodes.delete(one); this.poses.delete(one); }
  }

  place(name, pose) {
    if (!this.nodes.has(name)) this.wrong.push(`${name} is placed, and is not there`);
    this.poses.set(name, { ...(this.poses.get(name) ?? { wxyz: [1, 0, 0, 0], position: [0, 0, 0] }), ...pose });
  }

  // arrays of another window are none to it
  foreign(props) {
    for (const [key, value] of Object.entries(props)) {
      if (ArrayBuffer.isView(value) && !(value instanceof stage.frame.contentWindow[value.constructor.name])) this.wrong.push(`${key} is of another window`);
    }
  }

  // what is drawn: type, properties and place in the world of each visible node, by the name that a scene gives it
  seen() {
    const found = {};
    for (const [name, node] of this.nodes) {
      const chain = name.split("/").slice(1).map((_, i, all) => `/${all.slice(0, i + 1).join("/")}`).filter((one) => this.nodes.has(one));
      if (chain.some((one) => !this.nodes.get(one).visible)) continue;
      const at = chain.map((one) => this.poses.get(one) ?? { wxyz: [1, 0, 0, 0], position: [0, 0, 0] }).reduce(composed);
      const key = name.replace(/~~\d+/g, "");
      if (found[key]) this.wrong.push(`${key} is there twice`);
      found[key] = { type: node.type, props: node.props, ...at, made: node.made };
    }
    return found;
  }
}

function composed(a, b) {
  const [w, x, y, z] = a.wxyz, [W, X, Y, Z] = b.wxyz, [p, q, r] = b.position;
  const t = [2 * (y * r - z * q), 2 * (z * p - x * r), 2 * (x * q - y * p)];
  return {
    wxyz: [w * W - x * X - y * Y - z * Z, w * X + x * W + y * Z - z * Y, w * Y - x * Z + y * W + z * X, w * Z + x * Y - y * X + z * W],
    position: [p + w * t[0] + y * t[2] - z * t[1], q + w * t[1] + z * t[0] - x * t[2], r + w * t[2] + x * t[1] - y * t[0]].map((value, i) => value + a.position[i]),
  };
}

// what stands for an array: its numbers where they are few, else their first and a sum (FNV-1a); nobody changes an array
const sums = new WeakMap();
function told(array) {
  const known = sums.get(array.buffer) ?? sums.set(array.buffer, new Map()).get(array.buffer);
  const key = `${array.constructor.name} ${array.byteOffset} ${array.length}`;
  if (!known.has(key)) {
    let sum = 2166136261;
    for (const byte of new Uint8Array(array.buffer, array.byteOffset, array.byteLength)) sum = Math.imul(sum ^ byte, 16777619) >>> 0;
    known.set(key, `${array.constructor.name} of ${array.length}: ${array.slice(0, 12).join()} ${array.length > 12 ? sum : ""}`);
  }
  return known.get(key);
}

// plain data that is equal where two pictures are
function plain(value) {
  if (ArrayBuffer.isView(value)) return told(value);
  if (Array.isArray(value)) return value.map((one) => plain(one));
  if (value && typeof value === "object") return Object.fromEntries(Object.entries(value).filter(([name]) => name !== "made").map(([name, one]) => [name, plain(one)]));
  return typeof value === "number" ? Math.round(value * 1e9) / 1e9 + 0 : value;
}

// all that is to be seen, nodes and words, in plain data
function seen() {
  const found = plain(client.seen());
  for (const [name, word] of labels.words) {
    found[`word ${name}`] = { word: word.textContent, opacity: Number(word.style.opacity), small: word.className, position: plain(labels.nodes.get(name).position) };
  }
  return found;
}

// what tells two of these apart, in as many words as fit
function difference(found, wanted) {
  const [a, b] = [found, wanted].map((one) => JSON.parse(one));
  const names = [...new Set([...Object.keys(a), ...Object.keys(b)])].filter((name) => JSON.stringify(a[name]) !== JSON.stringify(b[name]));
  return names.map((name) => `${name} is ${JSON.stringify(a[name])?.slice(0, 400)}, not ${JSON.stringify(b[name])?.slice(0, 400)}`).join("; ");
}

const byName = (found) => JSON.stringify(Object.fromEntries(Object.entries(found).sort(([a], [b]) => (a < b ? -1 : 1))));

// waits for pictures that are being made
async function settled() {
  for (let k = 0; [...feed.wanted.values()].some((node) => propsOf(node, feed.dark) === null); k++) {
    if (k > 2000) throw new Error("a picture never comes");
    await new Promise((done) => setTimeout(done, 5));
  }
  finish();
}

// the page's own parts that stand around the scene
let client = null;
const stage = { frame: null, arrived() {} };
const page = { run: { id: 1, series: [], params: {} }, told() {} };
const source = { changed: [], clicked: [], change(values) { this.changed.push(values); }, click(...ray) { this.clicked.push(ray); } };
const scenes = []; // {nodes, stage} as they were read

function connect() {
  client = new Client();
  feed.connect(client);
}

function read(wire, base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0)), head = wire.read(bytes.buffer);
  scenes.push({ nodes: wire.nodes(head.nodes), stage: head.stage ?? scenes.at(-1)?.stage });
  return head;
}

const pinned = (i) => (i === null ? null : { nodes: scenes[i].nodes, run: page.run });

// what a page of its own shows of this
const known = new Map();
async function alone({ i, path = "", pin = null, dark = false }) {
  const key = JSON.stringify([i, path, pin, dark]), before = client;
  if (!known.has(key)) {
    feed.client = null; // who asks is told nothing of it
    Object.assign(sceneView, { nodes: scenes[i].nodes, path, pinned: pinned(pin) });
    feed.theme(dark);
    sceneView.again();
    connect();
    await settled();
    known.set(key, byName(seen()));
    if (client.wrong.length) throw new Error(client.wrong[0]);
    client = before;
  }
  return known.get(key);
}

// shows scenes in this order, each so many steps after the one before, so many handled together; returns what is wrong then
async function walked(order, by, together) {
  const wanted = {};
  for (const i of new Set(order)) wanted[i] = await alone({ i });
  Object.assign(sceneView, { path: "", pinned: null });
  feed.wanted = new Map();
  connect();
  client.busy = together > 1;
  for (const [k, i] of order.entries()) {
    sceneView.step(scenes[i].nodes, by);
    await settled();
    if ((k + 1) % together) continue;
    client.handle();
    const wrong = client.wrong[0] || difference(byName(seen()), wanted[i]) || (by === 0 && together === 1 ? veiled(sceneView.nodes) : "");
    if (wrong) return `${order[k - 1]} -> ${i}: ${wrong}`;
  }
  return "";
}

// a line that was made before a surface which precedes it: the client draws in the order in which things were made
function veiled(nodes) {
  const there = client.seen(), surfaces = [];
  for (const [name, { kind }] of nodes) {
    if (SURFACES.has(kind.type)) surfaces.push(name);
    const over = kind.type === "LineSegmentsMessage" && surfaces.find((one) => there[one].made > there[name].made);
    if (over) return `${over} is drawn over ${name}`;
  }
  return "";
}
