// SPDX-License-Identifier: MIT
// How much the drawing may cost. It measures itself: where a frame takes too long, one thing after the other is left
// out, and comes back when there is time. Without a graphics card a frame is drawn by the processor that simulates.

/** What is left out, in this order. */
export const kLeftOut = ["shadows", "antialiasing", "fine pixels", "details of robots", "half of the pixels"] as const;
type LeftOut = (typeof kLeftOut)[number];

const kTooLong = 50; // ms a frame
const kFarTooLong = 4 * kTooLong;
const kQuick = 14; // ms a frame: there is time for more
const kLook = 4; // measured frames, until one says too long
const kLookIfFar = 2;
const kLookIfQuick = 8;
const kSettle = 1; // measured frames after a change: materials are made anew
const kWait = 5000; // ms, before more is tried
const kLongestWait = 600000;

export class Quality {
  private wait = kWait;
  private since = 0; // ms, of the last change
  private settle = kSettle;
  private took_: number[] = [];
  private tried = false; // more was tried last

  private steps: readonly LeftOut[];
  /** `level`: how many things are left out; `screen`: its pixels for each of the page's. */
  constructor(
    public level = 0,
    public measures = true,
    private screen = 1,
  ) {
    this.steps = kLeftOut.filter((what) => screen > 1 || what !== "fine pixels");
    this.level = Math.min(level, this.steps.length);
  }

  private leaves(what: LeftOut) {
    return this.leftOut.includes(what);
  }
  get shadows() {
    return !this.leaves("shadows");
  }
  get antialiasing() {
    return !this.leaves("antialiasing");
  }
  get details() {
    return !this.leaves("details of robots");
  }
  /** Pixels drawn for each of the page's. */
  get ratio() {
    if (this.leaves("half of the pixels")) return Math.min(this.screen, 0.7);
    return this.leaves("fine pixels") ? 1 : Math.min(this.screen, 2);
  }
  get leftOut(): readonly LeftOut[] {
    return this.steps.slice(0, this.level);
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
    if (this.level < this.steps.length && (isFar || (list.length >= kLook && middle(kLook) > kTooLong))) {
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
