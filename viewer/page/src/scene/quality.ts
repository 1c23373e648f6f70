// SPDX-License-Identifier: MIT
// How much the drawing may cost. It measures itself: where a frame takes too long, one thing after the other is left
// out, and comes back when there is time. Without a graphics card a frame is drawn by the processor that simulates.

/** What is left out, in this order. */
export const kLeftOut = ["shadows", "antialiasing", "fine pixels", "details of robots", "half of the pixels"] as const;

const kTooLong = 50; // ms a frame
const kFarTooLong = 4 * kTooLong;
const kQuick = 14; // ms a frame: there is time for more
const kLook = 5; // frames, until one says too long
const kLookIfFar = 2;
const kLookIfQuick = 90;
const kSettle = 3; // frames after a change: materials are made anew
const kWait = 5000; // ms, before more is tried
const kLongestWait = 600000;

export class Quality {
  private wait = kWait;
  private since = 0; // ms, of the last change
  private settle = kSettle;
  private took_: number[] = [];
  private tried = false; // more was tried last

  /** `level`: how many of kLeftOut are left out. */
  constructor(
    public level = 0,
    public measures = true,
  ) {}

  get shadows() {
    return this.level < 1;
  }
  get antialiasing() {
    return this.level < 2;
  }
  get details() {
    return this.level < 4;
  }
  /** Pixels drawn for each of the page's, on a screen that has `screen` of them. */
  ratio(screen: number) {
    return this.level < 3 ? Math.min(screen, 2) : this.level < 5 ? 1 : 0.7;
  }
  get leftOut(): readonly string[] {
    return kLeftOut.slice(0, this.level);
  }

  /** Hears what a frame took, ms; true: from now on it is drawn otherwise. `now`: ms. */
  took(ms: number, now: number): boolean {
    if (!this.measures) return false;
    if (this.settle > 0) {
      --this.settle;
      if (this.settle === 0) this.since = now;
      return false;
    }
    const list = this.took_;
    if (list.push(ms) > kLookIfQuick) list.shift();
    const middle = (count: number) => {
      const last = list.slice(-count).sort((a, b) => a - b);
      return last[count >> 1];
    };
    const isFar = list.length >= kLookIfFar && Math.min(...list.slice(-kLookIfFar)) > kFarTooLong;
    if (this.level < kLeftOut.length && (isFar || (list.length >= kLook && middle(kLook) > kTooLong))) {
      // what was tried did not do: it is tried later and later
      if (this.tried) this.wait = Math.min(kLongestWait, 2 * this.wait);
      return this.change(1, now);
    }
    if (this.level > 0 && list.length >= kLookIfQuick && now - this.since > this.wait && middle(kLookIfQuick) < kQuick)
      return this.change(-1, now);
    return false;
  }
  private change(by: number, now: number) {
    this.level += by;
    this.tried = by < 0;
    this.forget(now);
    return true;
  }
  /** Other things are drawn than were measured. */
  forget(now: number) {
    this.took_ = [];
    this.settle = kSettle;
    this.since = now;
  }
  /** All of it, whatever it costs; or as it is measured. */
  setMeasures(on: boolean, now: number) {
    this.measures = on;
    this.level = 0;
    this.wait = kWait;
    this.tried = false;
    this.forget(now);
  }
}
