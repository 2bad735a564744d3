// A pinned step behind the one that is shown: finer and paler, so that it hides nothing.
"use strict";

const GHOST = 0.25, FAINT = 0.3; // how much of its own colour a ghost keeps, and what steps back behind what is read of
const BACKDROPS = { false: [255, 255, 255], true: [20, 21, 23] };

// the ghosts of a scene's nodes: name -> {of: the node, ghost}; what would hide something has none
function ghostsOf(nodes, dark) {
  const found = new Map();
  for (const [name, of] of nodes) {
    const props = name.startsWith("/scene/") && faint(of, BACKDROPS[dark]);
    if (props) found.set(name, { of, ghost: { ...of, props, add: { ...of.add, props } } });
  }
  return found;
}

// the nodes of `wanted`, and behind them the ghosts of what is elsewhere or gone
function withGhosts(wanted, ghosts) {
  const all = new Map(wanted);
  for (const [name, { of, ghost }] of ghosts) {
    if (!alike(of, wanted.get(name))) all.set(name.replace("/scene/", "/ghost/"), ghost);
  }
  return all;
}

// nodes of which those at a path, or under it, stand out, because somebody reads of them
function litNodes(nodes, path, dark) {
  const base = path.replaceAll("/", "·"), meant = new Set();
  for (const name of nodes.keys()) {
    const own = name.startsWith("/scene/") ? name.slice(7).replace(/~\d+$/, "") : "";
    if (own === base || own.startsWith(`${base}·`)) meant.add(name);
  }
  if (!meant.size) return nodes;
  return new Map([...nodes].map(([name, node]) => {
    if (!name.startsWith("/scene/")) return [name, node];
    const { point_size: size, thickness } = node.props;
    if (!meant.has(name)) return [name, { ...node, props: paler(node, BACKDROPS[dark], FAINT) ?? node.props }];
    return [name, { ...node, props: { ...node.props, ...(size && { point_size: 1.6 * size }), ...(thickness && { thickness: 2 * thickness }) } }];
  }));
}

function faint(node, backdrop) {
  const props = paler(node, backdrop, GHOST);
  return props && { ...props, ...(props.point_size && { point_size: 0.4 * props.point_size }), ...(props.thickness && { thickness: 0.6 * props.thickness }) };
}

function paler({ add, props }, backdrop, share) {
  const mixed = (to) => props.colors.map((value, i) => Math.round(share * value + (1 - share) * to[i % 3]));
  const linear = backdrop.map((value) => 255 * (value / 255) ** 2.2); // a line's colour is linear light
  switch (add.type) {
    case "PointCloudMessage": return { ...props, colors: mixed(backdrop) };
    case "LineSegmentsMessage": return { ...props, colors: mixed(linear) };
    case "MeshMessage": return { ...props, opacity: share * (props.opacity ?? 1) };
    case "ArrowMessage": return { ...props, colors: mixed(backdrop) };
    default: return null; // words, pictures, and surfaces whose colours stand in a file
  }
}

function alike(a, b) {
  if (!b || a.add.type !== b.add.type) return false;
  const near = (x, y) => x.length === y.length && x.every((value, i) => Math.abs(value - y[i]) < 1e-6);
  const places = Object.keys(a.props).filter((key) => a.props[key]?.constructor.name === "Float32Array");
  return near(a.wxyz, b.wxyz) && near(a.position, b.position) &&
    places.every((key) => a.props[key] === b.props[key] || near(a.props[key], b.props[key]));
}
