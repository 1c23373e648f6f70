// SPDX-License-Identifier: MIT
// The hand in the scene: the palette's tools, dragging, handles that turn and stretch. What is dragged is an
// edit of the world file as it goes, and one step of undo; a robot or a loose thing of a run that has begun is
// moved where it is, and the file stays.
import { byId, h, icon } from "../dom";
import type { Vec } from "../link/protocol";
import type { Client } from "../store/client";
import type { Piece, Pieces } from "../store/pieces";
import type { Store } from "../store/store";
import type { Handle, Scene } from "./scene";

const kSnap = 0.01; // m
const kSnapAngle = Math.PI / 36;
const kClick = 3; // px: what moves no farther is one
const kSendEvery = 33; // ms between two edits of one drag
const kTools: [string, string, string, string][] = [
  ["select", "select", "Select and drag", "V"],
  ["wall", "wall", "Wall: drag from end to end", "W"],
  ["box", "box", "Box", "B"],
  ["cylinder", "cylinder", "Cylinder", "C"],
  ["ball", "ball", "Ball, movable", "O"],
  ["lamp", "lamp", "Lamp", "L"],
  ["robot", "robot", "Robot", "R"],
  ["black", "", "Paint black", ""],
  ["white", "", "Paint white", ""],
  ["red", "", "Paint red", ""],
  ["blue", "", "Paint blue", ""],
];
const kPaint: Record<string, Vec> = {
  black: [0, 0, 0],
  white: [1, 1, 1],
  red: [0.85, 0.1, 0.1],
  blue: [0.1, 0.3, 0.8],
};

export class Touch {
  tool = "select";
  private pull?: (event: PointerEvent) => void;
  private clicked?: () => void;
  private ended?: () => void;
  private began = { x: 0, y: 0, moved: false };
  private sent = 0;
  private later = 0;

