// A page of words alone: light or dark, as the others.
"use strict";

const isDark = kept.get("dark") ?? matchMedia("(prefers-color-scheme: dark)").matches;
document.documentElement.dataset.theme = isDark ? "dark" : "light";
