// Feeds the page from a server: wishes go out as JSON, what came of them comes back; the scene is streamed beside.
"use strict";

const source = {
  socket: null, waiting: [], given: {},
  tells: {},  // what is told -> function: what the other parts of the page hear

  start() {
    const { token } = document.body.dataset;
    stage.put({ src: `scene/${token}/` });
    const address = new URL(`live?token=${token}`, location.href);
    address.protocol = address.protocol.replace("http", "ws");
    const socket = this.socket = new WebSocket(address);
    socket.onopen = () => {
      this.send({ verb: "open", query: location.search, lesson: LESSON.name });
      for (const text of this.waiting.splice(0)) socket.send(text);
      returning.opened();
    };
    socket.onmessage = (event) => this.heard(JSON.parse(event.data));
    socket.onclose = () => returning.wait();
  },

  heard(message) {
    const { tell, run, ...more } = message;
    if (tell === "run") {
      page.told({ id: run, ...more });
      if (more.files) files.show(more.files, more.aside);
    } else if (tell === "step") page.came(run, more.k, more.step, more.things);
    else if (tell === "answer") article.answered({ ...more, given: this.given[more.question] ?? null });
    else if (tell === "trouble") page.say(more.text, "wrong");
    else this.tells[tell]?.(more);
  },

  send(message) {
    const text = JSON.stringify(message);
    if (this.socket && this.socket.readyState === WebSocket.OPEN) this.socket.send(text);
    else this.waiting.push(text);
  },

  open(name, step) { this.send({ verb: "run", run: name, step }); },
  seek(k) { this.send({ verb: "seek", k }); },
  change(values) { this.send({ verb: "change", values }); },
  reset() { this.send({ verb: "reset" }); },
  pin() { this.send({ verb: "pin" }); },
  handles(on) { this.send({ verb: "handles", on }); },
  light(path) { this.send({ verb: "light", path }); },
  theme(dark) { this.send({ verb: "theme", dark, still: matchMedia("(prefers-reduced-motion: reduce)").matches }); },
  forget(field) { this.send({ verb: "forget", field }); },
  recording() { return fetch(`recording/${document.body.dataset.token}`); },
  upload(field, file) {
    const address = `files/${document.body.dataset.token}/${encodeURIComponent(field)}?name=${encodeURIComponent(file.name)}`;
    return fetch(address, { method: "POST", body: file });
  },
  predict(question, given) {
    this.given[question] = given;
    this.send({ verb: "predict", question, given });
  },
};
