/** The canvas with what draws on it: WebGL, light and shadow. */

import {
  Color,
  DirectionalLight,
  HemisphereLight,
  Mesh,
  PlaneGeometry,
  Scene,
  ShadowMaterial,
  WebGLRenderer,
} from "three";

const FINEST = 2; // device pixels per CSS pixel; more is not seen and costs much
const SHADOW_PIXELS = 1024;

export class Stage {
  /**
   * @param {HTMLElement} host What the canvas fills.
   * @param {boolean} [rich] Whether to draw shadows and smooth edges; where nobody says, only where
   *   there is a graphics card: without, they take several times as long as all the rest.
   * @throws {Error} If the browser cannot draw in 3D.
   */
  constructor(host, rich = hasGraphicsCard()) {
    this.host = host;
    this.rich = rich;
    this.canvas = document.createElement("canvas");
    Object.assign(this.canvas.style, { position: "absolute", inset: "0", width: "100%", height: "100%" });
    const wishes = { antialias: rich, stencil: true };
    const context = /** @type {WebGL2RenderingContext | null} */ (
      this.canvas.getContext("webgl2", wishes)
    );
    if (!context) throw new Error("this browser cannot draw in 3D: it offers no WebGL 2");
    this.renderer = new WebGLRenderer({ canvas: this.canvas, context });
    this.renderer.shadowMap.enabled = rich;
    this.scene = new Scene();
    this.sky = new HemisphereLight(0xffffff, 0xffffff, 1.7);
    this.sun = new DirectionalLight(0xffffff, 1.9);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(SHADOW_PIXELS, SHADOW_PIXELS);
    this.sun.shadow.radius = 4;
    this.floor = new Mesh(new PlaneGeometry(), new ShadowMaterial({ depthWrite: false }));
    this.floor.visible = rich;
    this.floor.receiveShadow = true;
    this.floor.rotation.x = -Math.PI / 2;
    this.floor.renderOrder = -3; // before the grid
    this.scene.add(this.sky, this.sun, this.sun.target, this.floor);
    if (getComputedStyle(host).position === "static") host.style.position = "relative";
    host.append(this.canvas);
  }

  /**
   * @param {import("./theme.js").Theme} theme
   */
  paint(theme) {
    this.scene.background = new Color(theme.background);
    this.sky.color.set(theme.sky);
    this.sky.groundColor.set(theme.earth);
    this.floor.material.opacity = theme.shadow;
  }

  /**
   * Let the sun shine on the robot, from its right, where most views are from.
   *
   * @param {import("three").Vector3} centre
   * @param {number} radius Of the robot, metres.
   * @param {number} ground Height of the ground, metres.
   */
  shineOn(centre, radius, ground) {
    const { sun, floor } = this;
    sun.target.position.copy(centre);
    sun.position.set(centre.x + radius / 2, centre.y + 3 * radius, centre.z + 1.6 * radius);
    const camera = sun.shadow.camera;
    [camera.left, camera.right, camera.bottom, camera.top] = [-radius, radius, -radius, radius];
    [camera.near, camera.far] = [radius / 10, 10 * radius + 2 * Math.max(0, centre.y - ground)];
    camera.updateProjectionMatrix();
    sun.shadow.normalBias = radius / 200;
    floor.position.set(centre.x, ground, centre.z);
    floor.scale.setScalar(6 * radius + 2 * Math.max(0, centre.y - ground));
  }

  /** Take the size of the host. @returns {boolean} Whether there is any. */
  fit() {
    const { clientWidth, clientHeight } = this.host;
    if (!clientWidth || !clientHeight) return false;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, this.rich ? FINEST : 1));
    this.renderer.setSize(clientWidth, clientHeight, false);
    return true;
  }

  /** @param {import("three").Camera} camera */
  draw(camera) {
    this.renderer.render(this.scene, camera);
  }

  dispose() {
    this.scene.traverse((object) => {
      const { geometry, material } = /** @type {Partial<Mesh>} */ (object);
      geometry?.dispose();
      [material ?? []].flat().forEach((one) => one.dispose());
    });
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.canvas.remove();
  }
}

/** Programs that draw in the place of a graphics card. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** @returns {boolean} Whether there is a graphics card, as far as one is told. */
function hasGraphicsCard() {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) return false;
  const masked = String(gl.getParameter(gl.RENDERER));
  const more = masked.startsWith("WebKit") ? gl.getExtension("WEBGL_debug_renderer_info") : null;
  const name = more ? String(gl.getParameter(more.UNMASKED_RENDERER_WEBGL)) : masked;
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return !SOFTWARE.test(name);
}
