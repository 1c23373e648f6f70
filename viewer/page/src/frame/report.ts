// SPDX-License-Identifier: MIT
// A report: all frames are there, and time passes in the page.
import { byId, h } from "../dom";
import type { Playback } from "../link/playback";
import type { Client } from "../store/client";
import type { Kept } from "../store/past";
import type { Store } from "../store/store";
import type { PastBar } from "./past_bar";

const kSpeedAtMax = 64;
const kMostRows = 200; // robots

/** What people call a robot's program: its folder or file, not the image that was made of it. */
export function programName(r: { program?: string; firmware?: string }): string {
  const name = (r.program || r.firmware || "").replace(/\/+$/, "").split("/").pop()!;
  return name || "none";
}
/** Columns of the summary, each with its unit, and what they say of a robot. */
export const kColumns: [string, string, (r: any) => string][] = [
  ["robot", "", (r) => r.name],
  ["program", "", programName],
  ["HAL", "", (r) => r.hal ?? "none"],
  ["x", "m", (r) => r.x_m.toFixed(3)],
  ["y", "m", (r) => r.y_m.toFixed(3)],
  ["heading", "°", (r) => ((r.heading_rad * 180) / Math.PI - 360 * Math.round(r.heading_rad / 2 / Math.PI)).toFixed(1)],
  ["path", "m", (r) => r.distance_m.toFixed(3)],
  ["collisions", "", (r) => String(r.collisions)],
  ["load", "%", (r) => (100 * r.cpu_load).toFixed(0)],
  ["battery", "V", (r) => r.battery_v?.toFixed(2) ?? "–"],
  ["battery used", "mWh", (r) => (1000 * r.battery_used_wh).toFixed(1)],
  ["traps", "", (r) => String(r.traps.length)],
  ["diagnoses", "", (r) => String(r.diagnoses.length)],
];

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
    // the end, with the way that led there
    this.past.goTo(frames.length - 1);
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
    const programs = [...new Set(s.robots.map(programName))];
    byId("pane-summary").replaceChildren(
      h(
        "p",
        {},
        `${s.world}, ${programs.slice(0, 4).join(", ")}${programs.length > 4 ? " and more" : ""}: ${s.simulated_s.toFixed(1)}\u202fs simulated in ${s.wall_s.toFixed(2)}\u202fs (${s.speed.toFixed(0)} times real time), seed ${s.seed}, digest ${s.digest}, Twinpuck ${s.version}`,
      ),
      h(
        "table",
        {},
        h("tr", {}, ...kColumns.map(([name, unit]) => h("th", {}, unit ? `${name} (${unit})` : name))),
        ...s.robots
          .slice(0, kMostRows)
          .map((r: any) => h("tr", {}, ...kColumns.map(([, , text]) => h("td", {}, text(r))))),
      ),
      (s.robots.length > kMostRows && h("p", { className: "dim" }, `and ${s.robots.length - kMostRows} robots more`)) ||
        "",
    );
    document.title = `${this.store.world.title || s.world} – ${programs.slice(0, 4).join(", ")} – Twinpuck`;
    this.store.tell("show", "summary");
  }
}
