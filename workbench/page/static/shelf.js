// Where recorded runs come from. A run's file calls `replay`, the file with viser's client calls `viserClient`; where they stand in
// the document itself, as in a notebook, nothing is loaded. Nothing is fetched: the page opens from disk.
"use strict";

const shelf = {
  runs: new Map(),   // name -> the data of a run
  viser: null,       // viser's client, as HTML
  loading: new Map(), // file -> its promise

  async run(name) {
    if (!this.runs.has(name)) await this.load(`${RECORDED.runs}${RECORDED.files[name]}.js`);
    return this.runs.get(name);
  },

  async client() {
    if (!this.viser) await this.load(`${RECORDED.root}viser.js`);
    return this.viser;
  },

  load(file) {
    if (!this.loading.has(file)) this.loading.set(file, new Promise((resolve, reject) => {
      const failed = () => {
        this.loading.delete(file);
        reject(new Error(`${file} could not be loaded.`));
      };
      document.head.append(element("script", { src: file, onload: resolve, onerror: failed }));
    }));
    return this.loading.get(file);
  },
};

function replay(name, data) { shelf.runs.set(name, data); }
function viserClient(html) { shelf.viser = html; }
