/**
 * The viewer: what the page calls. The bundle offers `create` as `SubtCheckViewer.create`, and
 * `plot` likewise.
 */

import { Quaternion, Vector3 } from "three";
import { Appearance } from "./appearance.js";
import { Rig } from "./camera.js";
import { Ground, scaleOf } from "./ground.js";
import { lendWheel, listenForKeys } from "./hands.js";
import { readModel, sphereAround } from "./model.js";
import { Overlay } from "./overlay.js";
import { Parts } from "./parts.js";
import { itemAt, listenForClicks } from "./picking.js";
import { Playback } from "./playback.js";
import { Robot } from "./robot.js";
import { Stage } from "./stage.js";
import { themeOf } from "./theme.js";
import { Trail } from "./trail.js";

export { plot } from "./plot.js";

/**
 * Show a robot.
 *
 * @param {HTMLElement} host What the picture fills; its size is the page's affair.
 * @param {ArrayBuffer} glb
 * @param {{theme?: "light" | "dark", reducedMotion?: boolean, rich?: boolean}} [options] `rich`:
 *   whether with shadows and smooth edges; decided by the viewer where it is not given.
 * @returns {Promise<Viewer>}
 * @throws {Error} If the file is no GLB, or the browser cannot draw in 3D. The host stays as it was.
 */
export async function create(host, glb, { theme = "light", reducedMotion = false, rich } = {}) {
  const model = await readModel(glb);
  return new Viewer(new Stage(host, rich), model, theme, reducedMotion);
}

const TRAIL = 25; // radii of the robot by widths of its trail
const REACH = 40; // radii that one sees of the ground, at least

class Viewer {
  /** @type {(time: number) => void} Called for each picture that shows another moment. */
  onTime = () => {};
  /** @type {(element: string, name: string) => void} Called for each click; "" for one beside. */
  onSelect = () => {};

  #stage;
  #model;
  #playback;
  #rig;
  #appearance;
  #parts;
  #overlay;
  #robot;
  #ground;
  #trail;
  /** @type {import("./parts.js").Part | undefined} */
  #selected;
  #follow = true;
  #ended = new AbortController();
  #resized = new ResizeObserver(() => this.resize());
  #request = 0;
  #last = NaN; // milliseconds of the picture before
  #told = 0; // the moment that onTime heard of, seconds

