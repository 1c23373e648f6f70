// SPDX-License-Identifier: MIT
// The one place of what the page knows: world, state, programs, selection, values, what was seen. Panes look at it
// and are told of changes by topic; none of them knows another. All state that counts is the server's.
import type { Diagnosis, Trap } from "../link/protocol_types";
import { readFrame } from "../link/protocol";
import type { Frame, Look, Program, Robot, Schema, State, Thing, World } from "../link/protocol";
import type { Buffer } from "./buffer";
import { coloursOf } from "./colours";
import { Cursor } from "./cursor";
import { Past } from "./past";

export type { Diagnosis, Trap };
/** A line of a controller's source. */
export interface SourceLine {
  program: string;
  file: string;
  line: number;
  column?: number;
}

/** What the page tells of, and what comes with it. */
export interface Topics {
  /** Another text of the world, or its first one. */
  world: { first: boolean };
  state: State;
  programs: Program[];
  /** Other pieces are selected; or they are the same, of another world. */
  selection: { changed: boolean };
  /** A frame is shown: of now, or of the past. */
  frame: { frame: Frame; began: boolean };
  /** The values of a frame that has just come, in time. */
  sample: number;
  /** Numbers are to be drawn: nobody reads faster. */
  pulse: void;
  /** A frame of the past is shown, by its number in `past`. */
  jump: number;
  /** A run has begun: nothing of the one before is kept. */
  forgotten: void;
  look: Look | undefined;
  serial: { robot: string; port: number; text: string; time_s: number };
  trace: any;
  says: string;
  trap: Trap;
  problems: void;
  /** What is typed in a buffer is unsaved now, or no more; or its file has changed. */
  buffer: Buffer;
  /** What the debugger knows is another now. */
  debug: void;
  /** Breakpoints of the file with that key. */
  breakpoints: string;
  building: any;
  built: any;
  theme: boolean;
  /** Names that somebody wants in every frame have changed. */
  wanted: void;
  rays: Set<string>;
  /** A pane of the dock is asked for. */
  show: string;
  /** That pane is in sight now. */
  shown: string;
  worldLine: number;
  sourceLine: SourceLine;
  plot: string;
  follow: string;
  /** The pointer is at another time, or a marker is. */
  cursor: void;
}

const kNoWorld: World = {
  title: "",
  file: "",
  text: "",
  base: "",
  step_s: 0.032,
  tick_s: 1 / 512,
  floor: { colour: [1, 1, 1], image: "" },
  things: [],
  robots: [],
  elements: [],
  problems: [],
};
const kNoState: State = {
  playing: false,
  speed: 1,
  ended: false,
  time_s: 0,
  seed: 1,
  saved: true,
  undo: false,
  redo: false,
  steering: 0,
  debugging: "",
  runs: false,
};

export class Store {
  world: World = kNoWorld;
  /** Of the world: frames that belong to it have the same. */
  revision = 0;
  state: State = kNoState;
  programs: Program[] = [];
  schema: Schema = {};
  /** What a robot can be asked for, behind its name and a dot. */
  names: string[] = [];
  /** This page's number at the server. */
  me = 0;
  /** Values of the frame that is shown, by name. */
  readonly values = new Map<string, number>();
  /** Their units, as far as the server tells. */
  readonly units = new Map<string, string>();
  frame?: Frame;
  /** Of the selected robot, at the time that is shown. */
  look?: Look;
  readonly past = new Past();
  /** False: what is shown is of the past. */
  live = true;
  traps: Trap[] = [];
  diagnoses: Diagnosis[] = [];
  /** Why there is no run. */
  noRun: string[] = [];
  readonly rays = new Set<string>();
  dark = false;
  /** What the camera of the selected robot sees is drawn in the scene. */
  showView = true;
  showTrails = true;
  /** The pane of the dock that is in sight. */
  dock = "";
  /** A report: nothing runs. */
  recorded = false;
  /** Frames that have come. */
  frames = 0;
  /** Who wants values in every frame, and which; see client.subscribe(). */
  readonly wanted: (() => string[])[] = [];
  /** The time that the pointer is at, and two markers. */
  readonly cursor = new Cursor(() => this.tell("cursor"));
  private chosen: number[] = [];
  private listeners = new Map<string, ((what: any) => void)[]>();

  on<K extends keyof Topics>(topic: K, listener: (what: Topics[K]) => void) {
    const list = this.listeners.get(topic);
    if (list) list.push(listener);
    else this.listeners.set(topic, [listener]);
  }
  tell<K extends keyof Topics>(topic: K, ...what: Topics[K] extends void ? [] : [Topics[K]]) {
    for (const listener of this.listeners.get(topic) ?? []) listener(what[0]);
  }

