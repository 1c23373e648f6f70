// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import test from "node:test";
import { Cursor, durationText, timeText } from "../src/store/cursor";
import { byteText, bytesOfLine, bytesOfValues, dutyText, pulsesOf, rateOf } from "../src/panes/decoders";
import type { Change } from "../src/panes/decoders";
import { gapsOf, nearest } from "../src/panes/plots";

/** A line as a UART drives it: rests at 1, then byte after byte from that time on. */
function line(bytes: number[], rate: number, from = 0.001): Change[] {
  const out: Change[] = [[0, 1]];
  let level = 1,
    at = from;
  const drive = (to: number) => {
    if (to !== level) out.push([at, to]);
    level = to;
    at += 1 / rate;
  };
  for (const b of bytes) {
    drive(0);
    for (let i = 0; i < 8; ++i) drive((b >> i) & 1);
    drive(1);
  }
  return out;
}
const values = (bytes: { value: number }[]) => bytes.map((b) => b.value);

test("bytes of a line, back to back, and the rate from its edges", () => {
  const sent = [0x68, 0x69, 0x0d, 0x00, 0xff, 0x55],
    changes = line(sent, 115200);
  assert.equal(rateOf(changes), 115200);
  const bytes = bytesOfLine(changes, 115200);
  assert.deepEqual(values(bytes), sent);
  assert.ok(bytes.every((b) => !b.wrong));
  assert.ok(Math.abs(bytes[0].to - bytes[0].from - 10 / 115200) < 1e-9);
});

test("a baud generator that is 3 % off is still read", () => {
  const changes = line([0x55, 0xa3], 115200 * 1.03);
  assert.equal(rateOf(changes), 115200);
  assert.deepEqual(values(bytesOfLine(changes, 115200)), [0x55, 0xa3]);
});

test("a line that stays low is a break, and one that is read at a wrong rate has no stop bit", () => {
  assert.equal(
    bytesOfLine(
      [
        [0, 1],
        [0.001, 0],
        [0.01, 1],
      ],
      9600,
    )[0].wrong,
    "break",
  );
  assert.ok(bytesOfLine(line([0x00, 0x0f], 9600), 19200).some((b) => b.wrong));
  assert.equal(rateOf([[0, 1]]), undefined);
  assert.deepEqual(bytesOfLine([], 9600), []);
});

test("a byte counts from the middle of its stop bit on, and a glitch is none", () => {
  const bit = 1 / 9600,
    changes = line([0x41], 9600, 0.001);
  for (const [bits, expected] of [
    [5, []],
    [9.4, []],
    [9.6, [0x41]],
    [10, [0x41]],
  ] as [number, number[]][])
    assert.deepEqual(values(bytesOfLine(changes, 9600, 0.001 + bits * bit)), expected);
  // low for a share of a bit, then a byte
  for (const [share, first] of [
    [0.4, []],
    [0.6, [0xff]],
  ] as [number, number[]][])
    assert.deepEqual(
      values(bytesOfLine([[0, 1], [0.0001, 0], [0.0001 + share * bit, 1], ...line([0x41], 9600, 0.01).slice(1)], 9600)),
      [...first, 0x41],
    );
});

test("a signal of bytes: two of the same without a pause are two", () => {
  const t = 10 / 115200,
    changes: Change[] = [
      [0, 0],
      [1, 0x68],
      [1 + t, 0x6c],
      [1 + 3 * t, 0x6f],
    ],
    busy: Change[] = [
      [0, 0],
      [1, 1],
      [1 + 4 * t, 0],
    ];
  assert.deepEqual(values(bytesOfValues(changes, busy, 2)), [0x68, 0x6c, 0x6c, 0x6f]);
  // again the same, after a pause: only busy says so
  assert.deepEqual(
    values(bytesOfValues(changes, [...busy, [1.5, 1], [1.5 + t, 0]], 2)),
    [0x68, 0x6c, 0x6c, 0x6f, 0x6f],
  );
  assert.deepEqual(values(bytesOfValues(changes, undefined, 2)), [0x68, 0x6c, 0x6f]);
  // cut off in the middle of the last one: the others are no longer for that
  const cut = 1 + 3 * t + t / 50;
  assert.deepEqual(values(bytesOfValues(changes, busy.slice(0, -1), cut)), [0x68, 0x6c, 0x6c, 0x6f]);
});

test("duty and period of a PWM", () => {
  const changes: Change[] = [
    [0, 0],
    [0.01, 1],
    [0.0125, 0],
    [0.02, 1],
    [0.0275, 0],
    [0.03, 1],
  ];
  const pulses = pulsesOf(changes);
  assert.deepEqual(
    pulses.map((p) => dutyText(p).replace(/\s/g, " ")),
    ["25.0 %", "75.0 %"],
  );
  assert.ok(Math.abs(pulses[0].to - pulses[0].from - 0.01) < 1e-12);
  assert.deepEqual(pulsesOf([[0, 1]]), []);
  // high from the beginning, and the same level told again
  assert.deepEqual(
    pulsesOf([
      [0, 1],
      [1, 0],
      [2, 1],
      [3, 1],
      [4, 0],
      [5, 0],
      [6, 1],
    ]),
    [{ from: 2, to: 6, high: 2 }],
  );
});

test("bytes in words", () => {
  assert.deepEqual([0x41, 0x0a, 0x20, 0x80, 0].map(byteText), ["'A' 41", "LF 0A", "space 20", "80", "NUL 00"]);
});

test("the cursor's markers say the time between them and its rate", () => {
  let told = 0;
  const c = new Cursor(() => ++told);
  c.pointAt(1);
  c.pointAt(1);
  assert.equal(told, 1);
  c.mark("a", 1.5);
  assert.equal(c.text.replace(/\s/g, " "), "A 1.500 s");
  c.mark("b", 1.51);
  assert.match(c.text.replace(/\s/g, " "), /^A 1\.500 s {2}B 1\.510 s {2}B−A 10\.000 ms, 100\.0 Hz$/);
  c.forgetMarkers();
  assert.equal(c.text, "");
  assert.equal(timeText(0.0000125).replace(/\s/g, " "), "0.000013 s");
  assert.equal(durationText(-0.000022).replace(/\s/g, " "), "−22 µs");
});

test("plots: gaps of what was seen, and the sample that is nearest", () => {
  assert.deepEqual(gapsOf([0, 0.032, 0.064, 2, 2.032]), [3]);
  assert.equal(nearest([0, 1, 2], 1.6), 2);
  assert.equal(nearest([0, 1, 2], 1.4), 1);
  assert.equal(nearest([0, 1, 2], 9), 2);
  assert.equal(nearest([], 1), -1);
});
