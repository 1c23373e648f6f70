// SPDX-License-Identifier: MIT
// What changes of a line mean: bytes of a UART, duty and period of a PWM. A change is [time in s, value], and the value
// holds until the next.

export type Change = [number, number];
export interface Byte {
  from: number;
  to: number;
  value: number;
  /** What is wrong with it, empty: nothing. */
  wrong: string;
}
export interface Pulse {
  from: number;
  to: number;
  /** s that it is high */
  high: number;
}
export const kDecoders = ["", "UART", "PWM"] as const;
export type Decoder = (typeof kDecoders)[number];

export const kRates = [
  300, 1200, 2400, 4800, 9600, 14400, 19200, 28800, 38400, 57600, 76800, 115200, 230400, 460800, 921600,
];
const kBits = 10; // start, eight, stop
const kOff = 0.08; // of a standard rate, that an edge may suggest: a baud generator is off by up to 4 %
const kShortestShare = 0.02; // of all intervals, that are shorter than one bit by chance
const kMostEdges = 4000; // looked at for the rate

/** Bits a second, from the shortest time between two edges; undefined: too few of them. */
export function rateOf(changes: readonly Change[]): number | undefined {
  const some = changes.slice(-kMostEdges),
    gaps: number[] = [];
  for (let i = 1; i < some.length; ++i) if (some[i][0] > some[i - 1][0]) gaps.push(some[i][0] - some[i - 1][0]);
  if (gaps.length < 2) return undefined;
  gaps.sort((x, y) => x - y);
  const shortest = gaps[Math.floor(gaps.length * kShortestShare)],
    rate = 1 / shortest;
  const near = kRates.reduce((best, r) => (Math.abs(r - rate) < Math.abs(best - rate) ? r : best));
  return Math.abs(near - rate) < kOff * near ? near : rate;
}

/** Bytes of a line that rests at 1: a start bit, eight bits from the lowest on, a stop bit. */
export function bytesOfLine(changes: readonly Change[], rate: number, until = Infinity): Byte[] {
  const out: Byte[] = [],
    bit = 1 / rate;
  let i = 0;
  const level = (at: number) => {
    while (i + 1 < changes.length && changes[i + 1][0] <= at) ++i;
    return changes[i][1] ? 1 : 0;
  };
  for (let k = 1; k < changes.length; ++k) {
    if (changes[k][1] || !changes[k - 1][1]) continue; // not a falling edge
    const from = changes[k][0],
      to = from + kBits * bit;
    if (to - bit / 2 > until) break;
    i = k;
    if (level(from + bit / 2)) continue; // a glitch
    let value = 0;
    for (let b = 0; b < 8; ++b) value |= level(from + (b + 1.5) * bit) << b;
    const stop = level(from + 9.5 * bit);
    out.push({ from, to, value, wrong: stop ? "" : value === 0 ? "break" : "no stop bit" });
    // the next start bit is behind this byte
    while (k + 1 < changes.length && changes[k + 1][0] < from + 9.5 * bit) ++k;
  }
  return out;
}

/** Bytes of a signal that says the byte itself; `busy`: when there is one, which tells two of the same apart. */
export function bytesOfValues(changes: readonly Change[], busy: readonly Change[] | undefined, until: number): Byte[] {
  const out: Byte[] = [];
  const put = (from: number, value: number) => {
    const last = out[out.length - 1];
    if (last && last.to > from) last.to = from;
    out.push({ from, to: until, value: value & 0xff, wrong: "" });
  };
  if (!busy) {
    // the first is what the line began with
    changes.forEach(([at, value], i) => i && put(at, value));
    return out;
  }
  let value = 0,
    v = 0,
    on = false;
  const edges = [...busy.map(([at, b]) => ({ at, busy: b })), ...changes.map(([at, b]) => ({ at, byte: b }))].sort(
    (p, q) => p.at - q.at,
  ) as { at: number; busy?: number; byte?: number }[];
  while (v < edges.length) {
    // all that changes at once is one
    const { at } = edges[v];
    let begins = false,
      is = false;
    for (; v < edges.length && edges[v].at === at; ++v) {
      const e = edges[v];
      if (e.byte !== undefined) {
        value = e.byte;
        is = true;
      } else if (e.busy && !on) begins = on = true;
      else if (!e.busy) {
        on = false;
        const last = out[out.length - 1];
        if (last && last.to > at) last.to = at;
      }
    }
    if (on && (begins || is)) put(at, value);
  }
  return repeated(out, edges[0]?.at, until);
}
/** A byte that is sent twice without a pause is one value for twice as long. What is seen in part, at the beginning or
 * at the end, does not say how long one takes. */
function repeated(bytes: Byte[], since: number, until: number): Byte[] {
  const isWhole = (b: Byte) => b.to > b.from && b.from > since && b.to < until;
  const shortest = bytes.reduce((least, b) => (isWhole(b) ? Math.min(least, b.to - b.from) : least), Infinity);
  return bytes.flatMap((b) => {
    const count = Math.max(1, Math.round((b.to - b.from) / shortest)) || 1,
      each = (b.to - b.from) / count;
    return Array.from({ length: count }, (_, i) => ({ ...b, from: b.from + i * each, to: b.from + (i + 1) * each }));
  });
}

/** From each rising edge to the next. */
export function pulsesOf(changes: readonly Change[]): Pulse[] {
  const out: Pulse[] = [];
  let rise: number | undefined, fall: number | undefined;
  for (let i = 0; i < changes.length; ++i) {
    const [at, value] = changes[i],
      before = i ? changes[i - 1][1] : value;
    if (value && !before) {
      if (rise !== undefined && fall !== undefined) out.push({ from: rise, to: at, high: fall - rise });
      rise = at;
      fall = undefined;
    } else if (!value && before && rise !== undefined) fall = at;
  }
  return out;
}
export const dutyText = (p: Pulse) => `${((100 * p.high) / (p.to - p.from)).toFixed(1)}\u202f%`;

const kNamed: Record<number, string> = { 0: "NUL", 9: "TAB", 10: "LF", 13: "CR", 27: "ESC", 32: "space", 127: "DEL" };
/** As a character and in hexadecimal. */
export function byteText(value: number): string {
  const hex = value.toString(16).toUpperCase().padStart(2, "0"),
    sign = kNamed[value] ?? (value > 32 && value < 127 ? `'${String.fromCharCode(value)}'` : "");
  return sign ? `${sign} ${hex}` : hex;
}
