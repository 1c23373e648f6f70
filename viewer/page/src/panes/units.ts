// SPDX-License-Identifier: MIT
// Numbers as people read them: with a unit, and as many decimals as the quantity has.

/** Decimals by unit: a millimetre, a hundredth of a volt, whole counts. */
const kDecimals: Record<string, number> = {
  m: 3,
  "m/s": 3,
  "rad/s": 2,
  rad: 3,
  deg: 1,
  "°": 1,
  "deg/s": 1,
  V: 2,
  mA: 0,
  A: 3,
  "%": 0,
  s: 3,
  Hz: 1,
  dB: 1,
  Wh: 3,
  counts: 0,
  steps: 0,
  times: 0,
};
/** What each name of a robot is in; for servers that do not say it, and for labels. */
export const kUnits: Record<string, string> = {
  x: "m",
  y: "m",
  heading: "deg",
  speed: "m/s",
  spin: "deg/s",
  distance: "m",
  collisions: "times",
  battery: "V",
  charge: "%",
  current: "mA",
  load: "%",
  left_steps: "steps",
  right_steps: "steps",
  sound_bearing: "deg",
  speaker: "%",
};
const kSignificant = 6; // of a number without a unit

export function unitOf(name: string): string {
  const own = name.split(".").pop()!;
  if (own in kUnits) return kUnits[own];
  return /^(ir|light|mic|mic_level|acc_)[0-9xyz]+$/.test(own) ? "counts" : "";
}
export function format(value: number, unit: string): string {
  if (!Number.isFinite(value)) return "–";
  const decimals = kDecimals[unit];
  if (decimals !== undefined) return value.toFixed(decimals);
  return Number.isInteger(value) ? String(value) : String(Number(value.toPrecision(kSignificant)));
}
/** With a narrow no-break space between them. */
export const withUnit = (value: number, unit: string) => format(value, unit) + (unit ? `\u202f${unit}` : "");
