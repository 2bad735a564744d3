// Words in the scene, as text over it: legible in the dark and in a lecture hall, and moved apart where they would cover each other.
"use strict";

const labels = {
  camera: null,  // {wxyz, position, fov}: where the scene is seen from
  nodes: new Map(),  // name -> node, as `feed` shows it
  words: new Map(),  // name -> element
  waiting: 0,

  start() { feed.heard.ViewerCameraMessage = ({ wxyz, position, fov }) => this.seen({ wxyz, position, fov }); },

  // a camera: as viser's client tells of it, or as a scene wants it
  seen({ eye, target, up, ...camera }) {
    this.camera = { ...this.camera, ...camera, ...(eye && { position: eye, wxyz: lookingAt(eye, target, up) }) };
    this.place();
  },

  show(nodes) {
    this.nodes = new Map([...nodes].filter(([, node]) => node.kind.type === "Label"));
    for (const [name, word] of this.words) if (!this.nodes.has(name)) { word.remove(); this.words.delete(name); }
    for (const [name, { props }] of this.nodes) {
      if (!this.words.has(name)) {
        const word = element("span", { className: ["small", "stays"].filter((how) => props[how]).join(" ") });
        this.words.set(name, word);
        $("#labels").append(word);
      }
      const word = this.words.get(name);
      if (word.textContent !== props.text) word.textContent = props.text;
      word.style.opacity = props.opacity;
    }
    this.place();
  },

  // soon, and once for all that ask before the next picture
  place() {
    if (!this.waiting) this.waiting = requestAnimationFrame(() => { this.waiting = 0; this.placeNow(); });
  },

  placeNow() {
    if (!this.camera?.wxyz || !stage.frame) return;
    const { clientWidth: width, clientHeight: height } = stage.frame, focal = height / 2 / Math.tan(this.camera.fov / 2);
    const found = [...this.nodes].map(([name, node]) => {
      const [x, y, z] = turnedBack(this.camera.wxyz, (node.at ?? node).position.map((value, i) => value - this.camera.position[i]));
      return { word: this.words.get(name), z, u: width / 2 + (focal * x) / z, v: height / 2 + (focal * y) / z, ...node.props };
    });
    const taken = buttons(stage.frame);
    for (const { word, z, u, v, small, stays } of found.sort((a, b) => !a.stays - !b.stays || a.z - b.z)) {
      word.hidden = !(z > 1e-6) || u < -50 || v < -50 || u > width + 50 || v > height + 50;
      if (word.hidden) continue;
      const box = { width: word.offsetWidth, height: word.offsetHeight };
      const top = small || stays ? v - box.height / 2 : v - box.height - 2;
      const left = u < 0 || u > width ? u - box.width / 2 : within(u - box.width / 2, width - box.width);
      const free = SHIFTS.find((shift) => stays || !taken.some((other) => crosses({ ...box, left, top: top + shift * box.height }, other))) ?? 0;
      taken.push({ ...box, left, top: top + free * box.height });
      word.style.transform = `translate(${left}px, ${top + free * box.height}px)`;
    }
  },
};

const SHIFTS = [0, -1.05, 1.3, -2.1, 2.35, -3.15];  // heights of a word that it may go up or down to be read

// where the page's own buttons lie over the picture: no word is read under them
function buttons(frame) {
  const box = $("#tools")?.getBoundingClientRect(), at = frame.getBoundingClientRect();
  return box?.width ? [{ left: box.left - at.left, top: box.top - at.top, width: box.width, height: box.height }] : [];
}

// what is in the picture is not cut off at its edge
function within(value, most) { return Math.max(0, Math.min(value, most)); }

function crosses(a, b) {
  return a.left < b.left + b.width && b.left < a.left + a.width && a.top < b.top + b.height && b.top < a.top + a.height;
}

// a vector of the world in a camera's frame (x right, y down, z forward)
function turnedBack([w, x, y, z], [a, b, c]) {
  return [
    (1 - 2 * (y * y + z * z)) * a + 2 * (x * y + w * z) * b + 2 * (x * z - w * y) * c,
    2 * (x * y - w * z) * a + (1 - 2 * (x * x + z * z)) * b + 2 * (y * z + w * x) * c,
    2 * (x * z + w * y) * a + 2 * (y * z - w * x) * b + (1 - 2 * (x * x + y * y)) * c,
  ];
}

// the orientation, as a quaternion, of a camera that looks from an eye at a target
function lookingAt(eye, target, up) {
  const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d];
  const unit = (v) => v.map((value) => value / Math.hypot(...v));
  const forward = unit(target.map((value, i) => value - eye[i])), right = unit(cross(forward, up)), down = cross(forward, right);
  const [[a, d, g], [b, e, h], [c, f, i]] = [right, down, forward];  // the columns of the rotation
  const parts = [[1 + a + e + i, h - f, c - g, d - b], [h - f, 1 + a - e - i, b + d, c + g],
    [c - g, b + d, 1 - a + e - i, f + h], [d - b, c + g, f + h, 1 - a - e + i]];
  return unit(parts.reduce((best, part, k) => (part[k] > best[0] ? [part[k], part] : best), [0, parts[0]])[1]);
}
