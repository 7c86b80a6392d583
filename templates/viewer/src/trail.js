/** The robot's path as a ribbon on the ground: all of it faint, what it has driven strong. */

import { BufferAttribute, BufferGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, Vector3 } from "three";

const FAINT = 0.25;
const STRONG = 0.85;

export class Trail {
  /**
   * @param {import("./robot.js").Course} course
   * @param {number} width Metres.
   * @param {number} height Of the ground, metres.
   */
  constructor({ node, times, places }, width, height) {
    this.times = times;
    const geometry = ribbon(pathOf(node, places), width, height + width / 20);
    this.faint = new Mesh(geometry, inkOf(FAINT));
    const driven = new BufferGeometry().setIndex(geometry.index);
    driven.setAttribute("position", geometry.getAttribute("position"));
    this.strong = new Mesh(driven, inkOf(STRONG));
    this.group = new Group().add(this.faint, this.strong);
    for (const mesh of [this.faint, this.strong]) mesh.renderOrder = -1;
  }

  /** @param {import("./theme.js").Theme} theme */
  paint({ trail }) {
    for (const { material } of [this.faint, this.strong]) material.color.set(trail);
  }

  /** @param {number} time Seconds since the trial began. */
  seek(time) {
    let [before, after] = [0, this.times.length];
    while (before < after) {
      const middle = (before + after) >> 1;
      if (this.times[middle] <= time) before = middle + 1;
      else after = middle;
    }
    this.strong.geometry.setDrawRange(0, 6 * Math.max(0, before - 1));
  }
}

/** @type {(opacity: number) => MeshBasicMaterial} */
const inkOf = (opacity) =>
  new MeshBasicMaterial({ transparent: true, opacity, depthWrite: false, side: DoubleSide });

/** @type {(node: import("three").Object3D, places: ArrayLike<number>) => Vector3[]} */
function pathOf(node, places) {
  const count = Math.floor(places.length / 3);
  return Array.from({ length: count }, (_, index) => {
    const place = new Vector3().fromArray(places, 3 * index);
    return node.parent ? place.applyMatrix4(node.parent.matrixWorld) : place;
  });
}

/**
 * Two triangles between each pair of points, flat on the ground.
 *
 * @type {(path: Vector3[], width: number, height: number) => BufferGeometry}
 */
function ribbon(path, width, height) {
  const corners = new Float32Array(6 * path.length);
  /** @type {number[]} */
  const faces = [];
  let [sideX, sideZ] = [0, width / 2];
  path.forEach(({ x, z }, index) => {
    const [last, next] = [path[Math.max(0, index - 1)], path[Math.min(path.length - 1, index + 1)]];
    const way = Math.hypot(next.x - last.x, next.z - last.z);
    if (way > width / 100) {
      [sideX, sideZ] = [((last.z - next.z) / way) * (width / 2), ((next.x - last.x) / way) * (width / 2)];
    }
    corners.set([x + sideX, height, z + sideZ, x - sideX, height, z - sideZ], 6 * index);
    if (index) faces.push(...[-2, -1, 0, 0, -1, 1].map((step) => 2 * index + step));
  });
  const geometry = new BufferGeometry().setIndex(faces);
  return geometry.setAttribute("position", new BufferAttribute(corners, 3));
}
