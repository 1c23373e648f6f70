// SPDX-License-Identifier: MIT
// How far and in which direction: between two points on the floor, or between the two pieces that are selected.
import * as THREE from "three";
import { byId, h } from "../dom";
import type { Store } from "../store/store";
import type { Scene } from "./scene";

interface Point {
  x: number;
  y: number;
}
const kCatch = 10; // px, around the middle of a piece
const kHigh = 0.004; // m
const kColour = 0xc2185b;

/** Distance in m, direction in degrees from the x axis against the clock, -180 to 180. */
export function measured(a: Point, b: Point) {
  const dx = b.x - a.x,
    dy = b.y - a.y;
  return { distance: Math.hypot(dx, dy), angle: (Math.atan2(dy, dx) * 180) / Math.PI, dx, dy };
}
export function textOf(a: Point, b: Point) {
  const { distance, angle, dx, dy } = measured(a, b),
    signed = (v: number) => `${v < 0 ? "−" : ""}${Math.abs(v).toFixed(3)}`;
  return `${distance.toFixed(3)}\u202fm  ${angle < -0.05 ? "−" : ""}${Math.abs(angle).toFixed(1)}°  (x ${signed(dx)}\u202fm, y ${signed(dy)}\u202fm)`;
}

export class Ruler {
  private on = false;
  private from?: Point;
  private to?: Point;
  private fixed = false; // both ends are
  private said = h("output", { id: "ruler", hidden: true, "aria-label": "Ruler" });
  private line = new THREE.Line(
    new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({ color: kColour, depthTest: false }),
  );
  private ends = [0, 1].map(
    () =>
      new THREE.Mesh(
        new THREE.RingGeometry(0.008, 0.011, 24),
        new THREE.MeshBasicMaterial({ color: kColour, depthTest: false, side: THREE.DoubleSide }),
      ),
  );
  /** Hears that it is on or off. */
  readonly onChange: (() => void)[] = [];

  constructor(
    private store: Store,
    private scene: Scene,
  ) {
    const stage = byId("stage");
    stage.append(this.said);
    scene.extras.add(this.line, ...this.ends);
    for (const o of [this.line, ...this.ends]) {
      o.visible = false;
      o.renderOrder = 7;
      o.frustumCulled = false;
    }
    // before the tools' hand, while it is on
    stage.addEventListener("pointerdown", (e) => this.down(e), { capture: true });
    stage.addEventListener("pointermove", (e) => this.moved(e), { capture: true });
    scene.afterDrawing.push(() => this.placeText());
    store.on("world", () => this.show());
  }
  get isOn() {
    return this.on;
  }
  get text() {
    return this.said.textContent ?? "";
  }
  toggle() {
    this.on = !this.on;
    this.from = this.to = undefined;
    this.fixed = false;
    const two = this.store.selection.map((id) => this.store.piece(id)).filter((p) => !!p);
    if (this.on && two.length === 2) {
      // by keys alone: select two pieces, press the ruler's
      [this.from, this.to] = two.map((p) => this.placeOf(p!));
      this.fixed = true;
    }
    this.show();
    for (const hear of this.onChange) hear();
  }
  private placeOf(piece: { body?: number; position: number[] }): Point {
    const { frame } = this.store,
      body = piece.body ?? -1;
    return frame && body >= 0 && body < frame.bodies
      ? { x: frame.poses[4 * body], y: frame.poses[4 * body + 1] }
      : { x: piece.position[0], y: piece.position[1] };
  }
  /** On the floor below the pointer; near the middle of a piece: there. */
  private pointAt(e: PointerEvent): Point | undefined {
    const { scene, store } = this;
    let best: Point | undefined,
      least = kCatch;
    for (const piece of [...store.world.robots, ...store.world.things]) {
      const p = this.placeOf(piece),
        on = scene.project(p.x, p.y, 0),
        away = Math.hypot(on.x - e.clientX, on.y - e.clientY);
      if (away < least) [least, best] = [away, p];
    }
    const floor = scene.floorPoint(e);
    return best ?? (floor ? { x: floor.x, y: floor.y } : undefined);
  }
  private down(e: PointerEvent) {
    if (!this.on || e.button !== 0 || e.target !== this.scene.renderer.domElement) return;
    const at = this.pointAt(e);
    if (!at) return;
    e.stopPropagation();
    e.preventDefault();
    if (this.from && !this.fixed) {
      this.to = at;
      this.fixed = true;
    } else {
      this.from = this.to = at;
      this.fixed = false;
    }
    this.show();
  }
  private moved(e: PointerEvent) {
    if (!this.on || !this.from || this.fixed || e.target !== this.scene.renderer.domElement) return;
    this.to = this.pointAt(e);
    this.show();
  }
  private show() {
    const { from, to, line, ends } = this,
      shown = this.on && !!from && !!to;
    for (const o of [line, ...ends]) o.visible = shown;
    this.said.hidden = !this.on;
    if (this.on && !shown) this.said.textContent = "Ruler: click on two places";
    if (shown) {
      line.geometry.setFromPoints([from, to].map((p) => new THREE.Vector3(p!.x, p!.y, kHigh)));
      [from, to].forEach((p, i) => ends[i].position.set(p!.x, p!.y, kHigh));
      this.said.textContent = textOf(from!, to!);
    }
    this.scene.draw();
    this.placeText();
  }
  private placeText() {
    if (!this.on) return;
    const { from, to, said } = this;
    if (!from || !to) {
      said.style.transform = "";
      said.classList.remove("at");
      return;
    }
    const box = byId("stage").getBoundingClientRect(),
      on = [from, to].map((q) => this.scene.project(q.x, q.y, kHigh)),
      p = on[0].y < on[1].y ? on[0] : on[1]; // above the upper end
    said.classList.add("at");
    const x = Math.min(Math.max(p.x - box.left, 90), box.width - 90),
      y = Math.min(Math.max(p.y - box.top, 24), box.height - 24);
    said.style.transform = `translate(-50%, -140%) translate(${x}px, ${y}px)`;
  }
}
