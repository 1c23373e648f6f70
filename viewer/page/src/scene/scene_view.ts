// SPDX-License-Identifier: MIT
// The scene shows what the store knows.
import { byId, css } from "../dom";
import { notice } from "../frame/notices";
import { readFrame } from "../link/protocol";
import type { Frame } from "../link/protocol";
import { imageOf } from "../panes/senses";
import type { Client } from "../store/client";
import type { Store } from "../store/store";
import { Cameras } from "./cameras";
import { Ruler } from "./ruler";
import { Scene } from "./scene";

const kMostTrail = 4000; // frames, of the paths in what was seen
const kMostAsked = 32; // robots, whose odometers say how far they went between two frames

export class SceneView {
  readonly scene = new Scene(byId("stage"));
  readonly cameras = new Cameras(this.scene);
  readonly ruler: Ruler;
  private floorImage = "";
  private shownAt = Infinity; // the frame of the past that the paths lead to; live ones lead to now
  private odometers = new Map<number, number[]>(); // of a subscription, by body

  constructor(
    private store: Store,
    private client: Client,
  ) {
    const { scene } = this;
    this.ruler = new Ruler(store, scene);
    store.wanted.push(() =>
      store.names.includes("distance") && store.world.robots.length <= kMostAsked
        ? store.world.robots.filter((r) => r.body >= 0).map((r) => `${r.name}.distance`)
        : [],
    );
    store.on("world", ({ first }) => {
      this.odometers.clear();
      scene.setWorld(store.world, !first);
      void this.takeFloor(store.world.floor.image);
    });
    store.on("frame", ({ frame }) => {
      scene.setFrame(frame, this.travelled(frame));
      if (store.live) this.shownAt = Infinity;
    });
    store.on("jump", (at) => this.pathsUntil(at));
    store.on("look", (look) =>
      scene.setView(store.selectedRobot()?.body ?? -1, store.showView && look?.picture ? look.camera : undefined),
    );
    store.on("forgotten", () => scene.clearPaths());
    store.on("theme", () => scene.setBackground(css("--sky")));
    store.on("follow", (robot) => this.follow(robot, "goes with"));
  }
  follow(robot: string, going: "goes with" | "goes behind") {
    this.cameras.follow(robot, going);
    notice(this.cameras.going === "stays" ? "the view stays" : `the view ${this.cameras.going} ${robot}`);
  }
  toggleTrails() {
    const { scene, store } = this;
    store.showTrails = scene.showTrails = !scene.showTrails;
    if (store.frame) scene.setFrame(store.frame);
  }
  /** How far robots have gone, m, by body; undefined: nobody asked. */
  private travelled(frame: Frame): (number | undefined)[] | undefined {
    const { store } = this;
    let at = this.odometers.get(frame.subscription);
    if (!at) {
      const names = store.past.names.get(frame.subscription);
      if (!names) return undefined;
      at = [];
      for (const r of store.world.robots) if (r.body >= 0) at[r.body] = names.indexOf(`${r.name}.distance`);
      this.odometers.set(frame.subscription, at);
    }
    return at.map((i) => (i >= 0 ? frame.values[i] : undefined));
  }
  /** The paths are those of then. */
  private pathsUntil(at: number) {
    const { scene, store } = this;
    if (at < this.shownAt) {
      scene.clearPaths();
      this.shownAt = 0;
    }
    for (let i = this.shownAt, by = Math.max(1, (at - i) / kMostTrail); i < at; i += by) {
      const frame = readFrame(store.past.frames[Math.floor(i)].bytes);
      scene.addToPaths(frame, this.travelled(frame));
    }
    this.shownAt = at;
  }
  private async takeFloor(image: string) {
    if (image === this.floorImage) return;
    this.floorImage = image;
    try {
      const floor = image ? await this.client.ask("floor") : undefined;
      if (image === this.floorImage) this.scene.setFloor(floor && imageOf(floor.width, floor.height, floor.rgb));
    } catch {
      /* the colour will do */
    }
  }
}
