// SPDX-License-Identifier: MIT
// The robots: instances of a few meshes that share one buffer of matrices. Where many are shown, or the drawing has no
// time, a robot is one mesh of few triangles.
import * as THREE from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { RobotState } from "../link/protocol";
import type { Frame, Robot, Vec } from "../link/protocol";
import { soundingMaterial, soundingRing } from "./marks";

const kMany = 150; // more are drawn simply
const kSimpleSides = 12;

const rgb = (c: Vec) => new THREE.Color().setRGB(c[0], c[1], c[2], THREE.SRGBColorSpace);
const upright = (g: THREE.BufferGeometry, z: number) => g.rotateX(Math.PI / 2).translate(0, 0, z);

/** Where a robot looks: an arrow's head, `size` times the usual. */
function nose(r: Robot, z: number, size = 1) {
  const at = (x: number, y: number) => new THREE.Vector2(x * r.radius, y * r.radius * size);
  return new THREE.ShapeGeometry(new THREE.Shape([at(0.72, 0), at(0.1, 0.34), at(0.26, 0), at(0.1, -0.34)])).translate(
    0,
    0,
    z,
  );
}
function inOneColour(g: THREE.BufferGeometry, level: number) {
  const count = g.getAttribute("position").count;
  g.setAttribute("color", new THREE.Float32BufferAttribute(new Float32Array(3 * count).fill(level), 3));
  g.deleteAttribute("uv");
  return g;
}
/** A can in the robot's colour with a dark arrow on top. */
function simpleRobot(r: Robot) {
  const can = upright(new THREE.CylinderGeometry(r.radius, r.radius, r.height, kSimpleSides), r.height / 2 + 0.002);
  return mergeGeometries([
    inOneColour(can.toNonIndexed(), 1),
    inOneColour(nose(r, r.height + 0.003, 1.6).toNonIndexed(), 0.02),
  ]);
}

export class Robots {
  readonly group = new THREE.Group();
  /** By body; some may be in the run and no more in the file. */
  robots: (Robot | undefined)[] = [];
  /** For picking: instance i is of body i. */
  instances: THREE.InstancedMesh[] = [];
  private bodies?: THREE.InstancedMesh;
  private leds?: THREE.InstancedMesh;
  private halo?: THREE.InstancedMesh;
  private sounding?: THREE.InstancedMesh;
  private turrets?: THREE.InstancedMesh;
  private turretOf: number[] = []; // bodies of robots that carry a part
  private simple = false;
  private readonly colour = new THREE.Color();

  get isSimple() {
    return this.simple;
  }
  /** `details`: as far as there are not too many. */
  set(robots: (Robot | undefined)[], details: boolean) {
    this.robots = robots;
    this.group.traverse((o) => {
      if (!(o instanceof THREE.InstancedMesh)) return;
      o.geometry.dispose();
      (o.material as THREE.Material).dispose();
    });
    this.group.clear();
    this.instances = [];
    this.leds = this.halo = this.bodies = this.sounding = this.turrets = undefined;
    this.turretOf = robots.flatMap((r) => (r?.parts.length ? [r.body] : []));
    const r = robots.find((robot) => robot),
      n = robots.length;
    this.simple = !details || n > kMany;
    if (!r) return;
    const shell = this.simple
      ? this.all(simpleRobot(r), new THREE.MeshLambertMaterial({ vertexColors: true }), false)
      : this.addDetails(r);
    robots.forEach((robot, i) => {
      if (robot) shell.setColorAt(i, rgb(robot.colour));
    });
    const most = n * Math.max(1, r.leds.length);
    const lamps = (radius: number, opacity: number) =>
      this.some(
        this.simple ? new THREE.OctahedronGeometry(1.5 * radius) : new THREE.SphereGeometry(radius, 12, 8),
        new THREE.MeshBasicMaterial({ transparent: opacity < 1, opacity, depthWrite: opacity === 1 }),
        most,
      );
    this.leds = lamps(0.0045, 1);
    if (!this.simple) this.halo = lamps(0.011, 0.35);
    this.sounding = this.some(soundingRing(), soundingMaterial(), n);
    // on top, and not wider than the robot
    this.turrets = this.some(
      upright(
        new THREE.CylinderGeometry(r.radius * 0.86, r.radius * 0.86, 0.012, this.simple ? kSimpleSides : 32, 1, true),
        r.height + 0.004,
      ),
      new THREE.MeshStandardMaterial({ color: 0x0b6b4f, roughness: 0.5, side: THREE.DoubleSide }),
      Math.max(1, this.turretOf.length),
    );
  }
  private all(geometry: THREE.BufferGeometry, material: THREE.Material, shadow: boolean) {
    const mesh = new THREE.InstancedMesh(geometry, material, this.robots.length);
    if (this.bodies) mesh.instanceMatrix = this.bodies.instanceMatrix;
    else this.bodies = mesh;
    mesh.castShadow = shadow;
    mesh.frustumCulled = false;
    this.instances.push(mesh);
    this.group.add(mesh);
    return mesh;
  }
  private some(geometry: THREE.BufferGeometry, material: THREE.Material, most: number) {
    const mesh = new THREE.InstancedMesh(geometry, material, most);
    mesh.count = 0;
    mesh.visible = false;
    mesh.frustumCulled = false;
    this.group.add(mesh);
    return mesh;
  }
  private addDetails(r: Robot) {
    const standard = (colour: number, roughness: number) =>
      new THREE.MeshStandardMaterial({ color: colour, roughness });
    const shell = this.all(
      upright(new THREE.CylinderGeometry(r.radius * 0.94, r.radius * 0.94, r.height * 0.5, 40), r.height * 0.32),
      new THREE.MeshStandardMaterial({ roughness: 0.35, transparent: true, opacity: 0.85 }),
      true,
    );
    this.all(
      upright(new THREE.CylinderGeometry(r.radius, r.radius, 0.003, 40), r.height * 0.62),
      standard(0x23282e, 0.6),
      true,
    );
    this.all(
      upright(new THREE.CylinderGeometry(r.radius * 0.8, r.radius * 0.86, r.height * 0.3, 32), r.height * 0.82),
      standard(0x3b424b, 0.5),
      true,
    );
    for (const side of [1, -1])
      this.all(
        new THREE.CylinderGeometry(r.wheel_radius, r.wheel_radius, 0.004, 32).translate(
          0,
          (side * r.axle) / 2,
          r.wheel_radius,
        ),
        standard(0x111417, 0.9),
        true,
      );
    this.all(nose(r, r.height * 0.975), new THREE.MeshBasicMaterial({ color: 0xffffff }), false);
    return shell;
  }

