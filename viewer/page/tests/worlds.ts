// SPDX-License-Identifier: MIT
import type { Element, Program, Robot, Thing, World } from "../src/link/protocol";

export const world = (more: Partial<World> = {}): World => ({
  title: "",
  file: "/w/world.toml",
  text: "",
  base: "",
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
export const element = (id: number, path: string, line: number, values: Record<string, string> = {}): Element => ({
  id,
  path,
  name: "",
  line,
  last_line: line,
  values,
});
/** Built, without findings. */
export const drive = (...files: string[]): Program => ({
  name: "drive",
  robots: ["puck"],
  folder: "/w/drive",
  files,
  built: true,
  ok: true,
  findings: [],
});
