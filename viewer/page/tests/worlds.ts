// SPDX-License-Identifier: MIT
import type { Robot, Thing, World } from "../src/link/protocol";

export const world = (more: Partial<World> = {}): World => ({
  title: "",
  file: "/w/world.toml",
  text: "",
  step_s: 0.032,
  tick_s: 1 / 512,
  floor: { colour: [1, 1, 1], image: "" },
  things: [],
  robots: [],
  elements: [],
  problems: [],
  ...more,
});
export const thing = (id: number, more: Partial<Thing> = {}): Thing => ({
  id,
  kind: "box",
  position: [0, 0],
  colour: [1, 1, 1],
  ...more,
});
export const robot = (id: number, more: Partial<Robot> = {}): Robot => ({
  id,
  kind: "robot",
  name: "puck",
  firmware: "drive",
  body: 0,
  position: [0, 0],
  heading: 0,
  colour: [1, 1, 1],
  radius: 0.037,
  z0: 0,
  height: 0.05,
  wheel_radius: 0.02,
  axle: 0.053,
  leds: [],
  sensors: [],
  parts: [],
  ...more,
});
