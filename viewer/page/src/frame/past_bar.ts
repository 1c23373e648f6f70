// SPDX-License-Identifier: MIT
// Back and forth over what this page has seen: the slider and the clock below the scene.
import { byId } from "../dom";
import type { Store } from "../store/store";

export class PastBar {
  private scrub = byId("scrub") as HTMLInputElement;

  constructor(private store: Store) {
    this.scrub.addEventListener("input", () => this.goTo(Number(this.scrub.value)));
    store.on("frame", ({ frame }) => (byId("clock").textContent = `${frame.time.toFixed(3)} s`));
    store.on("pulse", () => {
      this.scrub.max = String(store.past.frames.length - 1);
      if (store.live) this.scrub.value = this.scrub.max;
    });
    store.on("forgotten", () => byId("past").classList.remove("back"));
  }
  get at() {
    return Number(this.scrub.value);
  }
  goTo(at: number) {
    this.scrub.max = String(this.store.past.frames.length - 1);
    this.scrub.value = String(at);
    this.store.goTo(at);
    byId("past").classList.toggle("back", !this.store.live);
  }
  /** What is shown is of now again. */
  goToNow() {
    if (!this.store.live) this.goTo(this.store.past.frames.length - 1);
  }
}
