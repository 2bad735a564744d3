// How a node looks: as it is, as the ghost of a pinned step, faint behind what is read of, or standing out because somebody
// reads of it. Colours are mixed here, before the page's own backdrop, since viser's client draws points and lines opaque.
"use strict";

const LOOKS = {
  plain: { share: 1, size: 1, width: 1 },
  ghost: { share: 0.25, size: 0.4, width: 0.6 },  // finer too, so that it hides nothing
  faint: { share: 0.3, size: 1, width: 1 },
  strong: { share: 1, size: 1.6, width: 2, least: 0.8 },
};
const BACKDROPS = { false: [255, 255, 255], true: [20, 21, 23] };  // of viser's canvas

// the properties of a node's kind as it looks now; null where they are still being made (`feed` is told when they are there)
function propsOf({ kind, look = "plain" }, dark) {
  const { share, size, width, least = 0 } = LOOKS[look], opacity = Math.max(least, share * kind.fade);
  const key = `${look} ${opacity < 1 && kind.props.colors ? dark : ""}`;
  kind.looks ??= new Map();
  if (!kind.looks.has(key)) kind.looks.set(key, looking(kind, { opacity, size, width }, BACKDROPS[dark], (made) => {
    kind.looks.set(key, made);
    feed.again();
  }));
  return kind.looks.get(key);
}

function looking({ type, props }, { opacity, size, width }, backdrop, later) {
  switch (type) {
    case "PointCloudMessage": return { ...props, point_size: size * props.point_size, colors: mixed(props.colors, opacity, backdrop) };
    case "LineSegmentsMessage": return { ...props, thickness: width * props.thickness, colors: lines(mixed(props.colors, opacity, backdrop)) };
    case "ArrowMessage": return { ...props, colors: mixed(props.colors, opacity, backdrop) };
    case "MeshMessage": return { ...props, opacity: opacity < 1 ? opacity : null };
    case "GlbMessage": return opacity < 1 ? { ...props, glb_data: translucent(props.glb_data, opacity) } : props;
    case "ImageMessage": return opacity < 1 ? picture(props, opacity, later) : props;
    case "Label": return { ...props, opacity };
    default: return props;
  }
}

// colours mixed with a backdrop; before a dark one more of them is kept, since the eye sees less of a faint thing there
function mixed(colors, opacity, to) {
  const share = to[0] < 128 ? opacity ** 0.6 : opacity;
  return opacity < 1 ? colors.map((value, i) => Math.round(share * value + (1 - share) * to[i % 3])) : colors;
}

// one colour for all is sRGB to viser's client, one for each end of a line is linear light
function lines(colors) {
  return colors.length > 3 ? colors.map((value) => LIGHT[value]) : colors;
}

const LIGHT = Uint8Array.from({ length: 256 }, (_, value) => {
  const level = value / 255;
  return Math.round(255 * (level <= 0.04045 ? level / 12.92 : ((level + 0.055) / 1.055) ** 2.4));
});

// what a surface's file says (GLB: a head of 12 bytes, then JSON, then numbers), and where its numbers begin
function opened(glb) {
  const length = new DataView(glb.buffer, glb.byteOffset).getUint32(12, true);
  return { length, told: JSON.parse(new TextDecoder().decode(glb.subarray(20, 20 + length))), numbers: 20 + length + 8 };
}

// where the points of such a surface are, and its faces
function shapeOf(glb) {
  const { told: { accessors, bufferViews, meshes }, numbers } = opened(glb), [{ attributes, indices }] = meshes[0].primitives;
  return [attributes.POSITION, indices].map((accessor) => {
    const { byteOffset = 0, byteLength } = bufferViews[accessors[accessor].bufferView];
    const bytes = glb.slice(numbers + byteOffset, numbers + byteOffset + byteLength);
    return accessor === indices ? bytes : new Float32Array(bytes.buffer);
  });
}

