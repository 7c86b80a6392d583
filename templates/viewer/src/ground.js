/** A grid on the ground: lines every 0.1 m, 1 m, 10 m, …, the finer ones only where one is near. */

import { Color, DoubleSide, Mesh, PlaneGeometry, ShaderMaterial, Vector2 } from "three";

const LEVELS = [0.1, 1, 10, 100]; // metres
const CLEAR = 14; // CSS pixels between lines that one can tell apart

const VERTEX = `
  varying vec2 place;
  void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    place = world.xz;
    gl_Position = projectionMatrix * viewMatrix * world;
  }`;

const FRAGMENT = `
  uniform vec3 colour;
  uniform vec2 centre;
  uniform float reach;
  varying vec2 place;

  // How strong lines are: thin ones where they are many, bolder ones where they are few.
  float lines(float spacing) {
    vec2 cell = place / spacing;
    vec2 perPixel = fwidth(cell);
    vec2 pixels = abs(fract(cell - 0.5) - 0.5) / perPixel;
    float apart = 1.0 / max(perPixel.x, perPixel.y);
    float line = 1.0 - min(min(pixels.x, pixels.y), 1.0);
    return line * mix(0.12, 0.42, smoothstep(30.0, 500.0, apart)) * smoothstep(6.0, 24.0, apart);
  }

  void main() {
    float strength = max(max(lines(0.1), lines(1.0)), max(lines(10.0), lines(100.0)));
    float fade = 1.0 - smoothstep(0.15, 1.0, distance(place, centre) / reach);
    gl_FragColor = vec4(colour, strength * fade);
    #include <colorspace_fragment>
  }`;

export class Ground {
  /** @param {number} height Of the ground, metres. */
  constructor(height) {
    const uniforms = {
      colour: { value: new Color() },
      centre: { value: new Vector2() },
      reach: { value: 1 },
    };
    const material = new ShaderMaterial({
      uniforms,
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      transparent: true,
      depthWrite: false,
      side: DoubleSide,
    });
    this.uniforms = uniforms;
    this.mesh = new Mesh(new PlaneGeometry(2, 2), material);
    this.mesh.rotation.x = -Math.PI / 2;
    this.mesh.position.y = height;
    this.mesh.renderOrder = -2; // before all that is clear
  }

  /** @param {import("./theme.js").Theme} theme */
  paint({ grid }) {
    this.uniforms.colour.value.set(grid);
  }

  /**
   * Lie below what is looked at.
   *
   * @param {import("three").Vector3} target
   * @param {number} reach Metres to where the grid fades out.
   */
  lieBelow({ x, z }, reach) {
    this.mesh.position.setX(x).setZ(z);
    this.mesh.scale.setScalar(reach);
    this.uniforms.centre.value.set(x, z);
    this.uniforms.reach.value = reach;
  }
}

/**
 * Say how far the lines are apart that one sees.
 *
 * @param {number} metresPerPixel Where one looks.
 * @returns {string} Nothing where there are none.
 */
export function scaleOf(metresPerPixel) {
  const finest = LEVELS.find((spacing) => spacing / metresPerPixel >= CLEAR);
  return finest === undefined ? "" : `Grid ${finest} m`;
}
