// A pinned step behind the one that is shown: finer and paler, so that it hides nothing.
"use strict";

const GHOST = 0.25; // how much of its own colour a ghost keeps
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

function faint({ add, props }, backdrop) {
  const mixed = (to) => props.colors.map((value, i) => Math.round(GHOST * value + (1 - GHOST) * to[i % 3]));
  const linear = backdrop.map((value) => 255 * (value / 255) ** 2.2); // a line's colour is linear light
  switch (add.type) {
    case "PointCloudMessage": return { ...props, colors: mixed(backdrop), point_size: 0.4 * props.point_size };
    case "LineSegmentsMessage": return { ...props, colors: mixed(linear), thickness: 0.6 * props.thickness };
    case "MeshMessage": return { ...props, opacity: GHOST * (props.opacity ?? 1) };
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
