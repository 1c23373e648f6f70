// SPDX-License-Identifier: MIT
// A world after an edit: what the server tells of it is what became other.
import type { World } from "../link/protocol";
import type { Element, Robot, Thing, WorldChanges } from "../link/protocol_types";

/** All of `order`: fresh ones, and the others as they were. */
function ordered<T extends { id: number }>(known: T[], fresh: T[], order: number[]): T[] {
  const byId = new Map([...known, ...fresh].map((piece) => [piece.id, piece]));
  return order.map((id) => ({ ...byId.get(id)! }));
}

export function changedWorld(world: World, changes: WorldChanges): World {
  const { head, text, things, robots, elements } = changes;
  const lines = world.text.split("\n");
  lines.splice(text.above, text.gone, ...text.lines);
  const pieces = ordered(world.elements as Element[], elements.fresh, elements.order);
  pieces.forEach((e, i) => Object.assign(e, { line: elements.lines[2 * i], last_line: elements.lines[2 * i + 1] }));
  return {
    ...head,
    text: lines.join("\n"),
    things: ordered(world.things as Thing[], things.fresh, things.order),
    robots: ordered(world.robots as Robot[], robots.fresh, robots.order),
    elements: pieces,
  } as World;
}
