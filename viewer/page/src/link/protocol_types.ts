// SPDX-License-Identifier: MIT
// The protocol's types, made from the tables in viewer/requests.cpp and shapes.cpp by build/twinpuck-dev page.

export interface State {
  playing: boolean;
  speed: number;
  ended: boolean;
  outcome?: { code: number; text: string };
  time_s: number;
  seed: number;
  saved: boolean;
  undo: boolean;
  redo: boolean;
  steering: number;
  debugging: string;
  runs: boolean;
  recording?: { file: string; error: string };
  digest?: string;
  clicks?: number;
}
export interface World {
  title: string;
  file: string;
  text: string;
  base: string;
  tick_s: number;
  step_s: number;
  arena?: { id: number; size: number[]; centre: number[]; wall_height: number; wall_thickness: number; colour: number[] };
  floor: { colour: number[]; image: string };
  things: Thing[];
  robots: Robot[];
  elements: Element[];
  problems: Problem[];
}
export interface Thing {
  id: number;
  kind: string;
  name?: string;
  position: number[];
  heading?: number;
  size?: number[];
  radius?: number;
  points?: number[][];
  closed?: boolean;
  thickness?: number;
  height?: number;
  z?: number;
  colour: number[];
  corners?: number[][];
  movable?: boolean;
  body?: number;
  low?: number;
  high?: number;
  intensity?: number;
  attenuation?: number[];
  on?: boolean;
  level?: number;
}
export interface Robot {
  id: number;
  kind: "robot";
  name: string;
  firmware: string;
  body: number;
  position: number[];
  heading: number;
  colour: number[];
  radius: number;
  z0: number;
  height: number;
  wheel_radius: number;
  axle: number;
  leds: number[][];
  sensors: number[][];
  parts: string[];
}
export interface Element {
  id: number;
  path: string;
  name: string;
  line: number;
  last_line: number;
  values: Record<string, string>;
}
export interface WorldChanges {
  head: Omit<World, "text" | "things" | "robots" | "elements">;
  text: { above: number; gone: number; lines: string[] };
  things: { fresh: Thing[]; order: number[] };
  robots: { fresh: Robot[]; order: number[] };
  elements: { fresh: Element[]; order: number[]; lines: number[] };
}
export interface Problem {
  line: number;
  column: number;
  text: string;
  id: number;
}
export interface Program {
  name: string;
  robots: string[];
  folder: string;
  files: string[];
  built: boolean;
  ok: boolean;
  findings: Finding[];
}
export interface Finding {
  kind: "error" | "warning" | "note";
  file: string;
  line: number;
  column: number;
  text: string;
}
export interface Diagnosis {
  robot: string;
  time_s: number;
  cause: string;
  place: string;
  text: string;
  hint: string;
}
export interface Trap {
  robot: string;
  kind: string;
  text: string;
  place: string;
  file: string;
  line: number;
  time_s: number;
}
export interface Place {
  function: string;
  file: string;
  line: number;
}
export interface PartLook {
  kind: string;
  shows: string;
}
export interface Camera {
  at: number[];
  edges: number[];
  pictures: number;
}
export interface Picture {
  number: number;
  columns: number;
  rows: number;
  bytes_per_pixel: number;
  rgb: string;
}
export interface KeySpec {
  key: string;
  type: string;
  unit: string;
  default: string;
  doc: string;
  choices?: string;
  range?: number[];
}
export interface Section {
  many: boolean;
  doc: string;
  keys: KeySpec[];
  kinds?: { kind: string; doc: string }[];
}
export type Schema = Record<string, Section>;

export interface Requests {
  play: {};
  pause: {};
  step: { unit?: "tick" | "control" | "interrupt"; count?: number; robot?: string };
  speed: { factor: unknown };
  restart: { seed?: number; play?: boolean };
  steer: {};
  state: {};
  subscribe: { names: string[] };
  rays: { robots: string[] };
  look: { robot: string };
  trace: { robot: string; signals?: string[] };
  floor: {};
  edit: { op?: "set" | "add" | "remove" | "copy" | "paste" | "add_inner" | "remove_inner" | "text"; thing?: number; values?: Record<string, unknown>; path?: string; index?: number; text?: string; base?: string; dx?: number; dy?: number; edits?: unknown[]; group?: number; anew?: boolean };
  undo: { anew?: boolean };
  redo: { anew?: boolean };
  reload: { anew?: boolean };
  text_of: { things: number[] };
  save: { overwrite?: boolean };
  save_as: { name: string; overwrite?: boolean };
  worlds: {};
  open: { file: string; discard?: boolean };
  new_world: { name: string; discard?: boolean };
  source: { program: string; file: string };
  write_source: { program: string; file: string; text: string; base?: string; overwrite?: boolean };
  debug: { robot: string };
  dap: { message: Record<string, unknown> };
  move: { robot?: string; body?: number; x: number; y: number; heading: number };
  type: { robot: string; port: number; bytes: string };
  selector: { robot: string; position: number };
  battery: { robot: string; volts: number };
  key: { robot: string; key: number; hold?: number; address?: number };
  set: { robot: string; variable: string; value: number };
  write: { robot: string; address: number; bytes: number; value: number };
  reset: { robot: string };
  sensor: { robot: string; name: string; value: number };
  faults: { text: string };
  end_fault: { fault: number };
  lamp: { lamp: number; on: boolean; intensity?: number };
}

export interface Events {
  hello: { event: "hello"; version: number; you: number; revision: number; state: State; world: World; programs: Program[]; problems: string[]; diagnoses: Diagnosis[]; traps: Trap[]; names: string[]; schema: Schema };
  world: { event: "world"; revision: number; world: World };
  world_changed: { event: "world_changed"; revision: number; changes: WorldChanges };
  state: { event: "state"; state: State };
  programs: { event: "programs"; programs: Program[] };
  problems: { event: "problems"; problems: string[] };
  disk: { event: "disk"; program?: string; file: string; base: string | null };
  serial: { event: "serial"; robot: string; port: number; time_s: number; text: string };
  trap: { event: "trap"; robot: string; kind: string; text: string; place: string; file: string; line: number; time_s: number };
  diagnoses: { event: "diagnoses"; diagnoses: Diagnosis[] };
  says: { event: "says"; text: string };
  trace: { event: "trace"; robot: string; until: number; signals: [string, number][]; spans: [number, number, number, string][]; waits: boolean; changes: [number, number, number][]; lost: number };
  look: { event: "look"; robot: string; time_s: number; hal: string; place: Place; parts: PartLook[]; camera?: Camera; picture?: Picture };
  building: { event: "building"; program: string };
  built: { event: "built"; program: string; ok: boolean; problems: string[]; warnings: string[]; took_s: number };
  dap: { event: "dap"; name: string; body: any };
}
