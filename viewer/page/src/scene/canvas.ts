// SPDX-License-Identifier: MIT
// The canvas of the scene: it draws when something has changed, looks now and then how long a frame takes until its
// last pixel, and leaves out what takes too long.
import * as THREE from "three";
import { Quality } from "./quality";

const kSamples = 4; // a pixel, of antialiasing
const kEvery = 3; // frames, between two that are measured
const kEveryIfQuick = 30;
const kQuick = 25; // ms
const kFilmEvery = 1000 / 30 - 4; // ms: a film's frames
const kKeptTimes = 100;
const kKept = "drawing"; // of localStorage: how much was left out

export class Canvas {
  // antialiasing comes and goes, which a canvas's own cannot
  readonly renderer = new THREE.WebGLRenderer({ antialias: false });
  readonly quality: Quality;
  dirty = true;
  drawing = true;
  private drawnAt = 0; // ms
  /** A film holds the size, and needs no more pictures than it shows. */
  private held = false;
  private paint: () => boolean = () => false;
  private change: (quality: Quality) => void = () => {};
  private readonly smooth = new THREE.WebGLRenderTarget(1, 1, { samples: kSamples });
  private readonly copy = new THREE.Scene();
  private readonly lens = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);
  private unmeasured = 0; // frames
  private readonly pixel = new Uint8Array(4);
  /** ms, of the last frames that were measured; for people who ask why. */
  readonly took: number[] = [];
  /** Hears that other things are left out. */
  readonly onQuality: (() => void)[] = [];

  constructor() {
    const kept = Number(localStorage.getItem(kKept) ?? 0);
    this.quality = new Quality(kept > 0 ? kept : 0, kept >= 0, window.devicePixelRatio);
    const { renderer, smooth } = this;
    renderer.debug.checkShaderErrors = false; // asking waits for the compiler, and ours compile
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    // colours as on the screen, in eight bits: what is transparent mixes there as it does without antialiasing
    smooth.texture.colorSpace = THREE.SRGBColorSpace;
    smooth.texture.internalFormat = "RGBA8";
    (smooth as any).isXRRenderTarget = true; // three's word for a target that holds what the screen would
    const quad = new THREE.Mesh(
      new THREE.PlaneGeometry(2, 2),
      new THREE.ShaderMaterial({
        uniforms: { map: { value: smooth.texture } },
        vertexShader: "varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }",
        fragmentShader: "uniform sampler2D map; varying vec2 at; void main() { gl_FragColor = texture2D(map, at); }",
        depthTest: false,
        depthWrite: false,
      }),
    );
    quad.frustumCulled = false;
    this.copy.add(quad);
  }
  /** `paint` draws the scene, or says that it cannot yet; `change` hears what is drawn from now on. */
  begin(change: (quality: Quality) => void, paint: () => boolean) {
    this.paint = paint;
    this.change = change;
    change(this.quality);
    const loop = () => {
      requestAnimationFrame(loop);
      const isSoon = this.held && performance.now() < this.drawnAt + kFilmEvery;
      if (this.dirty && this.drawing && !isSoon) this.draw();
    };
    loop();
  }
  setSize(w: number, h: number) {
    const { renderer, smooth, quality } = this;
    if (!this.held) {
      renderer.setPixelRatio(quality.ratio);
      renderer.setSize(w, h);
    }
    const size = renderer.getDrawingBufferSize(new THREE.Vector2());
    if (quality.antialiasing) smooth.setSize(size.x, size.y);
    else smooth.dispose();
  }
  render(scene: THREE.Scene, camera: THREE.Camera) {
    const { renderer } = this;
    if (!this.quality.antialiasing) return renderer.render(scene, camera);
    renderer.setRenderTarget(this.smooth);
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    renderer.render(this.copy, this.lens);
  }
  draw() {
    const last = this.took[this.took.length - 1] ?? Infinity,
      measures = ++this.unmeasured >= (last < kQuick ? kEveryIfQuick : kEvery);
    if (measures) this.finish(); // what was begun before
    const begun = performance.now();
    if (!this.paint()) return;
    this.dirty = false;
    this.drawnAt = begun;
    if (!measures) return;
    this.finish();
    this.unmeasured = 0;
    const now = performance.now();
    if (this.took.push(now - begun) > kKeptTimes) this.took.shift();
    if (this.quality.took(now - begun, now)) this.requality();
  }
  /** Waits until all of it is drawn. No other way says so on every browser: fences come seconds late. */
  finish() {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, this.pixel);
  }
  private requality() {
    localStorage.setItem(kKept, String(this.quality.measures ? this.quality.level : -1));
    this.change(this.quality);
    this.dirty = true;
    for (const hear of this.onQuality) hear();
  }
  /** All of it, whatever it takes; or as it is measured. */
  setMeasures(on: boolean) {
    this.quality.setMeasures(on, performance.now());
    this.requality();
  }
  /** The size stays until false. */
  hold(on: boolean) {
    this.held = on;
    this.change(this.quality);
  }
}
