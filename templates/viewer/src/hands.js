/** Keys and the wheel, and what they leave to the page. */

import { MathUtils } from "three";

const TURN = MathUtils.degToRad(10); // for each press
const ZOOM = 1.15;

/** @type {Record<string, (rig: import("./camera.js").Rig) => void>} */
const KEYS = {
  ArrowLeft: (rig) => rig.orbit(TURN, 0),
  ArrowRight: (rig) => rig.orbit(-TURN, 0),
  ArrowUp: (rig) => rig.orbit(0, TURN),
  ArrowDown: (rig) => rig.orbit(0, -TURN),
  "+": (rig) => rig.zoom(1 / ZOOM),
  "=": (rig) => rig.zoom(1 / ZOOM),
  "-": (rig) => rig.zoom(ZOOM),
  Home: (rig) => rig.view("home"),
};

/**
 * Make the canvas answer keys, and tell those who cannot see it what it is.
 *
 * @param {HTMLCanvasElement} canvas
 * @param {import("./camera.js").Rig} rig
 * @param {string} robot
 * @param {AbortSignal} signal
 */
export function listenForKeys(canvas, rig, robot, signal) {
  canvas.tabIndex = 0;
  canvas.style.outlineOffset = "-3px";
  canvas.setAttribute("role", "application");
  const what = robot ? `3D view of ${robot}` : "3D view";
  canvas.setAttribute("aria-label", `${what}: arrow keys turn, plus and minus zoom, Home resets`);
  canvas.addEventListener("keydown", (event) => {
    const answer = Object.hasOwn(KEYS, event.key) ? KEYS[event.key] : undefined;
    if (!answer || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    answer(rig);
  }, { signal });
}

/**
 * Let the wheel scroll the page until the view is clicked, and again once the pointer has left it.
 *
 * @param {HTMLCanvasElement} canvas
 * @param {() => void} passedOn Called when the page scrolls instead.
 * @param {AbortSignal} signal
 */
export function lendWheel(canvas, passedOn, signal) {
  let taken = false;
  canvas.addEventListener("pointerdown", () => (taken = true), { signal });
  canvas.addEventListener("pointerleave", () => (taken = false), { signal });
  canvas.addEventListener("wheel", (event) => {
    if (taken || event.ctrlKey) return; // ctrl: two fingers on a touchpad
    event.stopImmediatePropagation();
    passedOn();
  }, { signal, capture: true, passive: true });
}
