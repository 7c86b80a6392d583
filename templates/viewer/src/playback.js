/** The trial as an animation: which moment is shown, and how time goes on. */

import { AnimationMixer, LoopOnce } from "three";

const LONGEST_STEP = 0.5; // seconds between two frames; a page that slept does not jump

export class Playback {
  /**
   * @param {import("three").Object3D} root
   * @param {import("three").AnimationClip | undefined} clip
   */
  constructor(root, clip) {
    this.playing = false;
    this.speed = 1;
    this.duration = clip && Number.isFinite(clip.duration) ? Math.max(0, clip.duration) : 0;
    if (!clip || !this.duration) return;
    this.mixer = new AnimationMixer(root);
    this.action = this.mixer.clipAction(clip).setLoop(LoopOnce, 1).play();
    this.seek(0);
  }

  /** Seconds since the trial began. */
  get time() {
    return this.action?.time ?? 0;
  }

  /** @param {number} time Seconds; what lies outside the trial becomes its begin or end. */
  seek(time) {
    if (!this.action || !this.mixer || !Number.isFinite(time)) return;
    this.action.time = Math.min(Math.max(0, time), this.duration);
    this.mixer.update(0);
  }

  /** Go on, or begin anew at the end. */
  play() {
    if (!this.duration) return;
    if (this.time >= this.duration) this.seek(0);
    this.playing = true;
  }

  pause() {
    this.playing = false;
  }

  /** @param {number} seconds That have passed for who looks on. */
  advance(seconds) {
    if (!this.playing) return;
    this.seek(this.time + Math.min(seconds, LONGEST_STEP) * this.speed);
    if (this.time >= this.duration) this.playing = false;
  }
}
