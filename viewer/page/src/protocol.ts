// SPDX-License-Identifier: MIT
// The page's end of docs/connecting.md: one WebSocket, requests with answers, events, frames.

export type Vec = number[];
export interface Thing {
  id: number; kind: string; name?: string; position: Vec; heading?: number; size?: Vec; radius?: number;
  points?: Vec[]; closed?: boolean; thickness?: number; height?: number; z?: number; colour: Vec; corners?: Vec[];
  movable?: boolean; body?: number; low?: number; high?: number; intensity?: number; attenuation?: Vec; on?: boolean; level?: number;
}
export interface Robot {
  id: number; kind: "robot"; name: string; firmware: string; body: number; position: Vec;
  heading: number; colour: Vec; radius: number; z0: number; height: number; wheel_radius: number; axle: number;
  leds: Vec[]; sensors: Vec[]; parts: string[];
}
export interface Problem { line: number; column: number; text: string; id: number }
export interface Element { id: number; path: string; line: number; values: Record<string, string> }
export interface World {
  title: string; file: string; text: string; step_s: number; tick_s: number;
  arena?: { id: number; size: Vec; centre: Vec; wall_height: number; wall_thickness: number; colour: Vec };
  floor: { colour: Vec; image: string };
  things: Thing[]; robots: Robot[]; elements: Element[]; problems: Problem[];
}
export interface Program { name: string; robots: string[]; folder: string; files: string[] }
export interface State {
  playing: boolean; speed: number; ended: boolean; time_s: number; seed: number; saved: boolean; undo: boolean;
  redo: boolean; steering: number; runs: boolean; outcome?: { code: number; text: string };
}
export interface KeySpec {
  key: string; type: string; unit: string; default: string; doc: string; choices?: string; range?: Vec;
}
export type Schema = Record<string, { many: boolean; doc: string; keys: KeySpec[]; kinds?: { kind: string; doc: string }[] }>;
export interface Look {
  robot: string; time_s: number; way?: string; place?: { function: string; file: string; line: number };
  parts: { kind: string; shows: string }[]; camera?: { at: Vec; edges: Vec; pictures: number };
  picture?: { number: number; columns: number; rows: number; bytes_per_pixel: number; rgb: string };
}

/** A frame, looked at in place: nothing is copied. */
export interface Frame {
  revision: number; time: number; pace: number; running: boolean; robots: number; bodies: number;
  subscription: number; values: Float64Array; poses: Float32Array; robotWords: Uint32Array; rays: Float32Array;
}
export const RobotState = { NoProgram: 1, Stopped: 2, Waiting: 4, Sounding: 8 };

const kHead = 48;

export function readFrame(bytes: ArrayBuffer): Frame {
  const head = new DataView(bytes);
  const u = (at: number) => head.getUint32(at, true);
  const robots = u(28), bodies = u(32), values = u(36), rays = u(40);
  const poses = kHead + 8 * values, words = poses + 16 * bodies, rayBytes = words + 8 * robots;
  return {
    revision: u(4), time: head.getFloat64(8, true), pace: head.getFloat64(16, true), running: (u(24) & 1) !== 0,
    robots, bodies, subscription: u(44),
    values: new Float64Array(bytes, kHead, values),
    poses: new Float32Array(bytes, poses, 4 * bodies),
    robotWords: new Uint32Array(bytes, words, 2 * robots),
    rays: new Float32Array(bytes, rayBytes, 7 * rays),
  };
}

type Answer = Record<string, any>;
type Listener = (event: any) => void;

/** Who tells this page of a run: a server that runs it, or the file of a report. */
export abstract class Link {
  private listeners = new Map<string, Listener[]>();
  onFrame: (frame: Frame, bytes: ArrayBuffer) => void = () => {};
  onClose: () => void = () => {};
  on(event: string, listener: Listener) {
    this.listeners.set(event, [...(this.listeners.get(event) ?? []), listener]);
  }
  protected tell(event: any) { (this.listeners.get(event.event) ?? []).forEach((listener) => listener(event)); }
  /** The answer; rejected with what is wrong. */
  abstract ask(what: string, more?: Record<string, unknown>): Promise<Answer>;
}

/** What start.ts has opened, and heard since then. */
export interface Early { socket: WebSocket; heard: (string | ArrayBuffer)[] }

export class Connection extends Link {
  private socket: WebSocket;
  private next = 1;
  private waiting = new Map<number, { done: (a: Answer) => void; fail: (e: Error) => void }>();

  constructor() {
    super();
    const { socket, heard }: Early = (window as any).early;
    this.socket = socket;
    socket.onclose = () => this.onClose();
    const hear = (message: string | ArrayBuffer) => {
      if (typeof message !== "string") return this.onFrame(readFrame(message), message);
      const data = JSON.parse(message);
      if (!("answer" in data)) return this.tell(data);
      const asked = this.waiting.get(data.answer);
      this.waiting.delete(data.answer);
      if (data.error) asked?.fail(Object.assign(new Error(data.error), { anew: data.anew }));
      else asked?.done(data);
    };
    socket.onmessage = (message) => hear(message.data);
    // once who listens is there
    queueMicrotask(() => {
      heard.forEach(hear);
      if (socket.readyState > WebSocket.OPEN) this.onClose();
    });
  }
  ask(what: string, more: Record<string, unknown> = {}): Promise<Answer> {
    const id = this.next++;
    this.socket.send(JSON.stringify({ id, do: what, ...more }));
    return new Promise((done, fail) => this.waiting.set(id, { done, fail }));
  }
}

/** A value as the world file writes it, read; undefined where it is nothing simple. */
export function readLiteral(literal: string): any {
  const plain = literal.replace(/#.*$/gm, "").replace(/,(\s*\])/g, "$1").replace(/(^|[[,\s])\+/g, "$1")
    .replace(/^'(.*)'$/s, (_, t) => JSON.stringify(t)).replace(/(\d)_(\d)/g, "$1$2");
  try {
    return JSON.parse(plain);
  } catch {
    return undefined;
  }
}
