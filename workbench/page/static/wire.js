// Reads what a server says of a scene, or the file of a run: 4 bytes of length, a head as JSON, then arrays at multiples of 8.
// A node is {kind, wxyz, position}. Equal kinds are one object, and so are equal arrays: what is the same is seen at a glance.
"use strict";

const ARRAYS = {
  "<f2": Uint16Array, "<f4": Float32Array, "<f8": Float64Array, "|u1": Uint8Array, "<u2": Uint16Array, "<u4": Uint32Array,
  "|i1": Int8Array, "<i2": Int16Array, "<i4": Int32Array, "<i8": BigInt64Array,
};

class Wire {
  constructor() { Object.assign(this, { kinds: new Map(), arrays: new Map() }); }

  // the head of a message; what it has in kinds and arrays is kept, since what comes later refers to them
  read(buffer) {
    const length = new DataView(buffer).getUint32(0, true);
    const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
    if (head.fresh) for (const kept of [this.kinds, this.arrays]) kept.clear();
    let at = 4 + length;
    for (const [key, size] of head.arrays) {
      this.arrays.set(key, { buffer, at, size });
      at += Math.ceil(size / 8) * 8;
    }
    for (const [key, kind] of Object.entries(head.kinds)) this.kinds.set(key, this.filled(kind));
    return head;
  }

  filled({ type, props, fade = 1, visible = true }) {
    const fill = (value) => {
      if (value === null || typeof value !== "object") return value;
      if (Array.isArray(value)) return value.map(fill);
      const found = this.arrays.get(value.$), type = ARRAYS[value.as];
      return found[value.as] ??= new type(found.buffer, found.at, found.size / type.BYTES_PER_ELEMENT);
    };
    return { type, fade, visible, props: Object.fromEntries(Object.entries(props).map(([name, value]) => [name, fill(value)])) };
  }

  node([, key, pose]) { return { kind: this.kinds.get(key), wxyz: pose.slice(0, 4), position: pose.slice(4) }; }

  // the nodes of a step by name
  nodes(listed) { return new Map(listed.map((one) => [one[0], this.node(one)])); }

  // the nodes of every step of a whole run; a step names alone what is as in the one before
  steps(listed) {
    let before = new Map();
    return listed.map((step) => {
      before = new Map(step.map((one) => (typeof one === "string" ? [one, before.get(one)] : [one[0], this.node(one)])));
      return before;
    });
  }
}

// the bytes of a run's file: 8 bytes of length, then zstd, as base64; `realm` is the window of viser's client, which can read it
async function unpacked(base64, realm) {
  const file = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const size = Number(new DataView(file.buffer).getBigUint64(0, true)), packed = file.subarray(8);
  const { exports: zstd } = await WebAssembly.instantiate(realm.__viserZstdWasm, { env: { emscripten_notify_memory_growth() {} } });
  const from = zstd.malloc(packed.length), to = zstd.malloc(size);
  new Uint8Array(zstd.memory.buffer).set(packed, from);
  if (zstd.ZSTD_decompress(to, size, from, packed.length) !== size) throw new Error("this recording cannot be read");
  return zstd.memory.buffer.slice(to, to + size);
}
