/** Where the robot is: its size, its middle, which way it has turned, and its course. */

import { PropertyBinding, Quaternion, Vector3 } from "three";
import { boxOf } from "./model.js";

const SMALLEST = 1e-3; // metres; nothing is looked at from nearer

/**
 * @typedef {object} Course
 * @property {import("three").Object3D} node The link that tells where the robot is.
 * @property {ArrayLike<number>} times Seconds.
 * @property {ArrayLike<number>} places x, y, z of each, in the node's parent.
 */

export class Robot {
  /** @param {import("./model.js").Model} model As it stands at first. */
  constructor(model) {
    const box = boxOf(model);
    this.radius = Math.max(box.getSize(new Vector3()).length() / 2, SMALLEST);
    this.course = courseOf(model);
    this.ground = this.course ? 0 : box.min.y; // trials take place at 0
    this.node = this.course?.node ?? model.root;
    this.middle = this.node.worldToLocal(box.getCenter(new Vector3()));
    this.first = this.node.getWorldQuaternion(new Quaternion()).invert();
  }

  /** Its middle, as long as its shape does not change. */
  get centre() {
    return this.node.localToWorld(this.middle.clone());
  }

  /** Its rotation from how it stood at first. */
  get turned() {
    return this.node.getWorldQuaternion(new Quaternion()).multiply(this.first);
  }
}

/**
 * Find the link that carries most of those that move freely in the world: the robot's body.
 *
 * @type {(model: import("./model.js").Model) => Course | undefined}
 */
function courseOf({ root, clip }) {
  let most = 0;
  let course;
  for (const { name, times, values } of clip?.tracks ?? []) {
    const { nodeName, propertyName } = PropertyBinding.parseTrackName(name);
    const node = propertyName === "position" ? root.getObjectByName(nodeName) : undefined;
    const carried = node ? sizeOf(node) : 0;
    if (!node || carried <= most) continue;
    most = carried;
    course = { node, times, places: values };
  }
  return course;
}

/** @type {(node: import("three").Object3D) => number} */
const sizeOf = (node) => node.children.reduce((sum, child) => sum + sizeOf(child), 1);
