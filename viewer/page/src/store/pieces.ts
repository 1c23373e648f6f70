// SPDX-License-Identifier: MIT
// What is done to pieces of the world: put, turned, copied, removed. An edit of the world file; or, of a robot or a
// loose thing in a run that has begun, a move where it is, and the file stays.
import type { Robot, Thing, Vec } from "../link/protocol";
import type { Client } from "./client";
import type { Store } from "./store";

export type Piece = Robot | Thing;

export class Pieces {
  /** Edits with the same number are undone together: a drag has one. */
  group = 1;

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
  placeOf(piece: Piece): Vec {
    const f = this.store.frame;
    if (piece.body !== undefined && piece.body >= 0 && f && piece.body < f.bodies)
      return [f.poses[4 * piece.body], f.poses[4 * piece.body + 1]];
    return "points" in piece && piece.points ? piece.points[0] : piece.position;
  }
  place(piece: Piece, position: Vec, heading?: number, from?: { x: number; y: number }) {
    const { store, client } = this;
    if (piece.body !== undefined && piece.body >= 0 && this.begun) {
      const f = store.frame!;
      const now = f.poses[4 * piece.body + 3];
      const turn = heading === undefined ? now : now + heading - (piece.heading ?? 0);
      const at = heading === undefined ? position : this.placeOf(piece);
      client.do("move", { body: piece.body, x: at[0], y: at[1], heading: turn });
      return;
    }
    if ("points" in piece && piece.points && from) {
      const dx = position[0] - piece.points[0][0],
        dy = position[1] - piece.points[0][1];
      client.set(piece.id, { points: piece.points.map((p) => [p[0] + dx, p[1] + dy]) }, this.group);
      return;
    }
    const values: Record<string, unknown> = { position: [...position.slice(0, 2), ...piece.position.slice(2)] };
    if (heading !== undefined) values.heading = Math.round((heading * 180 * 1000) / Math.PI) / 1000;
    client.set(piece.id, values, this.group);
  }
  nudge(x: number, y: number, by: number) {
    const piece = this.selected();
    if (!piece) return;
    ++this.group;
    const at = this.placeOf(piece);
    this.place(piece, [at[0] + x * by, at[1] + y * by], undefined, { x: 0, y: 0 });
  }
  turn(degrees: number) {
    const piece = this.selected();
    if (!piece || piece.heading === undefined) return;
    this.place(piece, piece.position, piece.heading + (degrees * Math.PI) / 180);
  }
  copy() {
    const piece = this.selected();
    if (!piece) return;
    const values: Record<string, unknown> = {};
    if ("points" in piece && piece.points) values.points = piece.points.map((p) => [p[0] + 0.05, p[1] - 0.05]);
    else values.position = [piece.position[0] + 0.1, piece.position[1] - 0.1, ...piece.position.slice(2)];
    if (piece.kind === "robot") values.name = this.freeName(piece.name!);
    else if (piece.name) values.name = this.freeName(piece.name);
    this.client.edit({ op: "copy", thing: piece.id, values }).then((a) => {
      if (a?.thing) this.store.select(a.thing);
    });
  }
  remove() {
    if (this.store.selected) this.client.edit({ op: "remove", thing: this.store.selected });
  }
  freeName(like: string) {
    const { robots, things } = this.store.world;
    const stem = like.replace(/[ _]?\d+$/, "") || "thing",
      gap = /\s\d+$/.test(like) ? " " : "";
    for (let i = 2; ; ++i)
      if (![...robots, ...things].some((o) => o.name === `${stem}${gap}${i}`)) return `${stem}${gap}${i}`;
  }
}
