// SPDX-License-Identifier: MIT
// The canvas of the scene: it draws when something has changed and the frame before is done, says how long a frame
// took, and leaves out what takes too long.
import * as THREE from "three";
import { Quality } from "./quality";

const kSamples = 4; // a pixel, of antialiasing
const kPoll = 4; // ms, between two looks whether a frame is done
const kLate = 25; // ms: a look that comes later says nothing of the drawing, for the script was busy
const kKept = "drawing"; // of localStorage: how much was left out

export class Canvas {
  // antialiasing comes and goes, which a canvas's own cannot
  readonly renderer = new THREE.WebGLRenderer({ antialias: false });
  readonly quality: Quality;
  dirty = true;
  drawing = true;
  /** A film holds what is left out, and the size. */
  private held = false;
  private paint: () => boolean = () => false;
  private change: (quality: Quality) => void = () => {};
  private readonly smooth = new THREE.WebGLRenderTarget(1, 1, { samples: kSamples });
  private readonly copy = new THREE.Scene();
  private readonly lens = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);
  private fence?: { sync: WebGLSync; begun: number; looked: number };
  /** ms, of the last frames; for people who ask why. */
  readonly took: number[] = [];
  /** Hears that other things are left out. */
  readonly onQuality: (() => void)[] = [];

  constructor() {
    const kept = Number(localStorage.getItem(kKept) ?? 0);
    this.quality = new Quality(kept > 0 ? kept : 0, kept >= 0);
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
      this.look();
      if (this.dirty && this.drawing && !this.fence) this.draw();
    };
    loop();
  }
  setSize(w: number, h: number) {
    const { renderer, smooth, quality } = this;
    renderer.setPixelRatio(quality.ratio(window.devicePixelRatio));
    renderer.setSize(w, h);
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
    const gl = this.renderer.getContext() as WebGL2RenderingContext,
      begun = performance.now();
    if (!this.paint()) return;
    this.dirty = false;
    if (this.fence) gl.deleteSync(this.fence.sync);
    const sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    this.fence = sync ? { sync, begun, looked: performance.now() } : undefined;
    if (sync) this.lookSoon();
  }
  private lookSoon() {
    setTimeout(() => {
      this.look();
      if (this.fence) this.lookSoon();
    }, kPoll);
  }
  private look() {
    const { fence } = this;
    if (!fence) return;
    const gl = this.renderer.getContext() as WebGL2RenderingContext,
      now = performance.now();
    const done = gl.isContextLost() || gl.getSyncParameter(fence.sync, gl.SYNC_STATUS) === gl.SIGNALED;
    const until = now - fence.looked > kLate ? fence.looked : now;
    fence.looked = now;
    if (!done) return;
    gl.deleteSync(fence.sync);
    this.fence = undefined;
    const ms = until - fence.begun;
    if (this.took.push(ms) > 100) this.took.shift();
    if (!this.held && this.quality.took(ms, now)) this.requality();
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
  /** The size and what is left out stay until false. */
  hold(on: boolean) {
    this.held = on;
  }
}
