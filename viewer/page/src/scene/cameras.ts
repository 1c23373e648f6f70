// SPDX-License-Identifier: MIT
// From where the scene is seen: from above, freely from aslant, or going with a robot, beside it or behind it.
import * as THREE from "three";
import type { Frame } from "../link/protocol";
import type { Scene } from "./scene";

export type Going = "stays" | "goes with" | "goes behind";

const kBehind = 0.42,
  kAbove = 0.24,
  kAhead = 0.08; // m, of the robot's middle
const kTurn = 0.2; // of the way to the robot's heading, each frame

export class Cameras {
  private robot = "";
  private going_: Going = "stays";
  private heading?: number;
  private jumps = false;
  /** Hears that the camera goes otherwise. */
  readonly onChange: (() => void)[] = [];

  constructor(private scene: Scene) {
    scene.afterFrame.push((frame) => this.go(frame));
  }
  get going(): Going {
    return this.going_;
  }
  get followed() {
    return this.going_ === "stays" ? "" : this.robot;
  }
  stay() {
    this.set("stays", "");
  }
  fit(fromAbove: boolean) {
    this.stay();
    this.scene.fit(fromAbove);
  }
  /** With it from now on; said again: no more. */
  follow(robot: string, going: Going) {
    if (this.going_ === going && this.robot === robot) return this.stay();
    this.set(going, robot);
    this.jumps = true;
    const { lastFrame } = this.scene;
    if (lastFrame) {
      this.go(lastFrame);
      this.scene.draw();
    }
  }
  private set(going: Going, robot: string) {
    this.going_ = going;
    this.robot = robot;
    this.heading = undefined;
    for (const hear of this.onChange) hear();
  }
  private go(frame: Frame) {
    if (this.going_ === "stays") return;
    const { scene } = this,
      robot = scene.robots.robots.find((r) => r?.name === this.robot);
    if (!robot || robot.body >= frame.bodies) return;
    const [x, y, , heading] = frame.poses.subarray(4 * robot.body, 4 * robot.body + 4),
      { target } = scene.controls,
      { position } = scene.camera;
    if (this.going_ === "goes behind") {
      const before = this.heading;
      if (before === undefined || this.jumps) {
        this.heading = heading;
        const c = Math.cos(heading),
          s = Math.sin(heading);
        target.set(x + kAhead * c, y + kAhead * s, 0);
        position.set(x - kBehind * c, y - kBehind * s, kAbove);
      } else {
        const by = kTurn * Math.atan2(Math.sin(heading - before), Math.cos(heading - before));
        this.heading = before + by;
        // as people have turned and zoomed it, about the robot
        const offset = position
          .clone()
          .sub(target)
          .applyAxisAngle(new THREE.Vector3(0, 0, 1), by);
        target.set(x + kAhead * Math.cos(this.heading), y + kAhead * Math.sin(this.heading), 0);
        position.copy(target).add(offset);
      }
    } else {
      const by = new THREE.Vector3(x, y, 0).sub(target);
      target.add(by);
      position.add(by);
    }
    this.jumps = false;
    scene.controls.update();
  }
}