  constructor(
    private store: Store,
    private client: Client,
    private pieces: Pieces,
    private scene: Scene,
  ) {
    byId("palette").replaceChildren(
      ...kTools.map(([tool, sign, title, key]) =>
        h(
          "button",
          {
            id: `tool-${tool}`,
            title: key ? `${title} (${key})` : title,
            "aria-label": title,
            onclick: (e: MouseEvent) => {
              this.choose(tool);
              if (e.detail === 0) this.useByKey();
            },
            className: kPaint[tool] ? `paint ${tool}` : "",
          },
          icon(sign),
        ),
      ),
    );
    this.choose("select");
    const outline = () => scene.select(store.selection, this.handles());
    store.on("selection", outline);
    store.on("frame", ({ began }) => {
      if (began) outline();
    });
    const canvas = scene.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
    canvas.setAttribute(
      "aria-label",
      "Scene. Arrows move what is selected, Q and E turn it, Delete removes it; the list of pieces selects",
    );
    canvas.addEventListener("pointerdown", (e) => this.down(e), { capture: true });
    canvas.addEventListener("pointermove", (e) => this.moved(e));
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (e) => this.up(e as PointerEvent));
  }

  choose(tool: string) {
    this.tool = tool;
    for (const b of byId("palette").children) {
      b.classList.toggle("on", b.id === `tool-${tool}`);
      b.setAttribute("aria-pressed", String(b.id === `tool-${tool}`));
    }
  }

  /** The keyboard has pressed the tool's button: a piece in the middle of the view, or paint for what is selected. */
  private useByKey() {
    const { tool, pieces, scene } = this;
    if (tool === "select") return;
    ++pieces.group;
    if (kPaint[tool]) {
      pieces.paint(kPaint[tool]);
      return this.choose("select");
    }
    const { x, y } = scene.controls.target,
      at = [Math.round(x / kSnap) * kSnap, Math.round(y / kSnap) * kSnap];
    this.add(at[0], at[1], true);
  }

  private throttle(act: () => void) {
    clearTimeout(this.later);
    const wait = this.sent + kSendEvery - performance.now();
    const now = () => {
      this.sent = performance.now();
      act();
    };
    if (wait <= 0) now();
    else this.later = window.setTimeout(now, wait);
  }

  private hover(e: PointerEvent) {
    if (e.buttons) return;
    this.scene.beforePicking();
    const hit = this.scene.pick(e);
    this.scene.renderer.domElement.style.cursor =
      this.tool !== "select" ? "crosshair" : hit && hit.kind !== "floor" ? "pointer" : "default";
    this.scene.renderer.domElement.title = hit?.kind === "handle" ? hit.handle!.title : "";
  }

  private snap(v: number, e: { shiftKey: boolean }) {
    return e.shiftKey ? Math.round(v * 1e4) / 1e4 : Math.round(v / kSnap) * kSnap;
  }

  private down(e: PointerEvent) {
    const { store, pieces } = this;
    if (e.button !== 0) return;
    this.scene.beforePicking();
    const hit = this.scene.pick(e),
      at = this.scene.floorPoint(e);
    if (!hit || !at) return;
    const take = () => {
      e.stopImmediatePropagation();
      (e.target as HTMLElement).setPointerCapture(e.pointerId);
      ++pieces.group;
    };
    const more = e.shiftKey || e.ctrlKey || e.metaKey;
    this.began = { x: e.clientX, y: e.clientY, moved: false };
    if (kPaint[this.tool]) {
      take();
      if (!hit.id) return;
      if (!store.selection.includes(hit.id)) store.select(hit.id);
      if (store.piece(hit.id)) pieces.paint(kPaint[this.tool]);
      else this.client.set(hit.id, { colour: kPaint[this.tool] }); // the arena's own walls
    } else if (this.tool !== "select") {
      take();
      this.add(this.snap(at.x, e), this.snap(at.y, e));
    } else if (hit.kind === "handle") {
      take();
      const handle = hit.handle!;
      this.pull = (m) => {
        const p = this.scene.floorPoint(m);
        if (p) handle.drag(this.snap(p.x, m), this.snap(p.y, m));
      };
    } else if (hit.kind === "floor") {
      if (!more) return store.select(0); // and the view moves
      take();
      this.pullBand();
    } else {
      take();
      this.pullPieces(hit.id, at, more);
    }
  }

  /** The piece below the pointer, with all that are selected beside it. */
  private pullPieces(id: number, at: { x: number; y: number }, more: boolean) {
    const { store, pieces } = this,
      was = store.selection.includes(id);
    if (!was) store.selectAll(more ? [...store.selection, id] : [id]);
    else if (store.selected !== id) store.selectAll([...store.selection.filter((other) => other !== id), id]);
    // a click alone: it leaves the others, or they leave it
    this.clicked = () => {
      if (was && more) store.selectAll(store.selection.filter((other) => other !== id));
      else if (!more) store.select(id);
    };
    const piece = pieces.selected();
    if (!piece) return; // the arena's own walls
    const starts = pieces.all().map((p) => ({ piece: p, at: pieces.placeOf(p) })),
      here = pieces.placeOf(piece);
    this.pull = (m) => {
      const p = this.scene.floorPoint(m);
      if (!p) return;
      const dx = this.snap(p.x + here[0] - at.x, m) - here[0],
        dy = this.snap(p.y + here[1] - at.y, m) - here[1];
      pieces.put(starts.map((s) => ({ piece: s.piece, at: [s.at[0] + dx, s.at[1] + dy] })));
    };
  }
  /** A frame from where the pointer went down: what is in it is selected, too. */
  private pullBand() {
    const { store, scene, pieces } = this,
      from = this.began,
      before = store.selection;
    const stage = byId("stage"),
      band = h("div", { id: "band" });
    stage.append(band);
    this.pull = (m) => {
      const box = stage.getBoundingClientRect();
      const left = Math.min(from.x, m.clientX),
        right = Math.max(from.x, m.clientX),
        top = Math.min(from.y, m.clientY),
        bottom = Math.max(from.y, m.clientY);
      band.style.cssText = `left:${left - box.left}px;top:${top - box.top}px;width:${right - left}px;height:${bottom - top}px`;
      const inside = (piece: Piece) =>
        ("points" in piece && piece.points ? piece.points : [pieces.placeOf(piece)]).some((p) => {
          const on = scene.project(p[0], p[1], 0);
          return on.x >= left && on.x <= right && on.y >= top && on.y <= bottom;
        });
      const within = [...store.world.things, ...store.world.robots].filter(inside).map((p) => p.id);
      store.selectAll([...before.filter((id) => !within.includes(id)), ...within]);
    };
    this.ended = () => band.remove();
  }

  private moved(e: PointerEvent) {
    if (!this.pull) return this.hover(e);
    const { began } = this;
    began.moved ||= Math.hypot(e.clientX - began.x, e.clientY - began.y) > kClick;
    if (began.moved) this.throttle(() => this.pull?.(e));
  }
  private up(e: PointerEvent) {
    clearTimeout(this.later);
    if (this.pull && this.began.moved) this.pull(e);
    else if (e.type === "pointerup") this.clicked?.();
    this.ended?.();
    this.pull = this.clicked = this.ended = undefined;
  }

  private async add(x: number, y: number, byKey = false) {
    const { store, client, pieces } = this;
    const name = (stem: string) =>
      store.world.things.some((t) => t.name === stem) || store.world.robots.some((r) => r.name === stem)
        ? pieces.freeName(stem)
        : stem;
    const kinds: Record<string, () => Record<string, unknown>> = {
      wall: () => ({
        points: [
          [x, y],
          [x + (byKey ? 0.2 : 0.01), y],
        ],
      }),
      box: () => ({ position: [x, y], size: [0.1, 0.1, 0.1] }),
      cylinder: () => ({ position: [x, y], radius: 0.04, height: 0.1 }),
      ball: () => ({ position: [x, y], radius: 0.02, movable: true, mass: 0.02, colour: [0.95, 0.4, 0.05] }),
      lamp: () => ({ position: [x, y, 0.2] }),
      robot: () => ({ name: name("puck"), firmware: store.world.robots[0]?.firmware || "obstacle", position: [x, y] }),
    };
    const path = this.tool,
      group = this.pieces.group;
    if (path === "wall" && !byKey) {
      // the other end follows the hand, also while the wall is on its way
      let id = 0,
        to: Vec | undefined;
      const stretch = () => {
        if (id && to && Math.hypot(to[0] - x, to[1] - y) > 0.005) client.set(id, { points: [[x, y], to] }, group);
      };
      this.pull = (m) => {
        const p = this.scene.floorPoint(m);
        if (p) to = [this.snap(p.x, m), this.snap(p.y, m)];
        stretch();
      };
      const answer = await client.edit({ op: "add", path, values: kinds.wall(), group });
      id = answer?.thing ?? 0;
      if (id) store.select(id);
      stretch();
      return;
    }
    const answer = await client.edit({ op: "add", path, values: kinds[path](), group });
    if (answer?.thing) {
      store.select(answer.thing);
      this.choose("select");
    }
  }

  /** What the selected thing can be pulled at. */
  handles(): Handle[] {
    const { store, client, pieces } = this;
    if (store.selection.length !== 1) return [];
    const robot = store.selectedRobot(),
      t = store.selectedThing();
    const turn = (piece: Piece, radius: number, z: number): Handle => {
      const a = piece.heading ?? 0;
      return {
        x: piece.position[0] + radius * Math.cos(a),
        y: piece.position[1] + radius * Math.sin(a),
        z,
        title: "Turn; with Shift freely",
        drag: (x, y) =>
          this.pieces.head(
            piece,
            Math.round(Math.atan2(y - piece.position[1], x - piece.position[0]) / kSnapAngle) * kSnapAngle,
          ),
      };
    };
    if (robot) return this.pieces.begun ? [] : [turn(robot, robot.radius * 1.7, 0.02)];
    if (!t) return [];
    if (t.kind === "wall")
      return t.points!.map((p, i) => ({
        x: p[0],
        y: p[1],
        z: (t.z ?? 0) + t.height!,
        title: "Move this corner",
        drag: (x: number, y: number) =>
          client.set(t.id, { points: t.points!.map((q, j) => (i === j ? [x, y] : q)) }, this.pieces.group),
      }));
    if (t.kind === "box" || t.kind === "ramp") {
      const [sx, sy] = t.size!,
        c = Math.cos(t.heading!),
        s = Math.sin(t.heading!),
        z = t.kind === "box" ? t.size![2] : t.high!;
      const side = (dx: number, dy: number): Handle => ({
        x: t.position[0] + (c * dx * sx - s * dy * sy) / 2,
        y: t.position[1] + (s * dx * sx + c * dy * sy) / 2,
        z,
        title: "Stretch",
        drag: (x, y) => {
          // the far side stays where it is
          const fx = t.position[0] - (c * dx * sx - s * dy * sy) / 2,
            fy = t.position[1] - (s * dx * sx + c * dy * sy) / 2;
          const along = dx ? c * dx * (x - fx) + s * dx * (y - fy) : -s * dy * (x - fx) + c * dy * (y - fy);
          const l = Math.max(0.005, Math.round(along * 1000) / 1000);
          const ux = dx ? c * dx : -s * dy,
            uy = dx ? s * dx : c * dy;
          const size = [...t.size!];
          size[dx ? 0 : 1] = l;
          client.set(t.id, { position: [fx + (ux * l) / 2, fy + (uy * l) / 2], size }, this.pieces.group);
        },
      });
      return [side(1, 0), side(-1, 0), side(0, 1), side(0, -1), turn(t, Math.max(sx, sy) / 2 + 0.05, z)];
    }
    if ((t.kind === "cylinder" || t.kind === "ball") && !(t.movable && this.pieces.begun))
      return [
        {
          x: t.position[0] + t.radius!,
          y: t.position[1],
          z: t.kind === "ball" ? t.radius! : t.size![2],
          title: "Radius",
          drag: (x, y) =>
            client.set(
              t.id,
              { radius: Math.max(0.005, Math.round(Math.hypot(x - t.position[0], y - t.position[1]) * 1000) / 1000) },
              this.pieces.group,
            ),
        },
      ];
    return t.heading !== undefined && t.kind === "polygon" ? [turn(t, 0.1, t.size![2])] : [];
  }
}
