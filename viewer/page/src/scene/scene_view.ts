// SPDX-License-Identifier: MIT
// The scene shows what the store knows.
import { byId, css } from "../dom";
import { notice } from "../frame/notices";
import { readFrame } from "../link/protocol";
import { imageOf } from "../panes/senses";
import type { Client } from "../store/client";
import type { Store } from "../store/store";
import { Scene } from "./scene";

const kMostTrail = 3000; // frames, of the paths in what was seen

export class SceneView {
  readonly scene = new Scene(byId("stage"));
  private floorImage = "";
  private shownAt = Infinity; // the frame of the past that the paths lead to; live ones lead to now

  constructor(
    private store: Store,
    private client: Client,
  ) {
    const { scene } = this;
    store.on("world", ({ first }) => {
      scene.setWorld(store.world, !first);
      void this.takeFloor(store.world.floor.image);
    });
    store.on("frame", ({ frame }) => {
      scene.setFrame(frame);
      if (store.live) this.shownAt = Infinity;
    });
    store.on("jump", (at) => this.pathsUntil(at));
    store.on("look", (look) =>
      scene.setView(store.selectedRobot()?.body ?? -1, store.showView && look?.picture ? look.camera : undefined),
    );
    store.on("forgotten", () => scene.clearTrails());
    store.on("theme", () => scene.setBackground(css("--sky")));
    store.on("follow", (robot) => {
      scene.followed = scene.followed === robot ? "" : robot;
      notice(scene.followed ? `the view goes with ${robot}` : "the view stays");
    });
  }
  toggleTrails() {
    const { scene, store } = this;
    store.showTrails = scene.showTrails = !scene.showTrails;
    if (store.frame) scene.setFrame(store.frame);
  }
  /** The paths are those of then. */
  private pathsUntil(at: number) {
    const { scene, store } = this;
    if (at < this.shownAt) {
      scene.clearTrails();
      this.shownAt = 0;
    }
    for (let i = this.shownAt, by = Math.max(1, (at - i) / kMostTrail); i < at; i += by)
      scene.addToTrails(readFrame(store.past.frames[Math.floor(i)].bytes));
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
