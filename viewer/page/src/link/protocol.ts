// SPDX-License-Identifier: MIT
// What events and answers hold (protocol_types.ts), and frames, as docs/connecting.md says.

import type { Events } from "./protocol_types";

export type Vec = number[];
export type { Element, Finding, KeySpec, Problem, Program, Robot, Schema, State, Thing, World } from "./protocol_types";
export type Look = Omit<Events["look"], "event">;

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
