// SPDX-License-Identifier: MIT
// What this page has seen of the run: frames, whose values they are, looks.
import { readFrame } from "../link/protocol";
import type { Look } from "../link/protocol";

const kMostFrames = 20000;
const kMostBytes = 96 << 20;
const kMostLooks = 3000;

export interface Kept {
  time: number;
  bytes: ArrayBuffer;
}

export class Past {
  frames: Kept[] = [];
  /** The names of a subscription's values: frames of all of them are kept. */
  readonly names = new Map<number, string[]>();
  private bytes = 0;
  private looks: Look[] = [];

  keep(time: number, bytes: ArrayBuffer) {
    this.frames.push({ time, bytes });
    this.bytes += bytes.byteLength;
    while (this.frames.length > kMostFrames || this.bytes > kMostBytes)
      this.bytes -= this.frames.shift()!.bytes.byteLength;
  }
  keepLook(look: Look) {
    this.looks.push(look);
    if (this.looks.length > kMostLooks) this.looks.splice(0, kMostLooks / 4);
  }
  /** The last look of that robot until then. */
  lookOf(robot: string | undefined, until = Infinity): Look | undefined {
    for (let i = this.looks.length - 1; i >= 0; --i)
      if (this.looks[i].robot === robot && this.looks[i].time_s <= until + 1e-9) return this.looks[i];
  }
  forget() {
    this.frames = [];
    this.bytes = 0;
    this.looks = [];
  }
  /** Values by name of every frame that is kept; null where it has none. */
  each(names: string[], look: (time: number, values: (number | null)[]) => void) {
    const places = new Map<number, number[]>(); // by subscription
    for (const { bytes } of this.frames) {
      const frame = readFrame(bytes);
      let at = places.get(frame.subscription);
      if (!at) {
        const known = this.names.get(frame.subscription) ?? [];
        places.set(frame.subscription, (at = names.map((n) => known.indexOf(n))));
      }
      look(
        frame.time,
        at.map((i) => (i < 0 ? null : frame.values[i])),
      );
    }
  }
}
