/** Words over the picture: the selected part's name, the scale of the ground, a hint. */

import { Vector3 } from "three";

const MARGIN = 8; // CSS pixels between a label and the edge
const HINT = 1800; // milliseconds

export class Overlay {
  /** @param {HTMLElement} host */
  constructor(host) {
    this.host = host;
    this.name = label(host, { maxWidth: "min(22rem, 80%)", fontWeight: "600" });
    this.scale = label(host, { left: `${MARGIN}px`, bottom: `${MARGIN}px`, fontVariantNumeric: "tabular-nums" });
    this.hint = label(host, { left: "50%", bottom: "50%", transform: "translateX(-50%)" });
    this.hint.setAttribute("aria-hidden", "true");
  }

  /** @param {import("./theme.js").Theme} theme */
  paint({ ink, paper, accent }) {
    for (const one of [this.name, this.scale, this.hint]) {
      Object.assign(one.style, { color: ink, background: paper });
    }
    this.name.style.border = `2px solid #${accent.toString(16).padStart(6, "0")}`;
  }

  /**
   * Put the selected part's name above it.
   *
   * @param {string} name Nothing for none.
   * @param {Vector3} top Where the part is highest, in the world.
   * @param {import("three").Camera} camera
   */
  point(name, top, camera) {
    const { x, y, z } = new Vector3().copy(top).project(camera);
    this.name.hidden = !name || z > 1;
    if (this.name.hidden) return;
    if (this.name.textContent !== name) this.name.textContent = name;
    const { clientWidth, clientHeight } = this.host;
    const { offsetWidth, offsetHeight } = this.name;
    const left = ((1 + x) / 2) * clientWidth - offsetWidth / 2;
    const above = ((1 - y) / 2) * clientHeight - offsetHeight - MARGIN;
    this.name.style.left = `${within(left, clientWidth - offsetWidth)}px`;
    this.name.style.top = `${within(above, clientHeight - offsetHeight)}px`;
  }

  /** @param {string} text */
  tellScale(text) {
    this.scale.hidden = !text;
    if (this.scale.textContent !== text) this.scale.textContent = text;
  }

  /** @param {string} text */
  tell(text) {
    this.hint.textContent = text;
    this.hint.hidden = false;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => (this.hint.hidden = true), HINT);
  }

  dispose() {
    clearTimeout(this.timer);
    for (const one of [this.name, this.scale, this.hint]) one.remove();
  }
}

/** @type {(value: number, most: number) => number} */
const within = (value, most) => Math.min(Math.max(MARGIN, value), Math.max(MARGIN, most - MARGIN));

/** @type {(host: HTMLElement, style: Partial<CSSStyleDeclaration>) => HTMLElement} */
function label(host, style) {
  const element = document.createElement("div");
  element.dir = "auto";
  element.hidden = true;
  Object.assign(element.style, {
    position: "absolute",
    padding: "0.15em 0.55em",
    borderRadius: "0.4em",
    font: "0.8125rem/1.4 system-ui, sans-serif",
    whiteSpace: "nowrap",
    overflow: "hidden",
    textOverflow: "ellipsis",
    pointerEvents: "none",
    ...style,
  });
  host.append(element);
  return element;
}
