// SPDX-License-Identifier: MIT
// The bar above the scene: time, undo and save, views.
import { byId, h, icon } from "../dom";
import { toggleKeys } from "./key_list";
import { foldButton } from "./layout";
import { RobotState } from "../link/protocol";
import type { State } from "../link/protocol";
import type { Client } from "../store/client";
import type { Store } from "../store/store";
import type { PastBar } from "./past_bar";
import type { Report } from "./report";
import type { WorldFile } from "./save";
import { worldsMenu } from "./worlds_menu";

export const kSpeeds: [string, number][] = [
  ["1/16", 1 / 16],
  ["1/8", 1 / 8],
  ["1/4", 1 / 4],
  ["1/2", 1 / 2],
  ["1", 1],
  ["2", 2],
  ["4", 4],
  ["8", 8],
  ["16", 16],
  ["64", 64],
  ["max", 0],
];

/** What the bar's buttons do that is not the server's alone. */
export interface Views {
  fit(fromAbove: boolean): void;
  toggleTrails(): void;
}

export class Bar {
  constructor(
    private store: Store,
    private client: Client,
    private past: PastBar,
    file: WorldFile,
    private views: Views,
    private report?: Report,
  ) {
    const button = (id: string, text: string, title: string, act: () => void) =>
      h("button", { id, title, onclick: act, "aria-label": title }, icon(text) || text);
    const speed = h(
      "select",
      {
        id: "speed",
        title: "How fast: simulated seconds for each second (, slower . faster)",
        onchange: () => this.setSpeed(Number(speed.value)),
      },
      ...kSpeeds.map(([text, value]) => h("option", { value: String(value) }, text === "max" ? "max" : `${text}×`)),
    );
    const group = (...children: Node[]) => h("span", { className: "group" }, ...children);
    byId("bar").replaceChildren(
      h("span", { className: "brand" }, "Twinpuck"),
      h("span", { id: "file" }),
      group(
        button("restart", "restart", "Restart from time 0 (Ctrl R)", () => this.restart()),
        button("play", "play", "Play (Space)", () => this.togglePlay()),
        button("step", "step", "One control step (N); with Shift one tick", () => this.step("control")),
        button("step-irq", "irq", "Up to the selected robot's next interrupt (I)", () => this.stepInterrupt()),
        speed,
        h("output", { id: "pace" }),
      ),
      group(
        button("undo", "undo", "Undo (Ctrl Z)", () => client.do("undo")),
        button("redo", "redo", "Redo (Ctrl Y)", () => client.do("redo")),
        button("save", "Save", "Save the world file (Ctrl S)", () => void file.save()),
        worldsMenu(client, file),
        button("save-as", "Save as…", "Save under another name", () => void file.saveAs()),
      ),
      group(
        button("above", "Top", "Seen from above (1)", () => views.fit(true)),
        button("perspective", "3D", "Seen aslant (2)", () => views.fit(false)),
        button("rays", "Rays", "Rays of all proximity sensors (Y)", () => client.toggleRays()),
        button("trails", "Paths", "Paths of the robots (P)", () => this.toggleTrails()),
      ),
      h("span", { className: "space" }),
      h("output", { id: "stopped", className: "bad" }),
      h(
        "button",
        {
          id: "steer",
          hidden: true,
          title: "Another page steers; from then on this one does",
          onclick: () => client.do("steer"),
        },
        "Take the wheel",
      ),
      button("theme", "theme", "Dark or light", () => setTheme(store, !store.dark)),
      button("help", "?", "Keys", () => toggleKeys()),
      foldButton("side"),
    );
    byId("trails").classList.add("on");
    store.on("state", (state) => this.showState(state));
    store.on("world", () => this.showFile());
    store.on("rays", (rays) => byId("rays").classList.toggle("on", rays.size > 0));
    store.on("frame", () => this.showStopped());
    store.on("pulse", () => this.showPace());
  }

  private showFile() {
    const { world, state } = this.store;
    const name = world.file.split("/").pop();
    byId("file").textContent = `${name}${state.saved ? "" : " •"}`;
    document.title = `${world.title || name} – Twinpuck`;
  }
  private showState(state: State) {
    const set = (id: string, on: boolean) => byId(id).toggleAttribute("disabled", !on);
    byId("play").replaceChildren(icon(state.playing ? "pause" : "play"));
    byId("play").title = state.playing ? "Pause (Space)" : "Play (Space)";
    byId("play").setAttribute("aria-label", state.playing ? "Pause" : "Play");
    set("undo", state.undo);
    set("redo", state.redo);
    byId("save").classList.toggle("strong", !state.saved);
    (byId("speed") as HTMLSelectElement).value = String(state.speed);
    byId("steer").hidden = state.steering === this.store.me;
    this.showFile();
  }
  private showStopped() {
    const { frame } = this.store;
    let stopped = 0;
    for (let i = 0; i < frame!.robots; ++i) if (frame!.robotWords[2 * i + 1] & RobotState.Stopped) ++stopped;
    byId("stopped").textContent = stopped ? `${stopped} stopped` : "";
  }
  private showPace() {
    const { frame, live } = this.store;
    if (!frame || !live) return;
    byId("pace").textContent = frame.running
      ? `${frame.pace < 10 ? frame.pace.toFixed(1) : frame.pace.toFixed(0)}×`
      : "";
  }

  // --- what the buttons do

  restart() {
    this.client.do("restart", { play: false });
  }
  step(unit: "control" | "tick") {
    this.client.do("step", { unit });
  }
  togglePlay() {
    const { store } = this;
    if (this.report) return store.state.playing ? this.report.stop() : this.report.play();
    this.past.goToNow();
    return this.client.do(store.state.playing ? "pause" : "play");
  }
  stepInterrupt() {
    const robot = this.store.selectedRobot() ?? this.store.world.robots[0];
    if (robot) this.client.do("step", { unit: "interrupt", robot: robot.name });
  }
  toggleTrails() {
    this.views.toggleTrails();
    byId("trails").classList.toggle("on", this.store.showTrails);
  }
  private setSpeed(value: number) {
    if (this.report) this.report.setSpeed(value);
    else this.client.do("speed", { factor: value === 0 ? "max" : value });
  }
  faster(by: number) {
    const at = kSpeeds.findIndex(([, v]) => v === this.store.state.speed);
    this.setSpeed(kSpeeds[Math.max(0, Math.min(kSpeeds.length - 1, (at < 0 ? 4 : at) + by))][1]);
  }
}

/** `chosen`: by somebody; the system's is followed until then. */
export function setTheme(store: Store, dark: boolean, chosen = true) {
  if (chosen) localStorage.setItem("theme", dark ? "dark" : "light");
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  store.setDark(dark);
}