// a surface whose colours stand in its file, as opaque as is wanted
function translucent(glb, opacity) {
  const bytes = glb.slice(), { length, told, numbers } = opened(bytes);
  const { accessors, bufferViews, meshes } = told, colors = accessors[meshes[0].primitives[0].attributes.COLOR_0];
  const start = numbers + (bufferViews[colors.bufferView].byteOffset ?? 0) + (colors.byteOffset ?? 0);
  for (let i = 0; i < colors.count; i++) bytes[start + 4 * i + 3] = Math.round(opacity * 255);
  for (const material of told.materials) material.alphaMode = "BLEND";
  const head = new TextEncoder().encode(JSON.stringify(told)), room = Math.ceil(head.length / 4) * 4;
  const made = new Uint8Array(20 + room + bytes.length - (20 + length)).fill(32, 20, 20 + room), out = new DataView(made.buffer);
  made.set(bytes.subarray(0, 20));
  made.set(head, 20);
  made.set(bytes.subarray(20 + length), 20 + room);
  out.setUint32(8, made.length, true);
  out.setUint32(12, room, true);
  return made;
}

// a picture, as opaque as is wanted: it is decoded and written anew, which takes a while
function picture(props, opacity, later) {
  createImageBitmap(new Blob([props._data])).then((image) => {
    const canvas = element("canvas", { width: image.width, height: image.height }), pen = canvas.getContext("2d");
    pen.globalAlpha = opacity;
    pen.drawImage(image, 0, 0);
    return new Promise((done) => canvas.toBlob(done, "image/png"));
  }).then((blob) => blob.arrayBuffer()).then((data) => later({ ...props, _format: "png", _data: new Uint8Array(data) }));
  return null;
}

const pathOf = (name) => (name.startsWith("/scene/") ? name.slice(7) : null);  // of a node, with · for /; of the stage none

// nodes without those at some paths, or under them
function without(nodes, paths) {
  const bases = paths.flatMap((path) => [path, `${path} name`]).map((path) => path.replaceAll("/", "·"));
  return new Map([...nodes].filter(([name]) => {
    const at = pathOf(name)?.replace(/\/.*/, "");
    return !bases.some((base) => at === base || at?.startsWith(`${base}·`));
  }));
}

// nodes of which those at a path, or under it, stand out, because somebody reads of them
function lit(nodes, path) {
  const base = path.replaceAll("/", "·"), meant = new Set();
  for (const name of nodes.keys()) {
    const at = pathOf(name)?.replace(/\/.*/, "");
    if (at === base || at?.startsWith(`${base}·`)) meant.add(name);
  }
  if (!meant.size) return nodes;
  return new Map([...nodes].map(([name, node]) => {
    const stays = pathOf(name) === null || (!meant.has(name) && node.kind.type === "Label"); // words say what is seen
    return [name, stays ? node : { ...node, look: meant.has(name) ? "strong" : "faint" }];
  }));
}

// the nodes of a step, and behind them as ghosts those of a pinned one that are elsewhere or gone; words have none
function withGhosts(nodes, pinned) {
  const all = new Map(nodes);
  for (const [name, node] of pinned) {
    if (pathOf(name) === null || node.kind.type === "Label" || alike(node, nodes.get(name))) continue;
    if (pathOf(name).includes("/")) continue; // a camera is its frustum alone
    if (node.kind.type === "ImageMessage" && nodes.has(name)) continue; // it would hide the one at its place
    all.set(name.replace("/scene/", "/ghost/"), { ...node, look: "ghost" });
  }
  return all;
}

// whether two nodes are at the same place and of the same shape, however they are coloured
function alike(a, b) {
  if (!b || a.kind.type !== b.kind.type) return false;
  const near = (x, y) => x.length === y.length && x.every((value, i) => Math.abs(value - y[i]) < 1e-6);
  if (!near(a.wxyz, b.wxyz) || !near(a.position, b.position)) return false;
  return Object.entries(a.kind.props).every(([key, value]) => {
    const other = b.kind.props[key];
    if (value === other) return true;
    if (key !== "glb_data") return !(value instanceof Float32Array) || near(value, other);
    const [mine, theirs] = [value, other].map(shapeOf);
    return mine.every((part, i) => near(part, theirs[i]));
  });
}
