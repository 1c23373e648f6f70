// SPDX-License-Identifier: MIT
// Colours of robots, their paths and plotted lines. Okabe and Ito's, told apart by the colour-blind, too; on light
// ground darker ones, each with a contrast of 4.5 to white and to the floor, on dark ground brighter ones.
import type { Robot, Vec, World } from "../link/protocol";

export const kPalette = ["#0069a6", "#965800", "#00734f", "#b34700", "#a03a7f", "#1f6e8d", "#6b6400", "#5f6670"];
const kOnDark = ["#56b4e9", "#e69f00", "#2fbf92", "#ff8a4c", "#e08fc0", "#7fd0d8", "#f0e442", "#a8b0ba"];

/** Of the line with that number. */
export const lineColour = (i: number, dark: boolean) => (dark ? kOnDark : kPalette)[i % kPalette.length];

const vec = (hex: string): Vec => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
/** A robot has the colour of its path: what the file says, or the next of ours. */
export function coloursOf(world: World): Map<number, Vec> {
  const written = new Set(world.elements.filter((e) => "colour" in e.values).map((e) => e.id));
  return new Map(
    world.robots.map((r: Robot, i) => [r.id, written.has(r.id) ? r.colour : vec(kPalette[i % kPalette.length])]),
  );
}
