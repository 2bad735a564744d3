// Python in a worker of a published page: it computes a lesson's run a few steps at a time, and hears in between what is
// wanted next. From the page: {verb, ...}; to the page: {tell, ...}, as the live server tells a run and its steps.
// A module: Pyodide has no other workers since its release 314.

const SHARE = 40;  // milliseconds of computing between two looks at what is wanted

let python, calls;
let wish = 0;        // number of the run that is wanted
let run = null;      // {number, known, finished} as far as it has been told
let wanted = null;   // the step that is wanted and has not been sent; negative from the end

const say = (told, transfer = []) => postMessage(told, transfer);
const turn = () => new Promise((done) => setTimeout(done));  // what the page said meanwhile is heard now

// asks Python; null where it says why not
function asked(verb, ...given) {
  const { value, trouble } = JSON.parse(calls.call(verb, JSON.stringify(given)));
  if (trouble === undefined) return value;
  say({ tell: "trouble", text: trouble });
  return null;
}

// what is loaded is told, and kept by the browser under its version: the next visit loads nothing
function loading(from, sizes) {
  const load = self.fetch.bind(self), all = Object.values(sizes).reduce((sum, size) => sum + size, 0);
  let done = 0;
  const told = () => say({ tell: "loading", done, all });
  const stored = async (address) => {
    const shelf = await self.caches?.open(`python ${from}`).catch(() => null);
    const found = await shelf?.match(address);
    if (found) return found;
    const answer = await load(address);
    if (!answer.ok) throw new Error(`${address} cannot be loaded (${answer.status})`);
    await shelf?.put(address, answer.clone()).catch(() => {});  // where there is no room, the net is asked again
    return answer;
  };
  self.fetch = async (what, how) => {
    const address = String(what.url ?? what);
    if (!address.startsWith(from)) return load(what, how);
    const answer = await stored(address).catch((error) => {
      failed(error);  // Pyodide itself waits for ever for a file that does not come
      throw error;
    });
    done += sizes[address.slice(from.length)] ?? 0;
    told();
    return answer;
  };
  told();
}

// what is computed reaches nothing but this page: no net, no store of the browser, no other page or worker
function closed() {
  const theirs = ["fetch", "XMLHttpRequest", "WebSocket", "WebSocketStream", "WebTransport", "EventSource", "importScripts", "Worker",
    "SharedWorker", "BroadcastChannel", "caches", "indexedDB", "cookieStore", "storage", "storageBuckets", "locks", "serviceWorker"];
  for (const object of [self, navigator])
    for (let one = object; one; one = Object.getPrototypeOf(one)) for (const name of theirs) delete one[name];
}

async function start({ from, core, sizes, lesson }) {
  loading(from, sizes);
  const archive = fetch(core).then((answer) => {
    if (!answer.ok) throw new Error(`${core} cannot be loaded (${answer.status})`);
    return answer.arrayBuffer();
  });
  archive.catch(() => {});  // told below
  const { loadPyodide } = await import(`${from}pyodide.mjs`);
  python = await loadPyodide({ indexURL: from });
  await python.loadPackage(["numpy", "scipy"], { messageCallback() {} });
  python.unpackArchive(await archive, "zip", { extractDir: "/core" });
  python.runPython("import sys; sys.path.insert(0, '/core')");
  calls = python.pyimport("workbench.computed.calls").Calls(lesson);
  closed();
  const about = asked("about");
  if (about) say({ tell: "ready", ...about });
}

// begins the run of these params and computes it, until another one is wanted
async function begin({ params, at }) {
  const begun = asked("run", params);
  if (!begun) return;
  const mine = ++wish;
  run = { number: begun.run, known: 0, finished: false };
  wanted = at;
  for (let more = true; more && mine === wish; await turn()) {
    more = asked("more", SHARE);
    tell();
    show();
  }
}

function tell() {
  const told = asked("told");
  if (!told) return;
  Object.assign(run, { known: told.known, finished: told.finished });
  say(told);
}

// sends the step that is wanted, as soon as it is known
function show() {
  if (wanted === null || !run) return;
  const { known, finished } = run, last = known - 1;
  const k = wanted < 0 ? (finished ? Math.max(0, known + wanted) : null) : wanted <= last ? wanted : finished ? last : null;
  if (k === null || k < 0) return;
  wanted = null;
  const pair = calls.step(k), [head, bytes] = pair.toJs();
  pair.destroy();
  const scene = bytes.slice().buffer;
  say({ ...JSON.parse(head), scene }, [scene]);
}

function seek({ k }) {
  wanted = k;
  show();
}

function click({ k, p_origin, v_ray }) {
  const values = asked("click", k, p_origin, v_ray);
  if (values && Object.keys(values).length) say({ tell: "picked", values });
}

// a student's function drives the next run; a text that cannot be used changes nothing
function use({ name, text }) {
  const used = asked("use", name, text);
  if (used) say({ tell: "used", ...used });
}

async function judge({ name, text }) {
  const report = asked("judge", name, text);
  if (report) say({ tell: "report", report });
}

function rest() {
  wish += 1;
  run = wanted = null;
}

const verbs = { start, begin, seek, click, use, judge, rest };
const failed = (error) => say({ tell: calls ? "trouble" : "failed", text: String(error.message ?? error).trim().split("\n").pop().slice(0, 300) });
self.onmessage = async ({ data: { verb, ...given } }) => {
  try { await verbs[verb](given); } catch (error) { failed(error); }
};
