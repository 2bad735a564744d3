// A server that is gone: the page asks for itself until it is served again, and loads anew at its place, which is its address.
"use strict";

const returning = {
  seconds: 2,   // between two tries, and up to half of it more by chance: a whole class does not come at once
  longest: 60,  // between two, where a server gives the page and then refuses or leaves it
  steady: 10,   // after which a connection is one that lasts
  timer: 0,

  // what is known across the loads of this tab: how often in a row it loaded anew without lasting, where the article was,
  // and whether files that were handed over went with the server
  memory: {
    get() { try { return JSON.parse(sessionStorage.getItem("workbench returning")) ?? {}; } catch { return { times: 5 }; } },
    set(known) { try { sessionStorage.setItem("workbench returning", JSON.stringify(known)); } catch { /* nothing may be kept */ } },
  },

  // a connection is there
  opened() {
    const { top, lost } = this.memory.get();
    if (top) $("#article").scrollTop = top;
    files.lost = Boolean(lost);
    this.timer = setTimeout(() => this.memory.set({}), 1000 * this.steady);
  },

  wait(status) {
    clearTimeout(this.timer);
    transport.pause();
    page.say(status === 403 ? "The server was started anew and wants its new link. Open that one; this page then goes on too."
      : "The server is gone. This page tries to reach it, and goes on when it is back.", "wrong");
    const least = Math.min(this.longest, this.seconds * 2 ** (this.memory.get().times ?? 0));
    this.timer = setTimeout(() => this.soon(), 1000 * least * (1 + Math.random() / 2));
  },

  // tries now, or as soon as somebody looks
  soon() {
    if (document.hidden) document.addEventListener("visibilitychange", () => this.soon(), { once: true });
    else this.ask();
  },

  async ask() {
    const status = await fetch(location.href, { method: "HEAD", cache: "no-store" }).then((answer) => answer.status, () => 0);
    if (status !== 200) return this.wait(status);
    page.remember();
    this.memory.set({ times: (this.memory.get().times ?? 0) + 1, top: $("#article").scrollTop, lost: files.lost || files.handed() });
    location.reload();
  },
};
