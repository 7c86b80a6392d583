/** How parts look: layers on and off, see-through visuals, and what is selected. */

import {
  Color,
  GreaterDepth,
  MeshBasicMaterial,
  Mesh,
  NotEqualStencilFunc,
  ReplaceStencilOp,
} from "three";

/** The layers in the order in which one thinks of them. */
const LAYERS = ["visual", "collision", "inertia", "frame", "joint", "mass", "view"];
const SEE_THROUGH = 0.3;
const SELECTED = 1; // in the stencil, where the selection itself is seen

/** @typedef {import("./model.js").Item} Item */
/** @typedef {import("three").Mesh} AnyMesh */

export class Appearance {
  /** @param {Item[]} items */
  constructor(items) {
    this.items = items;
    const names = new Set(items.map(({ layer }) => layer));
    this.layers = [...LAYERS.filter((name) => names.delete(name)), ...names];
    const first = this.layers.includes("visual") ? "visual" : "collision";
    /** @type {Map<string, boolean | string>} */
    this.modes = new Map(this.layers.map((name) => [name, name === first]));
    if (first === "visual") this.modes.set("visual", "opaque");
    this.own = new Map(items.flatMap(({ meshes }) => meshes.map((mesh) => [mesh, mesh.material])));
    /** @type {Set<Item>} */
    this.selected = new Set();
    /** @type {Mesh[]} */
    this.ghosts = [];
    this.seeThrough = variants(seeThrough);
  }

  /**
   * @param {string} name
   * @param {boolean | string} mode
   */
  setLayer(name, mode) {
    if (!this.modes.has(name)) return;
    const known = name === "visual" && (mode === "opaque" || mode === "transparent");
    this.modes.set(name, name !== "visual" ? mode === true : known ? mode : "off");
    this.apply();
  }

  /** @param {Iterable<Item>} items */
  select(items) {
    this.selected = new Set(items);
    this.apply();
  }

  /** @param {import("./theme.js").Theme} theme */
  paint({ accent }) {
    this.tinted = variants((material) => tinted(material, accent));
    this.ghost = ghostOf(accent);
    this.apply();
  }

  /** @param {Item} item @returns {boolean} Whether one sees through it. */
  isClear({ layer }) {
    return layer !== "visual" || this.modes.get("visual") === "transparent";
  }

  /** Bring all parts in line with layers and selection. */
  apply() {
    this.ghosts.splice(0).forEach((ghost) => ghost.removeFromParent());
    for (const item of this.items) {
      const mode = this.modes.get(item.layer);
      const selected = this.selected.has(item);
      item.node.visible = selected || (mode !== false && mode !== "off");
      for (const mesh of item.node.visible ? item.meshes : []) {
        const own = /** @type {Any} */ (this.own.get(mesh));
        const look = mode === "transparent" ? this.seeThrough(own) : own;
        const marked = selected && item.layer !== "frame"; // its colours are the names of its axes
        mesh.material = marked && this.tinted ? this.tinted(own) : look;
        mesh.castShadow = mode === "opaque";
        if (marked) this.#haunt(mesh);
      }
    }
  }

  /** Let a mesh be seen through what hides it. @param {AnyMesh} mesh */
  #haunt(mesh) {
    if (!mesh.isMesh) return;
    const ghost = new Mesh(mesh.geometry, this.ghost);
    ghost.renderOrder = 1;
    mesh.add(ghost);
    this.ghosts.push(ghost);
  }
}

/** @typedef {import("three").MeshLambertMaterial | MeshBasicMaterial} Any */

/** Make each material's variant once. @type {(make: (own: Any) => Any) => (own: Any) => Any} */
function variants(make) {
  /** @type {Map<Any, Any>} */
  const made = new Map();
  return (own) => {
    if (!made.has(own)) made.set(own, make(own));
    return /** @type {Any} */ (made.get(own));
  };
}

/** @type {(own: Any) => Any} */
function seeThrough(own) {
  const clear = own.clone();
  Object.assign(clear, { transparent: true, depthWrite: false, opacity: own.opacity * SEE_THROUGH });
  return clear;
}

/** @type {(own: Any, accent: number) => Any} */
function tinted(own, accent) {
  const bright = own.clone();
  Object.assign(bright, { vertexColors: false, stencilWrite: true, stencilRef: SELECTED });
  bright.stencilZPass = ReplaceStencilOp;
  bright.color.lerp(new Color(accent), 0.75);
  if ("emissive" in bright) bright.emissive.set(accent).multiplyScalar(0.3);
  if (bright.transparent) bright.opacity = Math.max(bright.opacity, 0.45);
  return bright;
}

/** @type {(accent: number) => Any} */
function ghostOf(accent) {
  return new MeshBasicMaterial({
    color: accent,
    transparent: true,
    opacity: 0.55,
    depthWrite: false,
    depthFunc: GreaterDepth,
    stencilWrite: true,
    stencilRef: SELECTED,
    stencilFunc: NotEqualStencilFunc,
    stencilZPass: ReplaceStencilOp, // a place is tinted once, however many faces lie behind it
  });
}
