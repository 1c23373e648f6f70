// SPDX-License-Identifier: MIT
// The shapes of docs/connecting.md: what events and answers hold, and frames.

export type Vec = number[];
export interface Thing {
  id: number;
  kind: string;
  name?: string;
  position: Vec;
  heading?: number;
  size?: Vec;
  radius?: number;
  points?: Vec[];
  closed?: boolean;
  thickness?: number;
  height?: number;
  z?: number;
  colour: Vec;
  corners?: Vec[];
  movable?: boolean;
  body?: number;
  low?: number;
  high?: number;
  intensity?: number;
  attenuation?: Vec;
  on?: boolean;
  level?: number;
}
export interface Robot {
  id: number;
  kind: "robot";
  name: string;
  firmware: string;
  body: number;
  position: Vec;
  heading: number;
  colour: Vec;
  radius: number;
  z0: number;
  height: number;
  wheel_radius: number;
  axle: number;
  leds: Vec[];
  sensors: Vec[];
  parts: string[];
}
/** What a compiler says: `file` is one of the program's files where it is one of them, line 0: of no line. */
export interface Finding {
  kind: "error" | "warning" | "note";
  file: string;
  line: number;
  column: number;
  text: string;
}
export interface Problem {
  line: number;
  column: number;
  text: string;
  id: number;
}
export interface Element {
  id: number;
  path: string;
  line: number;
  /** 1-based and inclusive. */
  last_line?: number;
  name?: string;
  values: Record<string, string>;
}
export interface World {
  title: string;
  file: string;
  text: string;
  /** Of the text, as the server names it. */
  base?: string;
  undo_depth?: number;
  step_s: number;
  tick_s: number;
  arena?: { id: number; size: Vec; centre: Vec; wall_height: number; wall_thickness: number; colour: Vec };
  floor: { colour: Vec; image: string };
  things: Thing[];
  robots: Robot[];
  elements: Element[];
  problems: Problem[];
}
export interface Program {
  name: string;
  robots: string[];
  folder: string;
  files: string[];
  /** Did its last build do? Only where there was one. */
  ok?: boolean;
  built?: boolean;
  findings?: Finding[];
}
export interface State {
  playing: boolean;
  speed: number;
  ended: boolean;
  time_s: number;
  seed: number;
  saved: boolean;
  undo: boolean;
  redo: boolean;
  steering: number;
  runs: boolean;
  recording?: null | { file: string; error: string };
  /** The robot that is debugged; empty: none. */
  debugging?: string;
  outcome?: { code: number; text: string };
}
export interface KeySpec {
  key: string;
  type: string;
  unit: string;
  default: string;
  doc: string;
  choices?: string;
  range?: Vec;
}
export type Schema = Record<
  string,
  { many: boolean; doc: string; keys: KeySpec[]; kinds?: { kind: string; doc: string }[] }
>;
export interface Look {
  robot: string;
  time_s: number;
  way?: string;
  place?: { function: string; file: string; line: number };
  parts: { kind: string; shows: string }[];
  camera?: { at: Vec; edges: Vec; pictures: number };
  picture?: { number: number; columns: number; rows: number; bytes_per_pixel: number; rgb: string };
}

/** A frame, looked at in place: nothing is copied. */
export interface Frame {
  revision: number;
  time: number;
  pace: number;
  running: boolean;
  robots: number;
  bodies: number;
  subscription: number;
  values: Float64Array;
  poses: Float32Array;
  robotWords: Uint32Array;
  rays: Float32Array;
}
export const RobotState = { NoProgram: 1, Stopped: 2, Waiting: 4, Sounding: 8 };

const kHead = 48;

export function readFrame(bytes: ArrayBuffer): Frame {
  const head = new DataView(bytes);
  const u = (at: number) => head.getUint32(at, true);
  const robots = u(28),
    bodies = u(32),
    values = u(36),
    rays = u(40);
  const poses = kHead + 8 * values,
    words = poses + 16 * bodies,
    rayBytes = words + 8 * robots;
  return {
    revision: u(4),
    time: head.getFloat64(8, true),
    pace: head.getFloat64(16, true),
    running: (u(24) & 1) !== 0,
    robots,
    bodies,
    subscription: u(44),
    values: new Float64Array(bytes, kHead, values),
    poses: new Float32Array(bytes, poses, 4 * bodies),
    robotWords: new Uint32Array(bytes, words, 2 * robots),
    rays: new Float32Array(bytes, rayBytes, 7 * rays),
  };
}

/** A value as the world file writes it, read; undefined where it is nothing simple. */
export function readLiteral(literal: string): any {
  const plain = literal
    .replace(/#.*$/gm, "")
    .replace(/,(\s*\])/g, "$1")
    .replace(/(^|[[,\s])\+/g, "$1")
    .replace(/^'(.*)'$/s, (_, t) => JSON.stringify(t))
    .replace(/(\d)_(\d)/g, "$1$2");
  try {
    return JSON.parse(plain);
  } catch {
    return undefined;
  }
}
