// SPDX-License-Identifier: MIT
// What one robot's processor did and when its pins changed: rows of main program, interrupts, agendas and
// signals over time. Wheel zooms, dragging moves, the line is the time that the scene shows.
import { css, h } from "../dom";
import { lineColour } from "../store/colours";
import type { Client } from "../store/client";
import type { Store } from "../store/store";

const kMost = 60000; // spans, changes
const kRow = 20,
  kNames = 132,
  kAxis = 20; // px
const kShortest = 20e-6;
enum Kind {
  Busy,
  Waiting,
  Handler,
  HandlerWaiting,
  Callback,
}
type Span = [Kind, number, number, string];
export interface TraceEvent {
  robot: string;
  until: number;
  signals: [string, number][];
  spans: Span[];
  changes: [number, number, number][];
  lost: number;
  waits: boolean;
}
interface Row {
  name: string;
  colour: string;
  spans?: Span[];
  changes?: [number, number][];
  bits?: number;
}

export class TimeLine {
  readonly pane: HTMLElement;
  shown = false;
  private canvas = h("canvas", { id: "timeline", title: "Wheel: zoom. Drag: move. Double click: follow the end." });
  private said = h("output", { className: "dim number" });
  private signals = h("input", {
    id: "signals",
    "aria-label": "Signals to show",
    placeholder: "LED0, RA6, left_coils, TX1, T2, a variable; empty: the usual",
    title: "Signals to show; names of docs/looking.md. Enter takes them",
    onchange: () => this.ask(),
  }) as HTMLInputElement;
  private robot = "";
  private names: [string, number][] = [];
  private spans: Span[] = [];
  private changes: [number, number][][] = [];
  private end = 0;
  private waits = false; // the program, at the end
  private span = 0.2; // s, that the picture is wide
  private right?: number; // s, at its right side; undefined: the end
  private grip?: { x: number; right: number };

  constructor(
    private store: Store,
    private client: Client,
  ) {
    this.pane = h(
      "div",
      { className: "pane column" },
      h(
        "div",
        { className: "toolbar" },
        this.signals,
        h("button", { title: "Closer", onclick: () => this.zoom(0.5) }, "+"),
        h("button", { title: "Farther", onclick: () => this.zoom(2) }, "−"),
        h("button", { title: "All of it", onclick: () => this.all() }, "All"),
        this.said,
      ),
      h("div", { className: "rows" }, this.canvas),
    );
    this.canvas.addEventListener(
      "wheel",
      (e) => {
        e.preventDefault();
        this.zoom(e.deltaY > 0 ? 1.25 : 0.8, this.time(e.offsetX));
      },
      { passive: false },
    );
    this.canvas.addEventListener("pointerdown", (e) => {
      this.grip = { x: e.offsetX, right: this.right ?? this.end };
      this.canvas.setPointerCapture(e.pointerId);
    });
    this.canvas.addEventListener("pointerup", () => {
      this.grip = undefined;
    });
    this.canvas.addEventListener("dblclick", () => {
      this.right = undefined;
      this.draw();
    });
    this.canvas.addEventListener("pointermove", (e) => {
      if (this.grip) this.right = this.grip.right - ((e.offsetX - this.grip.x) * this.span) / this.width;
      this.tell(e.offsetX, e.offsetY);
      if (this.grip) this.draw();
    });
    new ResizeObserver(() => this.draw()).observe(this.pane);
    store.on("trace", (e) => this.take(e));
    store.on("forgotten", () => this.forget());
    store.on("jump", (at) => this.goTo(store.past.frames[at].time));
    store.on("selection", ({ changed }) => {
      if (changed && this.shown) void this.watch(true);
    });
    store.on("shown", (pane) => {
      if ((pane === "timeline") !== this.shown) void this.watch(pane === "timeline");
    });
  }

