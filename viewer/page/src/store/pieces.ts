// SPDX-License-Identifier: MIT
// What is done to the selected pieces of the world: moved, turned, painted, copied, removed. An edit of the world file;
// or, of robots and loose things in a run that has begun, a move where they are, and the file stays.
import type { Answer } from "../link/connection";
import type { Robot, Thing, Vec } from "../link/protocol";
import type { Client } from "./client";
import type { Store } from "./store";

export type Piece = Robot | Thing;
type Edit = Record<string, unknown>;

const kCopyBy = [0.1, -0.1]; // m
const kCopyPointsBy = [0.05, -0.05];
const kRounded = 1e5; // 10 um

const round = (v: number) => Math.round(v * kRounded) / kRounded;
const degrees = (radians: number) => Math.round((radians * 180 * 1000) / Math.PI) / 1000;
const pointsOf = (piece: Piece) => ("points" in piece && piece.points ? piece.points : undefined);

export class Pieces {
  /** Edits with the same number are undone together: a drag has one. */
  group = 1;
  private pasted = 0; // times, so that copies do not lie on each other
  private clip = "";

  constructor(
    private store: Store,
    private client: Client,
  ) {}

  /** Has the run begun, so that loose things are where they are and not where they start? */
  get begun() {
    return (this.store.frame?.time ?? 0) > 0;
  }
  selected(): Piece | undefined {
    return this.store.piece(this.store.selected);
  }
  all(): Piece[] {
    return this.store.selection.flatMap((id) => this.store.piece(id) ?? []);
  }
  /** Is it moved where it is, instead of in the file? */
  private runs(piece: Piece) {
    return piece.body !== undefined && piece.body >= 0 && this.begun;
  }
  placeOf(piece: Piece): Vec {
    const f = this.store.frame;
    if (piece.body !== undefined && piece.body >= 0 && f && piece.body < f.bodies)
      return [f.poses[4 * piece.body], f.poses[4 * piece.body + 1]];
    return pointsOf(piece)?.[0] ?? piece.position;
  }

  /** Has its kind a key of that name in world files? A sound has no colour, and a lamp no heading. */
  private has(piece: Piece, key: string) {
    return !!this.store.schema[piece.kind]?.keys.some((k) => k.key === key);
  }
  canPaint(piece: Piece) {
    return this.has(piece, "colour");
  }
  canTurn(piece: Piece) {
    return this.has(piece, "heading") || this.has(piece, "points");
  }

  // --- edits

