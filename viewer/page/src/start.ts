// SPDX-License-Identifier: MIT
// The first thing that runs: it opens the socket and draws the world as a plan as soon as the first state is here.
// The page itself is a hundred times as long and takes the socket over, and its scene the place of the plan.
import { readFrame } from "./link/protocol";
import type { World } from "./link/protocol";
import type { Early } from "./link/connection";

const dark = localStorage.getItem("theme")
  ? localStorage.getItem("theme") === "dark"
  : matchMedia("(prefers-color-scheme: dark)").matches;
document.documentElement.dataset.theme = dark ? "dark" : "light";
const socket = new WebSocket(`ws://${location.host}${location.pathname.replace(/[^/]*$/, "")}live`);
socket.binaryType = "arraybuffer";
const early: Early = ((window as any).early = { socket, heard: [] });
let world: World | undefined,
  loading = false;

const paint = (c: number[]) => `rgb(${c.map((v) => Math.round(255 * v)).join()})`;
function load() {
  if (loading) return;
  loading = true;
  const script = document.createElement("script");
  script.src = "page.js";
  document.body.append(script);
}

/** As the scene seen from above will be. */
function drawPlan(poses: Float32Array) {
  const stage = document.getElementById("stage")!,
    plan = document.createElement("canvas"),
    w = world!,
    scale = devicePixelRatio;
  plan.id = "plan";
  plan.width = stage.clientWidth * scale;
  plan.height = stage.clientHeight * scale;
  const c = plan.getContext("2d")!,
    a = w.arena,
    size = a ? Math.max(...a.size) : 1.4,
    [x, y] = a ? a.centre : [0, 0];
  const px = (plan.height * Math.min(1, (plan.width / plan.height) * 0.98)) / (1.12 * size);
  c.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--sky");
  c.fillRect(0, 0, plan.width, plan.height);
  c.setTransform(px, 0, 0, -px, plan.width / 2 - x * px, plan.height / 2 + y * px);
  const box = (lx: number, ly: number) => c.fillRect(-lx / 2, -ly / 2, lx, ly);
  const at = (px_: number, py: number, turn: number, draw: () => void) => {
    c.save();
    c.translate(px_, py);
    c.rotate(turn);
    draw();
    c.restore();
  };
  const round = (r: number) => {
    c.beginPath();
    c.arc(0, 0, r, 0, 7);
    c.fill();
  };
  if (a)
    at(x, y, 0, () => {
      c.fillStyle = paint(a.colour);
      box(a.size[0] + 2 * a.wall_thickness, a.size[1] + 2 * a.wall_thickness);
      c.fillStyle = paint(w.floor.colour);
      box(a.size[0], a.size[1]);
    });
  for (const t of w.things) {
    c.fillStyle = c.strokeStyle = paint(t.colour);
    if (t.points) {
      c.lineWidth = t.thickness!;
      c.beginPath();
      t.points.forEach((p) => c.lineTo(p[0], p[1]));
      if (t.closed) c.closePath();
      c.stroke();
    } else
      at(t.position[0], t.position[1], t.heading ?? 0, () =>
        t.radius && t.kind !== "box" ? round(t.radius) : box(t.size?.[0] ?? 0.03, t.size?.[1] ?? 0.03),
      );
  }
  for (const r of w.robots)
    at(poses[4 * r.body], poses[4 * r.body + 1], poses[4 * r.body + 3], () => {
      c.fillStyle = paint(r.colour);
      round(r.radius);
    });
  stage.prepend(plan);
}

socket.onmessage = ({ data }) => {
  early.heard.push(data);
  if (typeof data === "string") {
    const event = JSON.parse(data);
    if (event.event !== "hello") return;
    world = event.world;
    if (!event.state.runs) load();
  } else if (world && !document.getElementById("plan")) {
    const frame = readFrame(data);
    drawPlan(frame.poses);
    document.getElementById("clock")!.textContent = `${frame.time.toFixed(3)} s`;
    document.body.dataset.state = "shown";
    requestAnimationFrame(() => setTimeout(load)); // when it has been painted
  }
};
setTimeout(load, 1000); // whatever happens, the page can say it
