// Own files: fields of Params that name a file are set by handing one over, where a home takes files.
"use strict";

const files = {
  boxes: {},  // name -> {said, forget, input} of each field
  lost: false,  // whether some went with a server that is gone

  rows() {
    this.boxes = {};
    return source.upload ? LESSON.files.map((field) => this.row(field)) : [];
  },

  row(field) {
    const said = element("output"), input = element("input", { type: "file", ariaLabel: `${field.label}: a file of your own` });
    const forget = element("button", { type: "button", textContent: "Remove", ariaLabel: `Go on without ${field.label}`, hidden: true,
      onclick: () => { input.value = ""; source.forget(field.name); } });
    input.addEventListener("change", () => input.files.length && this.hand(field, input, said));
    this.boxes[field.name] = { said, forget, input };
    return element("fieldset", { className: "knob file", title: field.hint }, element("legend", { textContent: field.label }), input,
      element("div", {}, said, forget));
  },

  handed() { return Object.values(this.boxes).some(({ input }) => input.files.length > 0); },

  say(text) {
    this.line ??= $("#view").appendChild(element("p", { id: "aside", role: "status" }));
    if (this.line.textContent !== text) this.line.textContent = text;
  },

  async hand(field, input, said) {
    said.textContent = "Handing it over …";
    try {
      const answer = await source.upload(field.name, input.files[0]);
      said.textContent = answer.ok ? "" : await answer.text();
      if (!answer.ok) input.value = "";
    } catch {
      said.textContent = "The file could not be handed over.";
    }
  },

  // names of the files that are open or put aside, by field: of one that came from the command line the page has no input
  show(open, aside) {
    this.lost &&= !Object.keys(open).length;
    this.say(aside ? "This run is of the lesson's own data. A preset or Reset (R) goes back to yours."
      : this.lost ? "Files that were handed over went with the server. Hand them over again." : "");
    for (const [name, { said, forget, input }] of Object.entries(this.boxes)) {
      forget.hidden = !(name in open);
      if (name in open) said.textContent = input.files.length ? "" : open[name];
      else if (!input.files.length) said.textContent = "";
    }
  },
};
