// SPDX-License-Identifier: MIT
// The world in three dimensions. Metres, z up. Nothing is drawn unless something changed; how much is drawn
// goes by what it takes (quality.ts).
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { ghost } from "./ghosts";
import { frustum, lightMarks, soundMarks } from "./marks";
import type { CameraView } from "./marks";
import type { Frame, Robot, Thing, Vec, World } from "../link/protocol";
import { Canvas } from "./canvas";
import { Paths } from "./paths";
import { Robots } from "./robots";
import { bordersOf } from "./track";

export interface Picked {
  kind: "robot" | "thing" | "handle" | "floor";
  id: number;
  point: THREE.Vector3;
  handle?: Handle;
}
/** Something to pull: `drag` gets the place on the floor. */
export interface Handle {
  x: number;
  y: number;
  z: number;
  title: string;
  drag: (x: number, y: number) => void;
}

const rgb = (c: Vec) => new THREE.Color().setRGB(c[0], c[1], c[2], THREE.SRGBColorSpace);

export class Scene {
  readonly canvas = new Canvas();
  readonly renderer = this.canvas.renderer;
  readonly robots = new Robots();
  readonly paths = new Paths();
  private scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(30, 1, 0.01, 200);
  readonly controls: OrbitControls;
  private static_ = new THREE.Group();
  private handles = new THREE.Group();
  private outline = new THREE.Group();
  private moving: { object: THREE.Object3D; body: number }[] = [];
  private things = new Map<number, THREE.Object3D>();
  private view = new THREE.Group(); // what a camera sees
  private viewBody = -1;
  private viewOf = "";
  private floor?: THREE.Texture;
  private rays = new THREE.LineSegments(
    new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({ vertexColors: true, transparent: true, opacity: 0.9 }),
  );
  private sun = new THREE.DirectionalLight(0xffffff, 1.1);
  private compiling = true; // the first world's shaders, beside the script
  private world?: World;
  private selected: readonly number[] = [];
  private last?: Frame;
  showTrails = true;
  /** What else is in the picture: the ruler. */
  readonly extras = new THREE.Group();
  /** Hears that a frame has been placed; cameras go with robots. */
  readonly afterFrame: ((frame: Frame) => void)[] = [];
  /** Hears that a picture has been drawn. */
  readonly afterDrawing: (() => void)[] = [];

  constructor(private stage: HTMLElement) {
    stage.prepend(this.renderer.domElement);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.mouseButtons = { LEFT: THREE.MOUSE.PAN, MIDDLE: THREE.MOUSE.PAN, RIGHT: THREE.MOUSE.ROTATE };
    this.controls.maxPolarAngle = Math.PI * 0.49;
    this.controls.screenSpacePanning = false;
    this.controls.addEventListener("change", () => this.draw());
    this.scene.add(
      new THREE.HemisphereLight(0xffffff, 0xb8bcc4, 2.3),
      this.sun,
      this.static_,
      this.handles,
      this.outline,
      this.rays,
      this.view,
      this.robots.group,
      this.paths.lines,
      this.extras,
    );
    this.rays.frustumCulled = false;
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.radius = 3;
    this.canvas.begin(
      (quality) => this.takeQuality(quality),
      () => this.paint(),
    );
    new ResizeObserver(() => this.resize()).observe(stage);
  }

