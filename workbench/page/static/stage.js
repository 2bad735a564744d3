// The scene: viser's client in a frame, whatever home feeds it, with its own panels hidden.
"use strict";

const OURS = new Set(["w", "s", "b"]);  // keys with which viser's client would move the camera

const stage = {
  frame: null,

  // shows a frame; `attributes` are its src or srcdoc
  put(attributes) {
    const frame = element("iframe", { title: "3D scene of this step; drag to turn it, scroll to come nearer", ...attributes });
    this.frame = frame;
    frame.addEventListener("load", () => this.tidy(frame));
    $("#scene").replaceChildren(frame, element("div", { id: "labels", ariaHidden: "true" }));
  },

  // viser's own panels and bars go; the page's keys work in the frame too
  tidy(frame) {
    const inside = frame.contentDocument;
    if (!inside) return;
    inside.head.append(Object.assign(inside.createElement("style"), {
      textContent: ".mantine-Paper-root, .mantine-Notifications-root, .mantine-Notification-root { display: none !important }",
    }));
    inside.addEventListener("keydown", (event) => {
      if (event.key.startsWith("Arrow") || event.target.closest("input")) return;
      keys.pressed(event);
      if (OURS.has(event.key.toLowerCase())) event.stopImmediatePropagation();  // not the scene's
    }, { capture: true });
    page.tell("tidied", inside);
  },

  // a scene is on its way; and the one that was is there
  awaited() { $("#scene").setAttribute("aria-busy", "true"); },
  arrived() { feed.ready.then(() => $("#scene").removeAttribute("aria-busy")); },

  // the legend stays as high as it once was for this run: a scene that changes its size from step to step cannot be watched
  legend(html) {
    const box = $("#legend"), of = `${page.run.id} ${innerWidth}`;
    if (box.innerHTML === html) return;
    box.innerHTML = html;
    if (of !== this.legendOf) box.style.minHeight = "";
    this.legendOf = of;
    box.style.minHeight = `${box.offsetHeight}px`;
  },

  // makes what is at a path, or under it, stand out: in the legend, and in the scene where the home can; "" ends it
  light(path) {
    const meant = (one) => path && (one === path || one.startsWith(`${path}/`));
    for (const row of $$("#legend [data-things]")) row.classList.toggle("lit", row.dataset.things.split("|").some(meant));
    source.light?.(path);
  },
};
