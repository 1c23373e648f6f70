// SPDX-License-Identifier: MIT
// How a robot went from where one frame shows it to where the next does. At full speed there are seconds between two
// frames: the way is a curve that begins and ends in the robot's headings and is as long as it has travelled. Where no
// such curve is known, or it would go through a wall, there is none, and a path has a gap.
import type { Vec, World } from "../link/protocol";

export interface Seen {
  x: number;
  y: number;
  /** rad */
  heading: number;
  /** s */
  time: number;
  /** What its odometer says, m; undefined: nobody asked it. */
  travelled?: number;
}
/** From x, y to x, y: the middle line or the outline of what nobody drives through. */
export type Border = [number, number, number, number];

const kFastest = 0.3; // m/s: what is faster was carried; an e-puck drives 0.13, and a fall or a push adds to it
const kUsual = 0.13; // m/s, of an e-puck's wheels at 1000 steps/s
const kSlack = 0.005; // m, of the place itself
const kShort = 0.03; // m: less than a robot's radius, so that the chord goes through nothing
const kAbout = 0.07; // m, that a robot without an odometer may have gone on its way there
const kPiece = 0.01; // m, of a curve
const kMostPieces = 64;
const kRight = 0.04; // of the travelled way, that a curve may be longer or shorter
const kMostBent = 0.25; // rad, between the headings of a curve and those of an arc, where there is no odometer
const kOverhead = 0.06; // m: what is higher is driven under
const kCorners = 12;

const wrapped = (a: number) => Math.atan2(Math.sin(a), Math.cos(a));

function isCrossed(border: Border, ax: number, ay: number, bx: number, by: number) {
  const [x0, y0, x1, y1] = border;
  if (Math.max(ax, bx) < Math.min(x0, x1) || Math.min(ax, bx) > Math.max(x0, x1)) return false;
  if (Math.max(ay, by) < Math.min(y0, y1) || Math.min(ay, by) > Math.max(y0, y1)) return false;
  const side = (px: number, py: number, qx: number, qy: number, rx: number, ry: number) =>
    (qx - px) * (ry - py) - (qy - py) * (rx - px);
  return (
    side(x0, y0, x1, y1, ax, ay) * side(x0, y0, x1, y1, bx, by) <= 0 &&
    side(ax, ay, bx, by, x0, y0) * side(ax, ay, bx, by, x1, y1) <= 0
  );
}

/** Walls, the arena's border, and what stands on the floor and stays there. */
export function bordersOf(world: World): Border[] {
  const out: Border[] = [];
  const around = (points: Vec[], closed = true) =>
    points.forEach((p, i) => {
      const q = points[(i + 1) % points.length];
      if (closed || i + 1 < points.length) out.push([p[0], p[1], q[0], q[1]]);
    });
  const { arena } = world;
  if (arena && arena.wall_height > 0) {
    const [x, y] = arena.centre,
      [w, d] = [arena.size[0] / 2, arena.size[1] / 2];
    around([
      [x - w, y - d],
      [x + w, y - d],
      [x + w, y + d],
      [x - w, y + d],
    ]);
  }
  for (const t of world.things) {
    if (t.movable || (t.z ?? 0) > kOverhead) continue;
    const c = Math.cos(t.heading ?? 0),
      s = Math.sin(t.heading ?? 0),
      placed = (x: number, y: number) => [t.position[0] + c * x - s * y, t.position[1] + s * x + c * y];
    if (t.kind === "wall") around(t.points!, t.closed ?? false);
    else if (t.kind === "box") {
      const [w, d] = [t.size![0] / 2, t.size![1] / 2];
      around([placed(-w, -d), placed(w, -d), placed(w, d), placed(-w, d)]);
    } else if (t.kind === "cylinder" || t.kind === "ball")
      around(
        Array.from({ length: kCorners }, (_, i) =>
          placed(
            t.radius! * Math.cos((2 * Math.PI * i) / kCorners),
            t.radius! * Math.sin((2 * Math.PI * i) / kCorners),
          ),
        ),
      );
    else if (t.corners) around(t.corners.map((p) => placed(p[0], p[1])));
  }
  return out;
}

/** Points of the curve that leaves a in its heading and comes to b in its, b last. `reach`: m, how strongly. */
function curve(a: Seen, b: Seen, reach: number, length: number): Vec[] {
  const back = Math.cos(a.heading - Math.atan2(b.y - a.y, b.x - a.x)) < 0 ? -1 : 1;
  const at = [
    [a.x, a.y],
    [a.x + back * reach * Math.cos(a.heading), a.y + back * reach * Math.sin(a.heading)],
    [b.x - back * reach * Math.cos(b.heading), b.y - back * reach * Math.sin(b.heading)],
    [b.x, b.y],
  ];
  const pieces = Math.min(kMostPieces, Math.max(4, Math.ceil(length / kPiece)));
  return Array.from({ length: pieces }, (_, i) => {
    const t = (i + 1) / pieces,
      u = 1 - t,
      w = [u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t];
    return [0, 1].map((k) => w.reduce((sum, share, j) => sum + share * at[j][k], 0));
  });
}
function lengthOf(a: Seen, points: Vec[]) {
  let sum = 0,
    x = a.x,
    y = a.y;
  for (const p of points) {
    sum += Math.hypot(p[0] - x, p[1] - y);
    [x, y] = p;
  }
  return sum;
}

/** Points of the way, b last; undefined: nobody knows it. */
export function wayBetween(a: Seen, b: Seen, borders: readonly Border[]): Vec[] | undefined {
  const dt = b.time - a.time,
    chord = Math.hypot(b.x - a.x, b.y - a.y);
  if (dt < 0 || chord > kFastest * dt + kSlack) return undefined;
  const known =
    a.travelled !== undefined && b.travelled !== undefined && b.travelled >= a.travelled
      ? b.travelled - a.travelled
      : undefined;
  const straight = [[b.x, b.y]];
  if (chord <= kShort && (known === undefined ? kUsual * dt <= kAbout : known <= kShort)) return straight;
  if (chord < 1e-4) return undefined; // it has turned round and come back, or stood
  const toB = Math.atan2(b.y - a.y, b.x - a.x),
    back = Math.cos(a.heading - toB) < 0 ? Math.PI : 0,
    leaves = wrapped(a.heading + back - toB),
    comes = wrapped(b.heading + back - toB);
  let points: Vec[];
  if (known !== undefined) {
    points = curve(a, b, known / 3, known);
    if (Math.abs(lengthOf(a, points) - known) > kRight * known + kSlack) return undefined;
  } else {
    // an arc of a circle, driven at nearly full speed: nothing else fits between two frames
    const half = (comes - leaves) / 2,
      arc = Math.abs(half) < 1e-3 ? chord : (chord * half) / Math.sin(half);
    if (Math.abs(leaves + comes) > kMostBent || Math.abs(half) > Math.PI / 2) return undefined;
    if (arc < 0.6 * kUsual * dt) return undefined;
    points = curve(a, b, arc / 3, arc);
  }
  let [x, y] = [a.x, a.y];
  for (const [px, py] of points) {
    if (borders.some((border) => isCrossed(border, x, y, px, py))) return undefined;
    [x, y] = [px, py];
  }
  return points;
}