  /** Where that frame says, with the LEDs that shine then. */
  place(frame: Frame) {
    const p = frame.poses,
      n = Math.min(frame.robots, this.robots.length),
      matrices = this.bodies?.instanceMatrix.array as Float32Array | undefined;
    if (!matrices) return;
    const { leds, halo, sounding, turrets } = this;
    let lit = 0,
      loud = 0;
    for (let i = 0; i < n; ++i) {
      const robot = this.robots[i];
      if (!robot) {
        matrices.fill(0, 16 * i, 16 * i + 16);
        continue;
      }
      const x = p[4 * i],
        y = p[4 * i + 1],
        z = p[4 * i + 2],
        c = Math.cos(p[4 * i + 3]),
        s = Math.sin(p[4 * i + 3]);
      matrices.set([c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, x, y, z, 1], 16 * i);
      if (frame.robotWords[2 * i + 1] & RobotState.Sounding)
        (sounding!.instanceMatrix.array as Float32Array).set(matrices.subarray(16 * i, 16 * i + 16), 16 * loud++);
      for (let bits = frame.robotWords[2 * i], bit = 0; bits !== 0; bits >>>= 1, ++bit) {
        const led = robot.leds[bit];
        if (!(bits & 1) || !led) continue;
        const lx = x + c * led[0] - s * led[1],
          ly = y + s * led[0] + c * led[1],
          lz = z + Math.max(led[2], robot.height * (this.simple ? 1.1 : 0.62));
        const m = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, lx, ly, lz, 1];
        this.colour.setRGB(led[3], led[4], led[5]);
        for (const mesh of [leds, halo]) {
          (mesh?.instanceMatrix.array as Float32Array | undefined)?.set(m, 16 * lit);
          mesh?.setColorAt(lit, this.colour);
        }
        ++lit;
      }
    }
    this.bodies!.instanceMatrix.needsUpdate = true;
    for (const mesh of [leds, halo]) this.show(mesh, lit);
    this.show(sounding, loud);
    this.turretOf.forEach((body, i) =>
      (turrets!.instanceMatrix.array as Float32Array).set(matrices.subarray(16 * body, 16 * body + 16), 16 * i),
    );
    this.show(turrets, this.turretOf.length);
  }
  private show(mesh: THREE.InstancedMesh | undefined, count: number) {
    if (!mesh) return;
    mesh.count = count;
    mesh.visible = count > 0;
    for (const attribute of [mesh.instanceMatrix, mesh.instanceColor])
      if (attribute && count) {
        attribute.clearUpdateRanges();
        attribute.addUpdateRange(0, attribute.itemSize * count);
        attribute.needsUpdate = true;
      }
  }
  /** Instances' bounds are for picking, and change with every frame. */
  beforePicking() {
    for (const mesh of this.instances) mesh.boundingSphere = null;
  }
}
