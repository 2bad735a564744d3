// Small helpers that every part of the page uses.
"use strict";

const $ = (selector, root = document) => root.querySelector(selector);
const $$ = (selector, root = document) => [...root.querySelectorAll(selector)];

function element(name, properties = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

function escape(text) {
  return String(text).replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" }[c]));
}

// three digits, a true minus, no exponent where a person reads digits
function number(value) {
  const said = Number(Number(value).toPrecision(3)), size = Math.abs(said);
  const text = size && (size < 1e-3 || size >= 1e6)
    ? said.toExponential().replace("e+", "e") : said.toLocaleString("en", { maximumFractionDigits: 6 });
  return text.replaceAll("-", "−");
}

// a length in the unit that suits it, from µm to km, as numerals.py writes it in captions
function length(metres) {
  const size = Math.abs(metres);
  if (size < 1e-9) return "0 mm";
  if (size >= 999.5e3) return `${powered(metres / 1e3)} km`;
  if (size >= 0.1) return `${number(metres)} m`;
  return size >= 1e-6 ? `${number(1e3 * metres)} mm` : `${number(Number((1e6 * metres).toPrecision(2)))} µm`;
}

// three digits with a power of ten in place of an exponent: 1.14 × 10¹²
function powered(value) {
  const raised = (power) => [...power].map((c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["−0123456789".indexOf(c)]).join("");
  return number(value).replace(/e(−?\d+)$/, (_, power) => ` × 10${raised(power)}`);
}

// a value with its unit, as a sentence writes it
function measured(value, unit) {
  if (unit === "m") return length(value);
  const said = powered(value);
  return unit === "deg" || unit === "°" ? `${said}°` : `${said} ${unit ?? ""}`.trim();
}

// the number that a person typed, with a point or a comma before its decimals; undefined where it is none
function numberIn(text) {
  const said = text.trim().replace("−", "-").replace(",", ".");
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(said) && Number.isFinite(Number(said)) ? Number(said) : undefined;
}

// what this browser keeps: `kept.get(key)` is null where nothing is, or where nothing may be kept
const kept = {
  get(key) { try { return JSON.parse(localStorage.getItem(`workbench ${key}`)); } catch { return null; } },
  set(key, value) { try { localStorage.setItem(`workbench ${key}`, JSON.stringify(value)); } catch { /* private window */ } },
};
