/** Where one looks from: by hand, in gentle flights, and along with the robot. */

import { MathUtils, PerspectiveCamera, Quaternion, Spherical, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const FIELD_OF_VIEW = 32; // degrees; narrow, so that shapes keep their proportions
const FLIGHT = 500; // milliseconds
const STEEPEST = 0.001; // radians from the vertical: exactly above, "up" has no direction

/** Where the eye is, seen from the robot: x forward, y to the left, z up. */
const VIEWS = {
  home: [1, -0.8, 0.55],
  front: [1, 0, 0.06],
  side: [0, -1, 0.06],
  top: [-STEEPEST, 0, 1],
};

/** Two fingers turn and zoom; one scrolls the page, or turns to the sides. */
const TWO_FINGERS_TURN = 3; // TOUCH.DOLLY_ROTATE

export class Rig {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {{reducedMotion: boolean, changed: () => void}} options
   */
  constructor(canvas, { reducedMotion, changed }) {
    this.canvas = canvas;
    this.reducedMotion = reducedMotion;
    this.changed = changed;
    this.camera = new PerspectiveCamera(FIELD_OF_VIEW);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = !reducedMotion;
    this.controls.dampingFactor = 0.2;
    this.controls.touches.TWO = TWO_FINGERS_TURN;
    canvas.style.touchAction = "pan-y";
    this.controls.addEventListener("change", changed);
    this.controls.addEventListener("start", () => this.#take());
    this.radius = 1;
    this.centre = new Vector3();
    this.turned = new Quaternion();
    this.atHome = true;
    /** @type {{from: Stand, to: Stand, start: number | undefined} | undefined} */
    this.flight = undefined;
  }

  /** @typedef {{target: Vector3, offset: Spherical}} Stand What is looked at, and from where. */

  /**
   * Take the robot's size.
   *
   * @param {number} radius Of the sphere around it, metres.
   */
  measure(radius) {
    this.radius = radius;
    [this.camera.near, this.camera.far] = [radius / 50, radius * 500];
    [this.controls.minDistance, this.controls.maxDistance] = [radius / 10, radius * 100];
    this.camera.updateProjectionMatrix();
  }

  /**
   * Tell where the robot is.
   *
   * @param {Vector3} centre
   * @param {Quaternion} turned From how it stood at first.
   * @param {boolean} follow Whether to go along.
   */
  robotAt(centre, turned, follow) {
    if (follow) {
      const way = centre.clone().sub(this.centre);
      for (const one of [this.camera.position, this.controls.target]) one.add(way);
      this.flight?.from.target.add(way);
      this.flight?.to.target.add(way);
      this.controls.update(); // now, or the next picture would be drawn twice
    }
    this.centre.copy(centre);
    this.turned.copy(turned);
  }

  /** @param {string} name One of VIEWS, else home. */
  view(name) {
    this.#fly(this.#seenFrom(name));
    this.atHome = name === "home";
  }

  /**
   * Look at a part from where the eye is, near enough to see it and its surroundings.
   *
   * @param {import("three").Sphere} part
   */
  frame({ center, radius }) {
    const seen = MathUtils.clamp(1.8 * radius, 0.5 * this.radius, this.radius);
    const { offset } = this.#stand();
    offset.radius = this.#distance(seen);
    this.#fly({ target: center.clone(), offset });
  }

  /** @param {number} aspect Width by height of the canvas. */
  resize(aspect) {
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
    if (this.atHome) this.#arrive(this.#seenFrom("home"));
  }

  /**
   * Turn around what is looked at.
   *
   * @param {number} left Radians.
   * @param {number} up Radians.
   */
  orbit(left, up) {
    this.#take();
    this.controls.rotateLeft(left);
    this.controls.rotateUp(up);
    this.changed();
  }

  /** @param {number} factor Of the distance. */
  zoom(factor) {
    this.#take();
    const { target, offset } = this.#stand();
    const { minDistance, maxDistance } = this.controls;
    offset.radius = MathUtils.clamp(offset.radius * factor, minDistance, maxDistance);
    this.#place({ target, offset });
    this.changed();
  }

  /** Go on with what moves. @param {number} now Milliseconds. @returns {boolean} Whether it does. */
  update(now) {
    if (this.flight) {
      const { from, to } = this.flight;
      this.flight.start ??= now;
      const part = MathUtils.smootherstep(now - this.flight.start, 0, FLIGHT);
      this.#place(between(from, to, part));
      if (part === 1) this.flight = undefined;
    } else {
      this.controls.update();
    }
    return this.flight !== undefined;
  }

  /** Metres per CSS pixel where one looks. */
  get metresPerPixel() {
    const height = 2 * Math.tan(MathUtils.degToRad(FIELD_OF_VIEW) / 2) * this.controls.getDistance();
    return height / Math.max(1, this.canvas.clientHeight);
  }

  dispose() {
    this.controls.dispose();
  }

  /** The distance at which a sphere fills most of the picture. @type {(radius: number) => number} */
  #distance(radius) {
    const half = MathUtils.degToRad(FIELD_OF_VIEW) / 2;
    const narrow = Math.atan(Math.tan(half) * Math.min(1, this.camera.aspect));
    return radius / Math.sin(narrow);
  }

  /** @type {(name: string) => Stand} */
  #seenFrom(name) {
    const [x, y, z] = VIEWS[/** @type {keyof VIEWS} */ (name)] ?? VIEWS.home;
    const ahead = new Vector3(1, 0, 0).applyQuaternion(this.turned);
    const eye = new Vector3(x, z, -y).applyAxisAngle(UP, Math.atan2(-ahead.z, ahead.x));
    const offset = new Spherical().setFromVector3(eye);
    offset.radius = 0.9 * this.#distance(this.radius); // no robot fills its sphere
    return { target: this.centre.clone(), offset };
  }

  /** @returns {Stand} */
  #stand() {
    const offset = this.camera.position.clone().sub(this.controls.target);
    return { target: this.controls.target.clone(), offset: new Spherical().setFromVector3(offset) };
  }

  /** @param {Stand} stand */
  #place({ target, offset }) {
    this.controls.target.copy(target);
    this.camera.position.setFromSpherical(offset).add(target);
    this.controls.update();
  }

  /** @param {Stand} to */
  #fly(to) {
    this.atHome = false;
    to.offset.phi = Math.max(STEEPEST, to.offset.phi);
    if (this.reducedMotion) this.#arrive(to);
    else this.flight = { from: this.#stand(), to, start: undefined };
    this.changed();
  }

  /** @param {Stand} stand */
  #arrive(stand) {
    this.flight = undefined;
    this.#place(stand);
  }

  /** Leave the camera to the user. */
  #take() {
    this.flight = undefined;
    this.atHome = false;
  }
}

const UP = new Vector3(0, 1, 0);

/** @type {(from: Stand, to: Stand, part: number) => Stand} */
function between(from, to, part) {
  const [a, b] = [from.offset, to.offset];
  const turn = MathUtils.euclideanModulo(b.theta - a.theta + Math.PI, 2 * Math.PI) - Math.PI;
  const offset = new Spherical(
    a.radius * (b.radius / a.radius) ** part,
    MathUtils.lerp(a.phi, b.phi, part),
    a.theta + turn * part,
  );
  return { target: from.target.clone().lerp(to.target, part), offset };
}
