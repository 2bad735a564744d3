// Feeds the page from a server: wishes go out as JSON; what came of them comes back as JSON, and of a scene as bytes.
"use strict";

const source = {
  socket: null, waiting: [], given: {},
  tells: {},  // what is told -> function: what the other parts of the page hear

  start() {
    const { token } = document.body.dataset;
    stage.put({ src: "scene/" });
    const address = new URL(`live?token=${token}`, location.href);
    address.protocol = address.protocol.replace("http", "ws");
    const socket = this.socket = new WebSocket(address);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.send({ verb: "open", query: location.search, lesson: LESSON.name });
      for (const text of this.waiting.splice(0)) socket.send(text);
      returning.opened();
    };
    socket.onmessage = ({ data }) => (typeof data === "string" ? this.heard(JSON.parse(data)) : arriving.drew(data));
    socket.onclose = () => returning.wait();
  },

  heard(message) {
    const { tell, run, ...more } = message;
    if (tell === "run") {
      page.told({ id: run, pinned: sceneView.series(), ...more });
      if (handles.on) sceneView.again(); // they follow the params; what glides is left alone
      if (more.files) files.show(more.files, more.aside);
    } else if (tell === "step") page.came(run, more.k, more.step, more.things);
    else if (tell === "answer") article.answered({ ...more, given: this.given[more.question] ?? null });
    else if (tell === "trouble") page.say(more.text, "wrong");
    else this.tells[tell]?.(more);
  },

  flush() { arriving.flush(); },

  send(message) {
    const text = JSON.stringify(message);
    if (this.socket && this.socket.readyState === WebSocket.OPEN) this.socket.send(text);
    else this.waiting.push(text);
  },

  // a step may be named by the run's own end, which the page finds when it is known
  open(name, step) {
    this.send({ verb: "run", run: name, step: /^(stop.|last)/.test(step) ? -1 : step });
  },
  seek(k) { this.send({ verb: "seek", k }); },
  change(values) { this.send({ verb: "change", values }); },
  reset() {
    sceneView.pin(false);
    this.send({ verb: "reset" });
  },
  pin() { sceneView.pin(); },
  handles(on) {
    handles.on = on;
    sceneView.again();
  },
  light(path) { sceneView.light(path); },
  theme(dark) { feed.theme(dark); },
  click(p_origin, v_ray) { this.send({ verb: "click", p_origin, v_ray }); },
  forget(field) { this.send({ verb: "forget", field }); },
  recording() { return fetch(`recording/${document.body.dataset.token}`); },
  upload(field, file) {
    const address = `files/${document.body.dataset.token}/${encodeURIComponent(field)}?name=${encodeURIComponent(file.name)}`;
    return fetch(address, { method: "POST", body: file });
  },
  predict(question, given, { stay = false } = {}) {
    this.given[question] = given;
    this.send({ verb: "predict", question, given, stay });
  },
  followed() { this.send({ verb: "open", query: location.search, lesson: LESSON.name }); },
};