  private get width() {
    return Math.max(50, this.canvas.clientWidth - kNames);
  }
  private time(x: number) {
    return (this.right ?? this.end) - this.span * (1 - (x - kNames) / this.width);
  }
  private zoom(by: number, about = (this.right ?? this.end) - this.span / 2) {
    const span = Math.min(Math.max(kShortest, this.span * by), Math.max(1, this.end)),
      right = this.right ?? this.end;
    const next = about + (right - about) * (span / this.span);
    this.right = next >= this.end && this.right === undefined ? undefined : next;
    this.span = span;
    this.draw();
  }
  /** The scene shows that time: so does this. */
  goTo(time: number) {
    const right = this.right ?? this.end;
    if (time > right || time < right - this.span) this.right = time + this.span / 2;
    this.draw();
  }
  private all() {
    this.right = undefined;
    this.span = Math.max(0.001, this.end);
    this.draw();
  }

  /** Shown: the server tells of this robot, which costs time; hidden: of none. */
  async watch(shown: boolean) {
    this.shown = shown;
    const robot = shown ? ((this.store.selectedRobot() ?? this.store.world.robots[0])?.name ?? "") : "";
    if (robot !== this.robot || shown) await this.ask(robot);
    this.draw();
  }
  private async ask(robot = this.robot) {
    this.robot = robot;
    if (this.store.recorded) return;
    await this.client.do("trace", { robot, signals: this.signals.value.split(/[\s,]+/).filter((n) => n) });
  }
  forget() {
    this.spans = [];
    this.changes = this.names.map(() => []);
    this.end = 0;
    this.right = undefined;
    this.draw();
  }
  take(event: TraceEvent) {
    if (JSON.stringify(event.signals) !== JSON.stringify(this.names) || event.until < this.end) {
      this.names = event.signals;
      this.forget();
    }
    this.robot = event.robot;
    this.spans.push(...event.spans);
    for (const [signal, at, value] of event.changes) this.changes[signal].push([at, value]);
    if (this.spans.length > kMost) this.spans.splice(0, this.spans.length - kMost);
    for (const list of this.changes) if (list.length > kMost) list.splice(0, list.length - kMost);
    this.end = event.until;
    this.waits = event.waits;
    if (event.lost) this.said.textContent = `${event.lost} earlier ones are not shown`;
    this.draw();
  }
  get known() {
    return {
      spans: this.spans.length,
      rows: this.rows().length,
      changes: this.changes.map((c) => c.length),
      robot: this.robot,
    };
  }

  private rows(): Row[] {
    const rows = new Map<string, Row>();
    const row = (name: string, colour: string) => {
      if (!rows.has(name)) rows.set(name, { name, colour, spans: [] });
      return rows.get(name)!;
    };
    row("main", lineColour(0, this.store.dark));
    for (const s of this.spans) {
      if (s[0] <= Kind.Waiting) row("main", lineColour(0, this.store.dark)).spans!.push(s);
      else if (s[0] === Kind.Callback) row(`${s[3]}()`, lineColour(2, this.store.dark)).spans!.push(s);
      else if (s[0] === Kind.Handler) row(s[3], lineColour(1, this.store.dark)).spans!.push(s);
    }
    // what still goes on has no end yet
    const main = rows.get("main")!.spans!,
      since = main.length ? main[main.length - 1][2] : 0;
    if (since < this.end)
      main.push([this.waits ? Kind.Waiting : Kind.Busy, since, this.end, this.waits ? "waiting" : "busy"]);
    return [
      ...rows.values(),
      ...this.names
        .map(([name, bits], i) => ({ name, bits, colour: lineColour(5, this.store.dark), changes: this.changes[i] }))
        .filter((r) => r.changes.length > 0 || this.names.length <= 12),
    ];
  }
  private tell(x: number, y: number) {
    const t = this.time(x),
      row = this.rows()[Math.floor((y - kAxis) / kRow)];
    if (!row || x < kNames) return;
    const near = (this.span / this.width) * 2;
    const span = row.spans?.filter((s) => s[1] <= t + near && s[2] >= t - near).pop();
    const change = row.changes?.filter((c) => c[0] <= t).pop();
    this.said.textContent = `${t.toFixed(6)} s  ${row.name}${span ? `: ${span[3]}, ${((span[2] - span[1]) * 1e6).toFixed(0)} µs` : ""}${change ? ` = ${row.bits! > 1 ? "0x" + change[1].toString(16) : change[1]}` : ""}`;
  }

