// Runs a Python script in Pyodide under node: node pyodide.mjs PYODIDE CORE.ZIP SCRIPT.PY [ARGUMENT ...]
// The script has `given`, its arguments, and `cpu()`, the seconds of a processor that were spent so far.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [folder, core, script, ...given] = process.argv.slice(2);
const cpu = () => { const { user, system } = process.cpuUsage(); return (user + system) / 1e6; };
try {
  const { loadPyodide } = await import(pathToFileURL(`${folder}/pyodide.mjs`).href);
  const python = await loadPyodide({ indexURL: folder });
  const spent = { python: cpu() };
  await python.loadPackage(["numpy", "scipy"], { messageCallback() {} });
  spent.packages = cpu() - spent.python;
  python.unpackArchive(new Uint8Array(readFileSync(core)), "zip", { extractDir: "/app" });
  spent.core = cpu() - spent.python - spent.packages;
  for (const [name, value] of Object.entries({ given, spent })) python.globals.set(name, python.toPy(value));
  python.globals.set("cpu", cpu);
  python.runPython(`import sys; sys.path.insert(0, "/app")`);
  python.runPython(readFileSync(script, "utf8"));
} catch (error) { // node's own report would print all of pyodide.asm.js
  console.error(String(error.message).slice(-4000));
  process.exit(1);
}