  draw() {
    this.canvas.dirty = true;
  }
  /** Off: everything but the drawing itself, for measurements. */
  setDrawing(on: boolean) {
    this.canvas.drawing = on;
  }
  /** At once, whatever it takes. */
  drawNow() {
    this.canvas.draw();
  }
  private paint() {
    if (this.compiling) return false;
    this.paths.flush();
    this.canvas.render(this.scene, this.camera);
    document.getElementById("plan")?.remove();
    for (const hear of this.afterDrawing) hear();
    return true;
  }
  /** What is drawn from now on. */
  private takeQuality({ shadows, details }: { shadows: boolean; details: boolean }) {
    this.sun.castShadow = shadows;
    const was = this.robots.isSimple;
    if (was !== !details && this.world) {
      this.robots.set(this.robots.robots, details);
      if (this.last) this.robots.place(this.last);
    }
    this.resize();
  }
  setBackground(colour: string) {
    this.scene.background = new THREE.Color(colour);
    this.draw();
  }
  private resize() {
    const { clientWidth: w, clientHeight: h } = this.stage;
    if (!w || !h) return;
    this.canvas.setSize(w, h);
    this.camera.aspect = w / h;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  // --- the world

  setWorld(world: World, keepCamera: boolean) {
    this.world = world;
    for (const group of [this.static_, this.outline]) this.empty(group);
    this.things.clear();
    this.moving = [];
    this.addFloor(world);
    for (const thing of world.things) this.addThing(thing);
    const placed: Robot[] = []; // by body; some may be in the run and no more in the file
    for (const robot of world.robots) {
      if (robot.body >= 0) placed[robot.body] = robot;
      else this.static_.add(ghost(robot, world.problems.find((p) => p.id === robot.id)?.text ?? ""));
    }
    this.robots.set(placed, this.canvas.quality.details);
    this.paths.borders = bordersOf(world);
    this.paths.setRobots(placed);
    if (!keepCamera) this.fit(true);
    const size = Math.max(1, this.extent().size);
    this.sun.position.set(0.4 * size, -0.6 * size, 1.5 * size);
    Object.assign(this.sun.shadow.camera, { left: -size, right: size, top: size, bottom: -size, far: 4 * size });
    this.sun.shadow.camera.updateProjectionMatrix();
    this.select(this.selected);
    if (this.last) this.setFrame(this.last);
    if (!keepCamera) this.renderer.compileAsync(this.scene, this.camera).finally(() => (this.compiling = false));
    this.draw();
  }

  private empty(group: THREE.Object3D) {
    group.traverse((o) => {
      if (!(o instanceof THREE.Mesh || o instanceof THREE.Line)) return;
      o.geometry.dispose();
      for (const m of [o.material].flat()) m.dispose();
    });
    group.clear();
  }

  extent() {
    const w = this.world;
    if (w?.arena) return { x: w.arena.centre[0], y: w.arena.centre[1], size: Math.max(...w.arena.size) };
    const box = new THREE.Box3();
    for (const t of w?.things ?? [])
      for (const p of t.points ?? [t.position]) box.expandByPoint(new THREE.Vector3(p[0], p[1], 0));
    for (const r of w?.robots ?? []) box.expandByPoint(new THREE.Vector3(r.position[0], r.position[1], 0));
    if (box.isEmpty()) box.setFromCenterAndSize(new THREE.Vector3(), new THREE.Vector3(1, 1, 0));
    const c = box.getCenter(new THREE.Vector3()),
      s = box.getSize(new THREE.Vector3());
    return { x: c.x, y: c.y, size: Math.max(s.x, s.y, 0.6) + 0.4 };
  }

  private mesh(geometry: THREE.BufferGeometry, colour: Vec, rough = 0.75) {
    const mesh = new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({ color: rgb(colour), roughness: rough }));
    mesh.castShadow = mesh.receiveShadow = true;
    return mesh;
  }

