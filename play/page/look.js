// Colours of the pictures, light and dark; those of the legs are the report's.

import { rgb, shade } from "./solids.js";

const hex = (colour) => `#${colour.map((c) => Math.round(Math.max(0, Math.min(255, c))).toString(16).padStart(2, "0")).join("")}`;

const LIGHT = {
  ink: "#1f2933", tag: "rgba(255,255,255,.9)", tile: "#dfe6ed", bump: "#c3ccd6", shadow: "rgba(25,40,60,.22)",
  shell: "#5d6f83", eye: "#8be0ff", crate: "#d9a766", alarm: "#b3261e", track: "#e6ebf0",
};
const DARK = {
  ink: "#e8edf2", tag: "rgba(16,22,29,.88)", tile: "#2b3744", bump: "#4a5968", shadow: "rgba(0,0,0,.42)",
  shell: "#8fa0b3", eye: "#8be0ff", crate: "#b98d55", alarm: "#ff8a7a", track: "#26313c",
};

/** Colours for a robot in the theme that the page has now. */
export function lookOf(robot) {
  const dark = window.matchMedia("(prefers-color-scheme: dark)").matches;
  const colours = robot.colours.map((colour) => (dark ? hex(shade(rgb(colour), 1.14)) : colour));
  return { ...(dark ? DARK : LIGHT), colours, dark };
}