  /**
   * @param {Stage} stage
   * @param {import("./model.js").Model} model
   * @param {string} theme
   * @param {boolean} reducedMotion
   */
  constructor(stage, model, theme, reducedMotion) {
    this.#stage = stage;
    this.#model = model;
    stage.scene.add(model.root);
    this.#playback = new Playback(model.root, model.clip);
    model.root.updateMatrixWorld(true);
    this.#appearance = new Appearance(model.items);
    this.#parts = new Parts(model);
    this.#overlay = new Overlay(stage.host);
    this.#robot = new Robot(model);
    const { course, radius, ground } = this.#robot;
    this.#ground = new Ground(ground);
    this.#trail = course && new Trail(course, radius / TRAIL, ground);
    stage.scene.add(this.#ground.mesh, ...(this.#trail ? [this.#trail.group] : []));
    this.#rig = new Rig(stage.canvas, { reducedMotion, changed: () => this.#invalidate() });
    this.#rig.measure(radius);
    this.#rig.resize(1); // until the host has a size
    this.#listen();
    this.#moved();
    this.setTheme(theme);
    this.resize();
  }

  /** Seconds of the trial; 0 without one. */
  get duration() {
    return this.#playback.duration;
  }

  get playing() {
    return this.#playback.playing;
  }

  /** Seconds of the trial per second. */
  get speed() {
    return this.#playback.speed;
  }

  set speed(speed) {
    if (Number.isFinite(speed) && speed > 0) this.#playback.speed = speed;
  }

  /** Names of the layers that the file holds. */
  get layers() {
    return [...this.#appearance.layers];
  }

  /** Whether the camera goes along with the robot. */
  get follow() {
    return this.#follow;
  }

  set follow(follow) {
    this.#follow = Boolean(follow);
  }

  /** @param {number} time Seconds since the trial began. */
  seek(time) {
    this.#playback.seek(time);
    this.#moved();
  }

  /** Go on; at the end, begin anew. */
  play() {
    this.#playback.play();
    this.#last = NaN;
    this.#invalidate();
  }

  pause() {
    this.#playback.pause();
    this.#invalidate();
  }

  /**
   * @param {string} name
   * @param {"opaque" | "transparent" | "off" | boolean} mode A boolean for all but "visual".
   */
  setLayer(name, mode) {
    this.#appearance.setLayer(name, mode);
    this.#invalidate();
  }

  /**
   * Highlight the part that an element of the package belongs to, and look at it.
   *
   * @param {string} path As findings have it; "" for none.
   * @returns {string} The part's own path; "" where there is none.
   */
  select(path) {
    this.#mark(this.#parts.find(path));
    const items = this.#selected?.items ?? [];
    if (items.length) this.#rig.frame(sphereAround(items.map(({ node }) => node)));
    return this.#selected?.element ?? "";
  }

  /**
   * Which part of the robot an element of the package belongs to.
   *
   * @param {string} path As findings have it.
   * @returns {{element: string, name: string} | undefined}
   */
  partOf(path) {
    const part = this.#parts.find(path);
    return part && { element: part.element, name: part.name };
  }

  /** @param {"home" | "front" | "side" | "top"} name */
  view(name) {
    this.#rig.view(name);
  }

  /** @param {string} name */
  setTheme(name) {
    const theme = themeOf(name);
    for (const one of [this.#stage, this.#ground, this.#trail, this.#appearance, this.#overlay]) {
      one?.paint(theme);
    }
    this.#invalidate();
  }

  /** Take the host's size; it is called whenever that changes. */
  resize() {
    if (!this.#stage.fit()) return;
    const { clientWidth, clientHeight } = this.#stage.host;
    this.#rig.resize(clientWidth / clientHeight);
    this.#draw(); // at once: a resized canvas is empty
  }

  dispose() {
    cancelAnimationFrame(this.#request);
    this.#ended.abort();
    this.#resized.disconnect();
    this.#rig.dispose();
    this.#overlay.dispose();
    this.#stage.dispose();
  }

  /** What is shown, in the frame of the trial: z up, metres. For tests. */
  state() {
    const { camera, controls } = this.#rig;
    return {
      time: this.#playback.time,
      selected: this.#selected?.element ?? "",
      layers: Object.fromEntries(this.#appearance.modes),
      camera: { position: zUp(camera.position), target: zUp(controls.target) },
      partPoses: Object.fromEntries(this.#model.links.map(({ name, node }) => [name, poseOf(node)])),
    };
  }

  #listen() {
    const { canvas, host } = this.#stage;
    const { signal } = this.#ended;
    listenForKeys(canvas, this.#rig, this.#model.robot, signal);
    listenForClicks(canvas, (place) => this.#click(place), signal);
    lendWheel(canvas, () => this.#overlay.tell("Click the view to zoom with the wheel"), signal);
    canvas.addEventListener("webglcontextrestored", () => this.#invalidate(), { signal });
    this.#resized.observe(host);
  }
  /** @param {import("three").Vector2} place */
  #click(place) {
    const item = itemAt(place, this.#rig.camera, this.#appearance);
    this.#mark(item && this.#parts.find(item.element));
    this.onSelect(this.#selected?.element ?? "", this.#selected?.name ?? "");
  }

  /** @param {import("./parts.js").Part | undefined} part */
  #mark(part) {
    this.#selected = part;
    this.#appearance.select(part?.items ?? []);
    this.#invalidate();
  }

  /** Have everything follow the robot to the moment shown. */
  #moved() {
    this.#model.root.updateMatrixWorld(true);
    const { centre, turned, radius, ground } = this.#robot;
    this.#rig.robotAt(centre, turned, this.#follow);
    this.#stage.shineOn(centre, radius, ground);
    this.#trail?.seek(this.#playback.time);
    this.#invalidate();
  }

  /** Ask for a picture: nothing is drawn while nothing changes. */
  #invalidate() {
    this.#request ||= requestAnimationFrame((now) => this.#frame(now));
  }

  /** @param {number} now Milliseconds. */
  #frame(now) {
    this.#request = 0;
    if (this.#playback.playing) {
      this.#playback.advance(Number.isNaN(this.#last) ? 0 : (now - this.#last) / 1000);
      this.#moved();
    }
    this.#last = now;
    if (this.#rig.update(now)) this.#invalidate();
    this.#draw();
    if (this.#playback.time === this.#told) return;
    this.#told = this.#playback.time;
    this.onTime(this.#told);
  }

  #draw() {
    const { camera, controls, metresPerPixel } = this.#rig;
    this.#ground.lieBelow(controls.target, Math.max(REACH * this.#robot.radius, 3 * controls.getDistance()));
    this.#stage.draw(camera);
    this.#overlay.tellScale(scaleOf(metresPerPixel));
    const { center, radius } = sphereAround((this.#selected?.items ?? []).map(({ node }) => node));
    const up = new Vector3(0, 1, 0).applyQuaternion(camera.quaternion);
    this.#overlay.point(this.#selected?.name ?? "", center.addScaledVector(up, radius), camera);
  }
}

/** @type {(place: Vector3) => number[]} */
const zUp = ({ x, y, z }) => [x, -z, y];

/** @type {(node: import("three").Object3D) => {position: number[], quaternion: number[]}} */
function poseOf(node) {
  const upright = new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), Math.PI / 2);
  const turned = upright.multiply(node.getWorldQuaternion(new Quaternion()));
  return {
    position: zUp(node.getWorldPosition(new Vector3())),
    quaternion: turned.toArray(), // x, y, z, w
  };
}