  draw() {
    if (!this.shown || !this.canvas.parentElement?.clientWidth) return;
    const rows = this.rows(),
      w = this.canvas.parentElement.clientWidth,
      hgt = kAxis + kRow * rows.length + 4,
      scale = devicePixelRatio;
    if (this.canvas.width !== w * scale || this.canvas.height !== hgt * scale) {
      this.canvas.width = w * scale;
      this.canvas.height = hgt * scale;
      this.canvas.style.cssText = `width:${w}px;height:${hgt}px`;
    }
    const c = this.canvas.getContext("2d")!,
      right = this.right ?? this.end,
      left = right - this.span;
    const x = (t: number) => kNames + ((t - left) / this.span) * (w - kNames),
      clip = (t: number) => Math.min(w, Math.max(kNames, x(t)));
    c.setTransform(scale, 0, 0, scale, 0, 0);
    c.clearRect(0, 0, w, hgt);
    c.font = "12px system-ui";
    const dim = css("--dim"),
      line = css("--line"),
      text = css("--text");
    const step = 10 ** Math.floor(Math.log10(this.span / 3)),
      every = this.span / step > 12 ? 5 * step : this.span / step > 6 ? 2 * step : step;
    for (let i = Math.ceil(left / every); i * every <= right; ++i) {
      c.fillStyle = line;
      c.fillRect(x(i * every), 0, 1, hgt);
      c.fillStyle = dim;
      c.fillText(
        every < 1e-3 ? `${(i * every * 1e3).toFixed(every < 1e-4 ? 2 : 1)} ms` : `${+(i * every).toFixed(4)} s`,
        x(i * every) + 3,
        13,
      );
    }
    rows.forEach((row, i) => {
      const top = kAxis + i * kRow + 3,
        tall = kRow - 6;
      for (const s of row.spans ?? []) {
        if (s[2] < left || s[1] > right) continue;
        const from = clip(s[1]),
          wide = Math.max(0.7, clip(s[2]) - from);
        c.fillStyle = s[0] === Kind.Waiting ? line : row.colour;
        if (s[0] === Kind.Waiting) c.fillRect(from, top + tall / 2 - 1, wide, 2);
        else c.fillRect(from, top, wide, tall);
      }
      const changes = row.changes ?? [];
      if (changes.length) {
        const low = top + tall,
          most = row.bits === 1 ? 1 : 0;
        c.strokeStyle = row.colour;
        c.fillStyle = text;
        c.lineWidth = 1.4;
        c.beginPath();
        // the last before the picture, then those in it
        let from = 0;
        for (let a = 0, b = changes.length - 1; a <= b;) {
          const m = (a + b) >> 1;
          if (changes[m][0] <= left) {
            from = m;
            a = m + 1;
          } else b = m - 1;
        }
        for (let k = from; k < changes.length && changes[k][0] <= right; ++k) {
          const a = clip(changes[k][0]),
            b = clip(k + 1 < changes.length ? changes[k + 1][0] : this.end),
            y = most ? low - tall * changes[k][1] : low;
          if (most) {
            c.lineTo(a, y);
            c.lineTo(b, y);
          } else {
            c.moveTo(a, low);
            c.lineTo(a, top);
            c.moveTo(a, low);
            c.lineTo(b, low);
            c.moveTo(a, top);
            c.lineTo(b, top);
            if (b - a > 26) c.fillText(`0x${changes[k][1].toString(16)}`, a + 3, low - 3, b - a - 4);
          }
        }
        c.stroke();
      }
      c.fillStyle = css("--panel");
      c.fillRect(0, top - 3, kNames, kRow);
      c.fillStyle = text;
      c.fillText(row.name, 8, top + 11, kNames - 12);
      c.fillStyle = line;
      c.fillRect(0, top + tall + 2, w, 1);
    });
    const now = this.store.frame?.time;
    if (now !== undefined && now >= left && now <= right) {
      c.fillStyle = css("--bad");
      c.fillRect(x(now), 0, 1.5, hgt);
    }
  }
}
