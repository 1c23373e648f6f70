// SPDX-License-Identifier: MIT
// One time that people look at, over plots, time line and console, and two markers with the time between them.
// Simulated seconds.

const kSame = 1e-9; // s

export class Cursor {
  /** Below the pointer; undefined: it is elsewhere. */
  time?: number;
  a?: number;
  b?: number;

  constructor(private tell: () => void) {}
  pointAt(time: number | undefined) {
    if (time === this.time || (time !== undefined && Math.abs(time - (this.time ?? NaN)) < kSame)) return;
    this.time = time;
    this.tell();
  }
  mark(which: "a" | "b", time: number | undefined) {
    this[which] = time;
    this.tell();
  }
  forgetMarkers() {
    this.a = this.b = undefined;
    this.tell();
  }
  /** The markers in words; empty: there are none. */
  get text(): string {
    const { a, b } = this;
    if (a === undefined && b === undefined) return "";
    if (a === undefined || b === undefined) return a === undefined ? `B ${timeText(b!)}` : `A ${timeText(a)}`;
    const between = b - a,
      rate = Math.abs(between) > kSame ? `, ${rateText(1 / Math.abs(between))}` : "";
    return `A ${timeText(a)}  B ${timeText(b)}  B−A ${durationText(between)}${rate}`;
  }
}

const kNarrow = "\u202f";
/** To the microsecond, without noughts behind the millisecond. */
export const timeText = (s: number) => `${s.toFixed(6).replace(/0{1,3}$/, "")}${kNarrow}s`;
/** In the unit that it is read in. */
export function durationText(s: number): string {
  const size = Math.abs(s),
    sign = s < 0 ? "−" : "";
  if (size < 1e-3) return `${sign}${(size * 1e6).toFixed(size < 1e-5 ? 1 : 0)}${kNarrow}µs`;
  if (size < 1) return `${sign}${(size * 1e3).toFixed(3)}${kNarrow}ms`;
  return `${sign}${size.toFixed(3)}${kNarrow}s`;
}
const rateText = (hz: number) =>
  hz < 1e3 ? `${hz.toPrecision(4)}${kNarrow}Hz` : `${(hz / 1e3).toPrecision(4)}${kNarrow}kHz`;
