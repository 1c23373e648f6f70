// SPDX-License-Identifier: MIT
// Where robots went: pieces of line of all of them in one buffer, drawn at once. The oldest go first when it is full.
import * as THREE from "three";
import type { Robot } from "../link/protocol";
import { wayBetween } from "./track";
import type { Border, Seen } from "./track";

const kOfEach = 4000; // pieces, of a robot
const kMost = 160000; // pieces, of all
const kNear = 0.002; // m: what is nearer to the last point is none
const kNearOfMany = 0.006;
const kMany = 100; // robots
const kDash = 0.004; // m, where nothing is known of before and after
const kHigh = 0.002; // m, above the floor

export class Paths {
  readonly lines = new THREE.LineSegments(
    new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({ vertexColors: true }),
  );
  borders: readonly Border[] = [];
  private most = 0;
  private points = new Float32Array();
  private colours = new Float32Array();
  private owners = new Uint16Array();
  private next = 0;
  private size = 0;
  private fresh = 0; // pieces that the drawing has not got yet
  private seen: (Seen | undefined)[] = [];
  private drawn: ({ x: number; y: number } | undefined)[] = [];
  private counts: number[] = [];
  private colour: THREE.Color[] = [];

  constructor() {
    this.lines.frustumCulled = false;
    this.lines.raycast = () => {};
    this.lines.position.z = kHigh;
  }
  /** By body. Other robots than before: paths begin anew. */
  setRobots(robots: (Robot | undefined)[]) {
    this.colour = robots.map((r) =>
      new THREE.Color().setRGB(...((r?.colour ?? [0, 0, 0]) as [number, number, number]), THREE.SRGBColorSpace),
    );
    if (robots.length !== this.counts.length || this.most === 0) this.make(robots.length);
    for (let i = 0; i < this.size; ++i) this.paint(i, this.owners[i]);
    this.fresh = this.size;
  }
  private make(robots: number) {
    this.most = Math.max(1, Math.min(kMost, kOfEach * robots));
    this.points = new Float32Array(4 * this.most);
    this.colours = new Float32Array(6 * this.most);
    this.owners = new Uint16Array(this.most);
    this.lines.geometry.dispose();
    this.lines.geometry = new THREE.BufferGeometry()
      .setAttribute("position", new THREE.BufferAttribute(this.points, 2).setUsage(THREE.DynamicDrawUsage))
      .setAttribute("color", new THREE.BufferAttribute(this.colours, 3).setUsage(THREE.DynamicDrawUsage));
    this.lines.geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), Infinity); // two coordinates have none
    this.counts = new Array(robots).fill(0);
    this.clear();
  }
  clear() {
    this.next = this.size = this.fresh = 0;
    this.counts.fill(0);
    this.seen = this.counts.map(() => undefined);
    this.drawn = this.counts.map(() => undefined);
    this.lines.geometry.setDrawRange(0, 0);
  }
  /** How many pieces a robot's path has, and its colour. */
  of(body: number) {
    return { count: this.counts[body] ?? 0, colour: this.colour[body] };
  }
  /** The ends of a robot's pieces, oldest first: x, y, x, y. For tests. */
  pieces(body: number): number[][] {
    const out: number[][] = [];
    for (let k = 0; k < this.size; ++k) {
      const i = (this.next - this.size + k + this.most) % this.most;
      if (this.owners[i] === body) out.push([...this.points.subarray(4 * i, 4 * i + 4)]);
    }
    return out;
  }

  add(body: number, x: number, y: number, heading: number, time: number, travelled?: number) {
    if (body >= this.counts.length) return;
    const before = this.seen[body],
      now: Seen = { x, y, heading, time, travelled };
    this.seen[body] = now;
    let last = this.drawn[body];
    if (!before || !last) {
      this.drawn[body] = { x, y };
      return;
    }
    const near = this.counts.length > kMany ? kNearOfMany : kNear;
    if (before.x === x && before.y === y) return;
    const way = wayBetween(before, now, this.borders);
    if (!way) {
      this.put(body, last.x, last.y, before.x, before.y);
      this.dash(body, now);
      this.drawn[body] = { x, y };
      return;
    }
    for (const [px, py] of way) {
      if (Math.hypot(px - last.x, py - last.y) < near) continue;
      this.put(body, last.x, last.y, px, py);
      this.drawn[body] = last = { x: px, y: py };
    }
  }
  private dash(body: number, { x, y, heading }: Seen) {
    const dx = (kDash / 2) * Math.cos(heading),
      dy = (kDash / 2) * Math.sin(heading);
    this.put(body, x - dx, y - dy, x + dx, y + dy);
  }
  private put(body: number, x0: number, y0: number, x1: number, y1: number) {
    if (x0 === x1 && y0 === y1) return;
    const i = this.next;
    if (this.size === this.most) --this.counts[this.owners[i]];
    else ++this.size;
    this.points[4 * i] = x0;
    this.points[4 * i + 1] = y0;
    this.points[4 * i + 2] = x1;
    this.points[4 * i + 3] = y1;
    this.owners[i] = body;
    this.paint(i, body);
    ++this.counts[body];
    this.next = (i + 1) % this.most;
    if (this.fresh < this.most) ++this.fresh;
  }
  private paint(i: number, body: number) {
    const c = this.colour[body],
      { colours } = this;
    if (!c) return;
    colours[6 * i] = colours[6 * i + 3] = c.r;
    colours[6 * i + 1] = colours[6 * i + 4] = c.g;
    colours[6 * i + 2] = colours[6 * i + 5] = c.b;
  }
  /** Before it is drawn: only what is new goes to the graphics. */
  flush() {
    if (!this.fresh) return;
    const { geometry } = this.lines,
      first = this.next - this.fresh;
    for (const [name, each] of [
      ["position", 4],
      ["color", 6],
    ] as const) {
      const attribute = geometry.getAttribute(name) as THREE.BufferAttribute;
      if (first >= 0) attribute.addUpdateRange(each * first, each * this.fresh);
      else {
        attribute.addUpdateRange(0, each * this.next);
        attribute.addUpdateRange(each * (first + this.most), -each * first);
      }
      attribute.needsUpdate = true;
    }
    geometry.setDrawRange(0, 2 * this.size);
    this.fresh = 0;
  }
}
