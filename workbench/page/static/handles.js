// What a person does in the scene: handles that set a knob and follow it, and clicks that pick. viser's client tells the page,
// the page tells the source.
"use strict";

const HANDLE = { scale: 1, line_width: 3, fixed: false, active_axes: [true, true, true], disable_axes: false, disable_sliders: false,
  disable_rotations: false, translation_limits: [[-1000, 1000], [-1000, 1000], [-1000, 1000]],
  rotation_limits: [[-1000, 1000], [-1000, 1000], [-1000, 1000]], depth_test: false, opacity: 1 };

const handles = {
  on: false,
  held: null,   // the knob whose handle a hand is on: it leads, whatever answers come
  kinds: new Map(),
  knobs: [],

  start() {
    this.knobs = LESSON.knobs.filter((knob) => knob.by === "gizmo");
    const name = (message) => message.name.slice("/handle/".length);
    feed.heard.TransformControlsDragStartMessage = (message) => { this.held = name(message); };
    feed.heard.TransformControlsDragEndMessage = () => { this.held = null; };
    feed.heard.TransformControlsUpdateMessage = (message) => this.moved(name(message), message);
    feed.heard.ScenePointerMessage = ({ ray_origin, ray_direction }) => source.click?.(ray_origin, ray_direction);
    feed.clicks(Boolean(source.click) && LESSON.knobs.some((knob) => knob.by === "pick"));
  },

  moved(field, { wxyz, position }) {
    const knob = this.knobs.find((one) => one.name === field), length = knob?.parts.length;
    if (!knob) return;
    const node = feed.shown.get(`/handle/${field}`);
    if (node) Object.assign(node, { wxyz, position });
    source.change({ [field]: length === 6 ? [...position, ...turn(wxyz)] : position.slice(0, length) });
  },

  // nodes, and the handles where the params of the run say
  with(nodes) {
    const params = this.on && page.run?.params;
    if (!params) return nodes;
    const all = new Map(nodes);
    for (const knob of this.knobs) {
      const name = `/handle/${knob.name}`, value = params[knob.name], shown = this.held === knob.name && feed.shown.get(name);
      if (!value || page.run.idle?.includes(knob.name)) continue; // a knob without effect has no handle
      const at = { position: [...value.slice(0, 3), 0].slice(0, 3), wxyz: value.length === 6 ? quaternion(value.slice(3)) : [1, 0, 0, 0] };
      all.set(name, { kind: this.kind(knob, value.length), ...(shown ? { position: shown.position, wxyz: shown.wxyz } : at) });
    }
    return all;
  },

  kind(knob, length) {
    if (!this.kinds.has(knob.name)) this.kinds.set(knob.name, { type: "TransformControlsMessage", fade: 1, visible: true,
      props: { ...HANDLE, scale: knob.size, disable_rotations: length !== 6, active_axes: [true, true, length !== 2] } });
    return this.kinds.get(knob.name);
  },
};

// the rotation vector of a quaternion, at most half a turn long
function turn([w, x, y, z]) {
  const sine = Math.hypot(x, y, z), sign = w < 0 ? -1 : 1, by = sine < 1e-9 ? 2 * sign : (sign * 2 * Math.atan2(sine, Math.abs(w))) / sine;
  return [x * by, y * by, z * by];
}

function quaternion([x, y, z]) {
  const angle = Math.hypot(x, y, z), by = angle < 1e-9 ? 0.5 : Math.sin(angle / 2) / angle;
  return [Math.cos(angle / 2), x * by, y * by, z * by];
}
