// SPDX-License-Identifier: MIT
// A report: all frames are there, and time passes in the page.
import { byId, h } from "../dom";
import type { Playback } from "../link/playback";
import type { Client } from "../store/client";
import type { Kept } from "../store/past";
import type { Store } from "../store/store";
import type { PastBar } from "./past_bar";

const kSpeedAtMax = 64;

export class Report {
  private timer = 0;

  constructor(
    private store: Store,
    private client: Client,
    private past: PastBar,
    private playback: Playback,
  ) {
    document.body.classList.add("report");
    playback.onPast = (frames) => void this.take(frames);
  }
  private async take(frames: Kept[]) {
    this.store.past.frames = frames;
    await this.client.subscribe();
    this.past.goTo(0);
    byId("past").classList.remove("back");
    this.showSummary();
    document.body.dataset.ready = "yes";
  }
  play() {
    const { store } = this,
      { frames } = store.past;
    const begin = performance.now();
    let at = this.past.at;
    if (at >= frames.length - 1) at = 0;
    const from = frames[at]?.time ?? 0;
    const turn = () => {
      const time = from + ((performance.now() - begin) / 1000) * (store.state.speed || kSpeedAtMax);
      while (at + 1 < frames.length && frames[at + 1].time <= time) ++at;
      this.past.goTo(at);
      if (at + 1 < frames.length) this.timer = requestAnimationFrame(turn);
      else this.stop();
    };
    this.timer = requestAnimationFrame(turn);
    store.takeState({ ...store.state, playing: true });
  }
  stop() {
    cancelAnimationFrame(this.timer);
    this.store.takeState({ ...this.store.state, playing: false });
  }
  setSpeed(speed: number) {
    if (this.store.state.playing) this.stop();
    this.store.takeState({ ...this.store.state, speed });
  }
  private showSummary() {
    const s = this.playback.summary;
    const columns: [string, (r: any) => string][] = [
      ["robot", (r) => r.name],
      ["program", (r) => r.firmware.split("/").pop()],
      ["HAL", (r) => r.hal ?? "none"],
      ["x, m", (r) => r.x_m.toFixed(3)],
      ["y, m", (r) => r.y_m.toFixed(3)],
      ["path, m", (r) => r.distance_m.toFixed(3)],
      ["collisions", (r) => r.collisions],
      ["load", (r) => `${(100 * r.cpu_load).toFixed(0)} %`],
      ["battery used", (r) => `${(1000 * r.battery_used_wh).toFixed(0)} mWh`],
      ["traps", (r) => r.traps.length],
      ["diagnoses", (r) => r.diagnoses.length],
    ];
    byId("pane-summary").replaceChildren(
      h(
        "p",
        {},
        `${s.world}: ${s.simulated_s.toFixed(1)} s simulated in ${s.wall_s.toFixed(2)} s (${s.speed.toFixed(0)} times real time), seed ${s.seed}, digest ${s.digest}, Twinpuck ${s.version}`,
      ),
      h(
        "table",
        {},
        h("tr", {}, ...columns.map(([name]) => h("th", {}, name))),
        ...s.robots
          .slice(0, 200)
          .map((r: any) => h("tr", {}, ...columns.map(([, text]) => h("td", {}, String(text(r)))))),
      ),
    );
    this.store.tell("show", "summary");
  }
}