  // --- what is selected

  /** All that are selected; the last one is the one that the inspector shows. */
  get selection(): readonly number[] {
    return this.chosen;
  }
  get selected() {
    return this.chosen[this.chosen.length - 1] ?? 0;
  }
  select(id: number) {
    this.selectAll(id ? [id] : []);
  }
  selectAll(ids: readonly number[]) {
    const changed = ids.length !== this.chosen.length || ids.some((id, i) => id !== this.chosen[i]);
    this.chosen = [...ids];
    this.tell("selection", { changed });
    if (changed) this.showLook(this.past.lookOf(this.selectedRobot()?.name));
  }
  robot(id: number): Robot | undefined {
    return this.world.robots.find((r) => r.id === id);
  }
  thing(id: number): Thing | undefined {
    return this.world.things.find((t) => t.id === id);
  }
  piece(id: number): Robot | Thing | undefined {
    return this.robot(id) ?? this.thing(id);
  }
  selectedRobot() {
    return this.robot(this.selected);
  }
  selectedThing() {
    return this.thing(this.selected);
  }

  // --- what the server tells

  takeWorld(world: World, revision: number) {
    const first = this.revision === 0,
      colours = coloursOf(world);
    for (const robot of world.robots) robot.colour = colours.get(robot.id)!;
    this.world = world;
    this.revision = revision;
    this.chosen = this.chosen.filter((id) => this.piece(id));
    for (const name of this.rays) if (!world.robots.some((r) => r.name === name)) this.rays.delete(name);
    this.tell("world", { first });
    this.tell("selection", { changed: false });
    this.tell("problems");
  }
  /** The world is saved under another name, in the same folder. */
  rename(name: string) {
    this.world = { ...this.world, file: this.world.file.replace(/[^/]*$/, name) };
    this.tell("state", this.state);
  }
  takeState(state: State) {
    this.state = state;
    this.tell("state", state);
  }
  takePrograms(programs: Program[]) {
    this.programs = programs;
    this.tell("programs", programs);
  }
  takeLook(look: Look) {
    this.past.keepLook(look);
    if (this.live) this.showLook(look);
  }
  showLook(look?: Look) {
    const robot = this.selectedRobot();
    this.look = look && robot?.name === look.robot ? look : undefined;
    this.tell("look", this.look);
  }
  /** A run begins: what was seen is of another one. */
  forget() {
    this.past.forget();
    this.traps = [];
    this.live = true;
    this.tell("forgotten");
    this.tell("problems");
  }
  /** True where the frame's values have names. */
  takeValues(frame: Frame) {
    const names = this.past.names.get(frame.subscription);
    if (!names) return false;
    names.forEach((n, i) => this.values.set(n, frame.values[i]));
    return true;
  }
  show(frame: Frame) {
    const began = frame.time > 0 !== (this.frame?.time ?? 0) > 0;
    this.frame = frame;
    this.tell("frame", { frame, began });
  }
  /** A frame of the past, by its number; the last one is now. */
  goTo(at: number) {
    const kept = this.past.frames[at];
    this.live = at >= this.past.frames.length - 1;
    if (!kept) return;
    const frame = readFrame(kept.bytes);
    this.takeValues(frame);
    this.tell("jump", at);
    this.show(frame);
    this.tell("pulse");
    this.showLook(this.past.lookOf(this.selectedRobot()?.name, frame.time));
  }

  // --- questions about it

  leds(body: number) {
    return this.frame && body >= 0 && body < this.frame.robots ? this.frame.robotWords[2 * body] : 0;
  }
  /** What a robot runs, which may be another program than its file says (--fw). */
  programOf(robot: Robot) {
    return this.programs.find((p) => p.robots.includes(robot.name))?.name ?? robot.firmware;
  }
  /** The line of a controller's source where a robot's program stands. */
  sourceOf(look?: Look): SourceLine | undefined {
    const at = look?.place;
    // as it was compiled, which may be from elsewhere
    for (const program of at?.line ? this.programs.filter((p) => p.robots.includes(look!.robot)) : [])
      for (const file of program.files)
        if (`/${program.folder}/${file}`.endsWith(`/${at!.file}`))
          return { program: program.name, file, line: at!.line };
  }
  setDark(dark: boolean) {
    this.dark = dark;
    this.tell("theme", dark);
  }
}
