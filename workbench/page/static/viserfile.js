// Reads a recording of viser (a .viser file): 8 bytes of length, then zstd; inside, messages as msgpack and their arrays.
"use strict";

const viserfile = {
  // messages of every step; step k stands from second k to second k + 1. `realm` is the window of viser's page: it has a decoder
  // for zstd, and knows as arrays those that are its own
  async read(base64, realm) {
    const packed = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const size = Number(new DataView(packed.buffer).getBigUint64(0, true));
    const bytes = await this.unpacked(packed.subarray(8), size, realm);
    const length = Number(new DataView(bytes.buffer).getBigUint64(0, true));
    const said = new Msgpack(bytes.subarray(8, 8 + length)).value();
    let at = 8 + length;
    const starts = said.binaryBufferLengths.map((n) => { const start = at = Math.ceil(at / 8) * 8; at += n; return start; });
    const steps = Array.from({ length: Math.max(1, Math.round(said.durationSeconds)) }, () => []);
    for (const [time, message] of said.messages) {
      const filled = this.filled(message, { realm, buffer: bytes.buffer, starts, lengths: said.binaryBufferLengths });
      steps[Math.min(Math.floor(time), steps.length - 1)].push(filled);
    }
    return steps;
  },

  async unpacked(packed, size, realm) {
    let heap;
    const { exports: zstd } = await WebAssembly.instantiate(realm.__viserZstdWasm, {
      env: { emscripten_notify_memory_growth() { heap = new Uint8Array(zstd.memory.buffer); } },
    });
    const from = zstd.malloc(packed.length), to = zstd.malloc(size);
    heap = new Uint8Array(zstd.memory.buffer);
    heap.set(packed, from);
    const got = zstd.ZSTD_decompress(to, size, from, packed.length);
    heap = new Uint8Array(zstd.memory.buffer);
    if (got !== size) throw new Error("this recording cannot be read");
    return new realm.Uint8Array(heap.subarray(to, to + size));
  },

  // a value with its arrays in place of what stands for them
  filled(value, arrays) {
    if (Array.isArray(value)) return value.map((one) => this.filled(one, arrays));
    if (value === null || typeof value !== "object" || ArrayBuffer.isView(value)) return value;
    if ("__binary_index" in value) {
      const type = arrays.realm[ARRAYS[value.dtype]], i = value.__binary_index;
      return new type(arrays.buffer, arrays.starts[i], arrays.lengths[i] / type.BYTES_PER_ELEMENT);
    }
    for (const key of Object.keys(value)) value[key] = this.filled(value[key], arrays);
    return value;
  },
};

const ARRAYS = {
  "<f2": "Uint16Array", "<f4": "Float32Array", "<f8": "Float64Array", "|u1": "Uint8Array", "<u2": "Uint16Array", "<u4": "Uint32Array",
  "|i1": "Int8Array", "<i2": "Int16Array", "<i4": "Int32Array",
};

// reads msgpack; see https://github.com/msgpack/msgpack/blob/master/spec.md
class Msgpack {
  constructor(bytes) {
    this.bytes = bytes;
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    this.at = 0;
    this.text = new TextDecoder();
  }

  number(kind, size) {
    const value = this.view[`get${kind}`](this.at);
    this.at += size;
    return Number(value);
  }

  part(length) { return this.bytes.slice(this.at, this.at += length); }
  string(length) { return this.text.decode(this.bytes.subarray(this.at, this.at += length)); }
  array(length) { return Array.from({ length }, () => this.value()); }

  map(length) {
    const made = {};
    for (let i = 0; i < length; i++) {
      const key = this.value();
      made[key] = this.value();
    }
    return made;
  }

  size(code, first) { return this.number(["Uint8", "Uint16", "Uint32"][code - first], 1 << (code - first)); }

  value() {
    const code = this.number("Uint8", 1);
    if (code < 0x80) return code;
    if (code < 0x90) return this.map(code & 15);
    if (code < 0xa0) return this.array(code & 15);
    if (code < 0xc0) return this.string(code & 31);
    if (code >= 0xe0) return code - 256;
    if (code === 0xc0) return null;
    if (code === 0xc2 || code === 0xc3) return code === 0xc3;
    if (code >= 0xc4 && code <= 0xc6) return this.part(this.size(code, 0xc4));
    if (code === 0xca) return this.number("Float32", 4);
    if (code === 0xcb) return this.number("Float64", 8);
    if (code >= 0xcc && code <= 0xcf) return this.number(["Uint8", "Uint16", "Uint32", "BigUint64"][code - 0xcc], 1 << (code - 0xcc));
    if (code >= 0xd0 && code <= 0xd3) return this.number(["Int8", "Int16", "Int32", "BigInt64"][code - 0xd0], 1 << (code - 0xd0));
    if (code >= 0xd9 && code <= 0xdb) return this.string(this.size(code, 0xd9));
    if (code === 0xdc || code === 0xdd) return this.array(this.number(code === 0xdc ? "Uint16" : "Uint32", code === 0xdc ? 2 : 4));
    if (code === 0xde || code === 0xdf) return this.map(this.number(code === 0xde ? "Uint16" : "Uint32", code === 0xde ? 2 : 4));
    throw new Error(`this recording cannot be read: code ${code}`);
  }
}
