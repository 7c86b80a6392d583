/** Clicks and taps on parts. */

import { Raycaster, Vector2 } from "three";

const STEADY = 5; // CSS pixels; a pointer that moves further drags
const FLUSH = 1e-3; // of the distance; faces that are nearer to each other lie in one
const MARKERS = ["joint", "mass", "frame"];
const BOUNDS = ["collision", "inertia"];

/**
 * Call back for each click or tap that is no drag.
 *
 * @param {HTMLCanvasElement} canvas
 * @param {(place: Vector2) => void} clicked Its place in the picture, both from -1 to 1.
 * @param {AbortSignal} signal
 */
export function listenForClicks(canvas, clicked, signal) {
  /** @type {PointerEvent | undefined} */
  let down;
  canvas.addEventListener("pointerdown", (event) => {
    down = event.isPrimary && event.button === 0 ? event : undefined;
  }, { signal });
  canvas.addEventListener("pointercancel", () => (down = undefined), { signal });
  canvas.addEventListener("pointerup", (event) => {
    const way = down ? Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) : NaN;
    down = undefined;
    if (!(way <= STEADY)) return;
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const [x, y] = [(event.clientX - left) / width, (event.clientY - top) / height];
    clicked(new Vector2(2 * x - 1, 1 - 2 * y));
  }, { signal });
}

/**
 * Return the item at a place of the picture. Of those seen one behind the other, the markers come
 * first, then what was switched on to be looked at, then the visuals, last what sensors see.
 *
 * @param {Vector2} place
 * @param {import("three").Camera} camera
 * @param {import("./appearance.js").Appearance} appearance
 * @returns {import("./model.js").Item | undefined}
 */
export function itemAt(place, camera, appearance) {
  const shown = appearance.items.filter(({ node }) => node.visible);
  const owners = new Map(shown.flatMap((item) => item.meshes.map((mesh) => [mesh, item])));
  const solid = [...owners.keys()].filter((mesh) => mesh.isMesh);
  const ray = new Raycaster();
  ray.setFromCamera(place, camera);
  let best;
  let wall = Infinity; // the distance at which nothing behind is seen
  for (const { object, distance } of ray.intersectObjects(solid, false)) {
    if (distance > wall) break;
    const item = /** @type {import("./model.js").Item} */ (owners.get(/** @type {any} */ (object)));
    if (!best || rank(item) < rank(best)) best = item;
    if (!appearance.isClear(item)) wall = Math.min(wall, distance * (1 + FLUSH));
  }
  return best;
}

/** @type {(item: import("./model.js").Item) => number} */
function rank({ layer }) {
  if (MARKERS.includes(layer)) return 0;
  if (BOUNDS.includes(layer)) return 1;
  return layer === "view" ? 3 : 2;
}
