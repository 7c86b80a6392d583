/** The robot of a GLB file: its links, what hangs on them in layers, and its trial. */

import { Box3, Group, MeshLambertMaterial, Sphere, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

/**
 * @typedef {object} Item One thing to see: a visual, a joint, a sensor's view, ….
 * @property {import("three").Object3D} node
 * @property {string} layer
 * @property {string} name As the package's author wrote it.
 * @property {string} element Path of the element that it stands for.
 * @property {import("three").Mesh[]} meshes
 */

/**
 * @typedef {object} Link
 * @property {import("three").Object3D} node
 * @property {string} name
 * @property {string} element
 * @property {Item[]} items
 */

/**
 * @typedef {object} Model
 * @property {import("three").Object3D} root Y up.
 * @property {string} robot Its name.
 * @property {Link[]} links
 * @property {Item[]} items Of all links.
 * @property {import("three").AnimationClip | undefined} clip
 */

/**
 * Read a GLB file.
 *
 * @param {ArrayBuffer} glb
 * @returns {Promise<Model>}
 * @throws {Error} If it is none.
 */
export async function readModel(glb) {
  const loader = new GLTFLoader();
  loader.register((parser) => ({ name: "subt-check", beforeRoot: async () => prepare(parser.json) }));
  let file;
  try {
    file = await loader.parseAsync(glb, "");
  } catch (error) {
    throw new Error(`the 3D file cannot be read: ${error instanceof Error ? error.message : error}`);
  }
  const root = file.scene ?? new Group();
  makeMatt(root);
  return { root, robot: String(root.userData.robot ?? ""), ...partsOf(root), clip: file.animations[0] };
}

/** @typedef {{name?: string, uri?: string, extras?: {name?: string}}} Entry */

/**
 * Give each node a name that is no other's: animations find their nodes by it, and robots have
 * links of any name. The real one stays in the extras. Refuse what would be fetched.
 *
 * @param {{nodes?: Entry[], meshes?: Entry[], buffers?: Entry[], images?: Entry[]}} json
 */
function prepare(json) {
  const outside = [...(json.buffers ?? []), ...(json.images ?? [])].find(({ uri }) => uri);
  if (outside) throw new Error("it refers to other files");
  json.nodes?.forEach((node, index) => {
    node.extras = { ...node.extras, name: node.extras?.name ?? node.name ?? "" };
    node.name = `node${index}`;
  });
  json.meshes?.forEach((mesh) => delete mesh.name);
}

/**
 * Give all surfaces a matt material: what robots' files tell of theirs is a colour, and this one is
 * quick without a graphics card, too.
 *
 * @param {import("three").Object3D} root
 */
function makeMatt(root) {
  const made = new Map();
  for (const mesh of meshesBelow(root)) {
    const own = /** @type {import("three").MeshStandardMaterial} */ (mesh.material);
    if (!own.isMeshStandardMaterial) continue;
    if (!made.has(own)) {
      const { color, opacity, transparent, depthWrite, side, vertexColors, flatShading } = own;
      const look = { color, opacity, transparent, depthWrite, side, vertexColors, flatShading };
      made.set(own, new MeshLambertMaterial(look));
    }
    mesh.material = made.get(own);
  }
}

/**
 * @param {import("three").Object3D} root
 * @returns {{links: Link[], items: Item[]}}
 */
function partsOf(root) {
  /** @type {Link[]} */
  const links = [];
  /** @type {Item[]} */
  const items = [];
  /** @type {(node: import("three").Object3D, link: Link | undefined) => void} */
  const visit = (node, link) => {
    const { kind, layer, name, element } = node.userData;
    const label = { name: String(name ?? ""), element: String(element ?? "") };
    if (layer !== undefined) {
      const item = { node, layer: String(layer), ...label, meshes: meshesBelow(node) };
      items.push(item);
      link?.items.push(item);
      return;
    }
    let inner = link;
    if (kind === "link") {
      inner = { node, ...label, items: [] };
      links.push(inner);
    }
    node.children.forEach((child) => visit(child, inner));
  };
  visit(root, undefined);
  return { links, items };
}

/** @type {(node: import("three").Object3D) => import("three").Mesh[]} */
function meshesBelow(node) {
  /** @type {import("three").Mesh[]} */
  const meshes = [];
  node.traverse((object) => {
    if ("material" in object) meshes.push(/** @type {import("three").Mesh} */ (object));
  });
  return meshes;
}

/**
 * Return a box around the robot's body as it stands now: not around what its sensors see.
 *
 * @param {Model} model
 * @returns {Box3} One of 1 m, where there is no body.
 */
export function boxOf({ items }) {
  const body = items.filter(({ layer }) => layer === "visual" || layer === "collision");
  const box = new Box3();
  for (const { node } of body.length ? body : items) {
    const part = new Box3().setFromObject(node);
    if (isFinite(part)) box.union(part);
  }
  return box.isEmpty() ? new Box3(new Vector3(-0.5, 0, -0.5), new Vector3(0.5, 1, 0.5)) : box;
}

/** @type {(box: Box3) => boolean} */
const isFinite = (box) => [...box.min, ...box.max].every(Number.isFinite);

/**
 * Return the sphere around meshes as they stand now.
 *
 * @param {import("three").Object3D[]} objects
 * @returns {Sphere} One of radius 0, where there is nothing.
 */
export function sphereAround(objects) {
  const box = new Box3();
  for (const object of objects) box.expandByObject(object);
  return isFinite(box) ? box.getBoundingSphere(new Sphere()) : new Sphere(new Vector3(), 0);
}
