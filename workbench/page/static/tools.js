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