  private addFloor(world: World) {
    const e = this.extent();
    const [w, h] = world.arena ? world.arena.size : [3 * e.size, 3 * e.size];
    const drawn = world.floor.image ? this.floor : undefined;
    const floor = this.mesh(new THREE.PlaneGeometry(w, h), drawn ? [1, 1, 1] : world.floor.colour, 0.95);
    if (drawn) (floor.material as THREE.MeshStandardMaterial).map = drawn;
    floor.castShadow = false;
    floor.position.set(e.x, e.y, 0);
    this.static_.add(floor);
    // a grid of 10 cm, fainter than what matters
    const lines: number[] = [];
    for (let x = Math.ceil((e.x - w / 2) * 10 + 1e-6); x < (e.x + w / 2) * 10; ++x)
      lines.push(x / 10, e.y - h / 2, 0.0006, x / 10, e.y + h / 2, 0.0006);
    for (let y = Math.ceil((e.y - h / 2) * 10 + 1e-6); y < (e.y + h / 2) * 10; ++y)
      lines.push(e.x - w / 2, y / 10, 0.0006, e.x + w / 2, y / 10, 0.0006);
    const grid = new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(lines, 3));
    this.static_.add(
      new THREE.LineSegments(grid, new THREE.LineBasicMaterial({ color: 0x808890, transparent: true, opacity: 0.28 })),
    );
    const a = world.arena;
    if (!a || a.wall_height <= 0) return;
    const t = a.wall_thickness,
      [sx, sy] = a.size;
    for (const [x, y, lx, ly] of [
      [0, (sy + t) / 2, sx + 2 * t, t],
      [0, -(sy + t) / 2, sx + 2 * t, t],
      [(sx + t) / 2, 0, t, sy],
      [-(sx + t) / 2, 0, t, sy],
    ]) {
      const wall = this.mesh(new THREE.BoxGeometry(lx, ly, a.wall_height), a.colour);
      wall.position.set(e.x + x, e.y + y, a.wall_height / 2);
      wall.userData.id = a.id;
      this.static_.add(wall);
    }
  }

  private addThing(t: Thing) {
    const group = new THREE.Group();
    const z = t.z ?? 0;
    const put = (mesh: THREE.Mesh, x: number, y: number, h: number, turn = 0) => {
      mesh.position.set(x, y, h);
      mesh.rotation.z = turn;
      group.add(mesh);
    };
    if (t.kind === "wall") {
      const p = t.points!,
        count = t.closed ? p.length : p.length - 1;
      for (let i = 0; i < count; ++i) {
        const a = p[i],
          b = p[(i + 1) % p.length],
          l = Math.hypot(b[0] - a[0], b[1] - a[1]);
        put(
          this.mesh(new THREE.BoxGeometry(l + t.thickness!, t.thickness!, t.height!), t.colour),
          (a[0] + b[0]) / 2,
          (a[1] + b[1]) / 2,
          z + t.height! / 2,
          Math.atan2(b[1] - a[1], b[0] - a[0]),
        );
      }
    } else if (t.kind === "lamp") {
      const bulb = this.mesh(new THREE.SphereGeometry(0.02, 24, 16), t.colour);
      const m = bulb.material as THREE.MeshStandardMaterial;
      m.emissive = rgb(t.colour);
      m.emissiveIntensity = t.on ? 1 : 0;
      bulb.castShadow = false;
      put(bulb, 0, 0, Math.max(0.02, t.position[2]));
      for (const mark of lightMarks(t)) group.add(mark);
    } else if (t.kind === "sound") {
      put(this.mesh(new THREE.BoxGeometry(0.03, 0.03, 0.03), t.colour), 0, 0, Math.max(0.015, t.position[2]));
      for (const mark of soundMarks(t, 2 * this.extent().size)) group.add(mark);
    } else if (t.kind === "ramp") {
      const [lx, ly] = t.size!,
        low = t.low!,
        high = Math.max(t.high!, 0.001);
      const shape = new THREE.Shape(
        [
          [-lx / 2, 0],
          [lx / 2, 0],
          [lx / 2, high],
          [-lx / 2, Math.max(low, 0.0005)],
        ].map((p) => new THREE.Vector2(p[0], p[1])),
      );
      const g = new THREE.ExtrudeGeometry(shape, { depth: ly, bevelEnabled: false })
        .translate(0, 0, -ly / 2)
        .rotateX(Math.PI / 2);
      put(this.mesh(g, t.colour), 0, 0, 0);
    } else if (t.kind === "box") {
      put(this.mesh(new THREE.BoxGeometry(t.size![0], t.size![1], t.size![2]), t.colour), 0, 0, t.size![2] / 2);
    } else if (t.kind === "cylinder") {
      put(
        this.mesh(new THREE.CylinderGeometry(t.radius, t.radius, t.size![2], 48).rotateX(Math.PI / 2), t.colour),
        0,
        0,
        t.size![2] / 2,
      );
    } else if (t.kind === "ball") {
      put(this.mesh(new THREE.SphereGeometry(t.radius, 32, 24), t.colour, 0.35), 0, 0, t.radius!);
    } else {
      const shape = new THREE.Shape((t.corners ?? []).map((c) => new THREE.Vector2(c[0], c[1])));
      put(this.mesh(new THREE.ExtrudeGeometry(shape, { depth: t.size![2], bevelEnabled: false }), t.colour), 0, 0, 0);
    }
    if (t.kind !== "wall") {
      group.position.set(t.position[0], t.position[1], t.kind === "lamp" || t.kind === "sound" ? 0 : z);
      group.rotation.z = t.heading ?? 0;
    }
    group.userData.id = t.id;
    if (t.body !== undefined && t.body >= 0) this.moving.push({ object: group, body: t.body });
    this.things.set(t.id, group);
    this.static_.add(group);
  }

  // --- frames

  get lastFrame() {
    return this.last;
  }
  /** `travelled`: m, by body, where somebody has asked the odometers. */
  setFrame(frame: Frame, travelled?: readonly (number | undefined)[]) {
    const isNew = frame !== this.last;
    this.last = frame;
    const world = this.world;
    if (!world) return;
    const p = frame.poses;
    this.robots.place(frame);
    if (isNew) this.addToPaths(frame, travelled);
    this.paths.lines.visible = this.showTrails;
    this.placeView();
    for (const { object, body } of this.moving)
      if (body < frame.bodies) {
        object.position.set(p[4 * body], p[4 * body + 1], p[4 * body + 2]);
        object.rotation.z = p[4 * body + 3];
      }
    this.setRays(frame.rays);
    for (const hear of this.afterFrame) hear(frame);
    this.placeOutline();
    this.draw();
  }

  /** What a robot's camera sees, as a pyramid; no camera: none. */
  setView(body: number, camera?: CameraView) {
    this.viewBody = camera ? body : -1;
    const of = camera ? JSON.stringify(camera) : "";
    if (of !== this.viewOf) {
      this.viewOf = of;
      this.empty(this.view);
      if (camera) this.view.add(frustum(camera));
    }
    this.placeView();
    this.draw();
  }
  private placeView() {
    const p = this.last?.poses,
      b = this.viewBody;
    this.view.visible = b >= 0 && !!p && 4 * b < p.length;
    if (!this.view.visible) return;
    this.view.position.set(p![4 * b], p![4 * b + 1], p![4 * b + 2]);
    this.view.rotation.z = p![4 * b + 3];
  }
  /** The picture on the floor, once it has come. */
  setFloor(image?: ImageData) {
    this.floor?.dispose();
    this.floor = undefined;
    if (image) {
      const canvas = document.createElement("canvas");
      canvas.width = image.width;
      canvas.height = image.height;
      canvas.getContext("2d")!.putImageData(image, 0, 0);
      this.floor = new THREE.CanvasTexture(canvas);
      this.floor.colorSpace = THREE.SRGBColorSpace;
      this.floor.anisotropy = 4;
    }
    if (this.world) this.setWorld(this.world, true);
  }

  private setRays(rays: Float32Array) {
    const n = rays.length / 7,
      at = new Float32Array(6 * n),
      colours = new Float32Array(6 * n);
    for (let i = 0; i < n; ++i) {
      at.set(rays.subarray(7 * i, 7 * i + 6), 6 * i);
      // free rays blue, those that meet something orange, darker the less comes back
      const f = rays[7 * i + 6],
        c = f < 0 ? [0.0, 0.32, 0.6] : [0.84 * (0.3 + 0.7 * f), 0.37 * (0.3 + 0.7 * f), 0];
      colours.set([...c, ...c], 6 * i);
    }
    const g = this.rays.geometry;
    g.setAttribute("position", new THREE.BufferAttribute(at, 3));
    g.setAttribute("color", new THREE.BufferAttribute(colours, 3));
    this.rays.visible = n > 0;
  }

  /** Where the robots were, without showing them there. */
  addToPaths(frame: Frame, travelled?: readonly (number | undefined)[]) {
    const p = frame.poses;
    for (let i = 0; i < Math.min(frame.robots, this.robots.robots.length); ++i)
      if (this.robots.robots[i]) this.paths.add(i, p[4 * i], p[4 * i + 1], p[4 * i + 3], frame.time, travelled?.[i]);
  }
  clearPaths() {
    this.paths.clear();
    this.draw();
  }

  // --- camera

  fit(fromAbove: boolean) {
    const e = this.extent();
    const tan = Math.tan((this.camera.fov * Math.PI) / 360);
    const d = (0.56 * e.size) / tan / Math.min(1, this.camera.aspect * 0.98);
    this.controls.target.set(e.x, e.y, 0);
    this.camera.position.set(e.x, e.y - (fromAbove ? 0.002 * d : 0.62 * d), fromAbove ? d : 0.62 * d);
    this.controls.update();
    this.draw();
  }
  /** Where a place of the world is on the stage, px. */
  project(x: number, y: number, z = 0) {
    const v = new THREE.Vector3(x, y, z).project(this.camera),
      box = this.renderer.domElement.getBoundingClientRect();
    return { x: box.left + ((v.x + 1) / 2) * box.width, y: box.top + ((1 - v.y) / 2) * box.height };
  }

  // --- pointing

  private ray(event: { clientX: number; clientY: number }) {
    const box = this.renderer.domElement.getBoundingClientRect();
    const caster = new THREE.Raycaster();
    caster.setFromCamera(
      new THREE.Vector2(
        ((event.clientX - box.left) / box.width) * 2 - 1,
        1 - ((event.clientY - box.top) / box.height) * 2,
      ),
      this.camera,
    );
    return caster;
  }
  floorPoint(event: { clientX: number; clientY: number }) {
    return this.ray(event).ray.intersectPlane(new THREE.Plane(new THREE.Vector3(0, 0, 1), 0), new THREE.Vector3());
  }
  pick(event: { clientX: number; clientY: number }): Picked | undefined {
    const caster = this.ray(event);
    const floor = this.floorPoint(event) ?? new THREE.Vector3();
    const handle = caster.intersectObjects(this.handles.children)[0];
    if (handle)
      return {
        kind: "handle",
        id: handle.object.userData.id ?? 0,
        point: floor,
        handle: handle.object.userData.handle,
      };
    const hit = caster
      .intersectObjects([this.static_, ...this.robots.instances], true)
      .find((h) => h.instanceId !== undefined || this.idOf(h.object) > 0);
    if (!hit) return { kind: "floor", id: 0, point: floor };
    if (hit.instanceId !== undefined)
      return { kind: "robot", id: this.robots.robots[hit.instanceId]?.id ?? 0, point: floor };
    return { kind: "thing", id: this.idOf(hit.object), point: floor };
  }
  private idOf(object: THREE.Object3D | null): number {
    for (; object; object = object.parent) if (object.userData.id) return object.userData.id;
    return 0;
  }

  beforePicking() {
    this.robots.beforePicking();
  }

  // --- selection

  select(ids: readonly number[], handles: Handle[] = []) {
    this.selected = ids;
    this.empty(this.outline);
    this.empty(this.handles);
    const colour = 0xe69f00;
    for (const id of ids) {
      const thing = this.things.get(id),
        robot = this.world?.robots.find((r) => r.id === id),
        around = new THREE.Group();
      around.userData.of = id;
      this.outline.add(around);
      if (robot) {
        around.add(
          new THREE.Mesh(
            new THREE.RingGeometry(robot.radius * 1.12, robot.radius * 1.3, 48),
            new THREE.MeshBasicMaterial({ color: colour, depthTest: false, transparent: true }),
          ),
        );
      } else if (thing) {
        thing.updateMatrixWorld();
        thing.traverse((o) => {
          if (!(o instanceof THREE.Mesh) || o.material.transparent) return;
          const edges = new THREE.LineSegments(
            new THREE.EdgesGeometry(o.geometry, 30),
            new THREE.LineBasicMaterial({ color: colour, depthTest: false }),
          );
          edges.applyMatrix4(new THREE.Matrix4().copy(thing.matrixWorld).invert().multiply(o.matrixWorld));
          around.add(edges);
        });
      }
    }
    for (const h of handles) {
      const ball = new THREE.Mesh(
        new THREE.SphereGeometry(0.011, 16, 12),
        new THREE.MeshBasicMaterial({ color: colour, depthTest: false, transparent: true }),
      );
      ball.position.set(h.x, h.y, h.z);
      ball.renderOrder = 5;
      ball.userData.handle = h;
      this.handles.add(ball);
    }
    this.placeOutline();
    this.draw();
  }
  private placeOutline() {
    for (const around of this.outline.children) {
      const robot = this.world?.robots.find((r) => r.id === around.userData.of),
        thing = this.things.get(around.userData.of),
        poses = this.last?.poses;
      if (robot && poses && robot.body >= 0 && robot.body < this.last!.bodies)
        around.position.set(poses[4 * robot.body], poses[4 * robot.body + 1], 0.003);
      else if (robot) around.position.set(robot.position[0], robot.position[1], 0.003);
      else if (thing) {
        around.position.copy(thing.position);
        around.rotation.copy(thing.rotation);
      }
    }
  }
}
