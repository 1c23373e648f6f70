// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import test from "node:test";
import { format, unitOf, withUnit } from "../src/panes/units";

test("decimals are those of the quantity", () => {
  assert.equal(format(0.0519999, "m/s"), "0.052");
  assert.equal(format(3.999, "V"), "4.00");
  assert.equal(format(123.4, "counts"), "123");
  assert.equal(format(1 / 3, ""), "0.333333");
  assert.equal(format(5, ""), "5");
  assert.equal(format(NaN, "V"), "–");
  assert.equal(withUnit(0.1, "m"), "0.100\u202fm");
});
test("names of robots have units", () => {
  assert.equal(unitOf("puck.ir3"), "counts");
  assert.equal(unitOf("puck.heading"), "deg");
  assert.equal(unitOf("puck.acc_x"), "counts");
  assert.equal(unitOf("puck.var:counter"), "");
});