  /** Many edits as one: parsed once, undone together. */
  private async edits(edits: Edit[], group = 0): Promise<Answer | undefined> {
    if (edits.length === 0) return undefined;
    if (edits.length === 1) return this.client.edit({ ...edits[0], group });
    return this.client.edit({ edits, group });
  }
  private move(piece: Piece, at: Vec, heading?: number) {
    const now = this.store.frame!.poses[4 * piece.body! + 3];
    this.client.do("move", { body: piece.body, x: at[0], y: at[1], heading: heading ?? now });
  }
  /** Puts pieces where they are said to be; a wall's place is its first point. */
  put(places: { piece: Piece; at: Vec }[]) {
    const edits: Edit[] = [];
    for (const { piece, at } of places) {
      const points = pointsOf(piece);
      if (this.runs(piece)) this.move(piece, at);
      else if (points) {
        const dx = at[0] - points[0][0],
          dy = at[1] - points[0][1];
        edits.push({
          op: "set",
          thing: piece.id,
          values: { points: points.map((p) => [round(p[0] + dx), round(p[1] + dy)]) },
        });
      } else
        edits.push({
          op: "set",
          thing: piece.id,
          values: { position: [...at.slice(0, 2), ...piece.position.slice(2)] },
        });
    }
    return this.edits(edits, this.group);
  }
  /** Turns one piece to that heading, rad. */
  head(piece: Piece, heading: number) {
    if (this.runs(piece)) {
      const now = this.store.frame!.poses[4 * piece.body! + 3];
      return this.move(piece, this.placeOf(piece), now + heading - (piece.heading ?? 0));
    }
    const { position } = piece;
    this.client.set(piece.id, { position, heading: degrees(heading) }, this.group);
  }
  nudge(x: number, y: number, by: number) {
    ++this.group;
    this.put(
      this.all().map((piece) => {
        const at = this.placeOf(piece);
        return { piece, at: [round(at[0] + x * by), round(at[1] + y * by)] };
      }),
    );
  }
  /** One piece about itself; several about their middle. */
  turn(by: number) {
    const all = this.all(),
      angle = (by * Math.PI) / 180;
    ++this.group;
    if (all.length === 1) {
      const [piece] = all;
      if (!this.canTurn(piece)) return;
      if (piece.heading !== undefined) this.head(piece, piece.heading + angle);
      else if (pointsOf(piece)) this.edits([this.turned(piece, this.middle([piece]), angle)], this.group);
      return;
    }
    const middle = this.middle(all),
      edits: Edit[] = [];
    for (const piece of all) {
      if (this.runs(piece)) {
        const at = this.around(this.placeOf(piece), middle, angle);
        this.move(piece, at, this.store.frame!.poses[4 * piece.body! + 3] + angle);
      } else edits.push(this.turned(piece, middle, angle));
    }
    this.edits(edits, this.group);
  }
  private middle(pieces: Piece[]): Vec {
    const places = pieces.flatMap((p) => pointsOf(p) ?? [this.placeOf(p)]);
    return [0, 1].map((k) => places.reduce((sum, p) => sum + p[k], 0) / Math.max(1, places.length));
  }
  private around(at: Vec, middle: Vec, angle: number): Vec {
    const dx = at[0] - middle[0],
      dy = at[1] - middle[1],
      c = Math.cos(angle),
      s = Math.sin(angle);
    return [round(middle[0] + c * dx - s * dy), round(middle[1] + s * dx + c * dy), ...at.slice(2)];
  }
  private turned(piece: Piece, middle: Vec, angle: number): Edit {
    const points = pointsOf(piece);
    if (points)
      return { op: "set", thing: piece.id, values: { points: points.map((p) => this.around(p, middle, angle)) } };
    const values: Record<string, unknown> = { position: this.around(piece.position, middle, angle) };
    if (piece.heading !== undefined && this.canTurn(piece)) values.heading = degrees(piece.heading + angle);
    return { op: "set", thing: piece.id, values };
  }
  paint(colour: Vec) {
    this.edits(
      this.all()
        .filter((p) => this.canPaint(p))
        .map((p) => ({ op: "set", thing: p.id, values: { colour } })),
      ++this.group,
    );
  }
  remove() {
    this.edits(
      this.all().map((p) => ({ op: "remove", thing: p.id })),
      ++this.group,
    );
  }

  // --- copies

  async copy() {
    const taken = new Set<string>();
    const edits = this.all().map((piece) => {
      const values: Record<string, unknown> = {},
        points = pointsOf(piece);
      if (points) values.points = points.map((p) => [round(p[0] + kCopyPointsBy[0]), round(p[1] + kCopyPointsBy[1])]);
      else
        values.position = [piece.position[0] + kCopyBy[0], piece.position[1] + kCopyBy[1], ...piece.position.slice(2)];
      if (piece.kind === "robot" || piece.name) values.name = this.freeName(piece.name!, taken);
      return { op: "copy", thing: piece.id, values };
    });
    const answer = await this.edits(edits, ++this.group);
    const fresh: number[] = answer?.things ?? (answer?.thing ? [answer.thing] : []);
    if (fresh.length) this.store.selectAll(fresh.filter((id) => id));
  }
  freeName(like: string, taken = new Set<string>()) {
    const { robots, things } = this.store.world;
    for (const o of [...robots, ...things]) if (o.name) taken.add(o.name);
    const stem = like.replace(/[ _]?\d+$/, "") || "thing",
      gap = /\s\d+$/.test(like) ? " " : "";
    for (let i = 2; ; ++i) {
      const name = `${stem}${gap}${i}`;
      if (taken.has(name)) continue;
      taken.add(name);
      return name;
    }
  }
  /** The selected pieces' text, also for other pages and editors. */
  async toClipboard(): Promise<string | undefined> {
    const things = this.all().map((p) => p.id);
    if (!things.length) return undefined;
    const answer = await this.client.do("text_of", { things });
    if (!answer) return undefined;
    this.clip = answer.text;
    this.pasted = 0;
    return this.clip;
  }
  async paste(text: string) {
    if (!/^\s*\[\[/m.test(text)) return;
    if (text !== this.clip) this.pasted = 0;
    this.clip = text;
    ++this.pasted;
    const answer = await this.client.edit({
      op: "paste",
      text,
      dx: round(this.pasted * kCopyBy[0]),
      dy: round(this.pasted * kCopyBy[1]),
    });
    const fresh: number[] = answer?.things ?? [];
    if (fresh.length) this.store.selectAll(fresh.filter((id) => id));
  }
}
