// SPDX-License-Identifier: MIT
// What one robot's processor did and when its pins changed: rows of main program, interrupts, agendas and
// signals over time. Wheel zooms, dragging moves, a click sets marker A, with Shift B; the line is the time that the
// scene shows. A signal's row can be decoded: bytes of a UART, duty and period of a PWM.
import { css, h } from "../dom";
import { lineColour } from "../store/colours";
import type { Client } from "../store/client";
import { durationText, timeText } from "../store/cursor";
import type { Store } from "../store/store";
import { byteText, bytesOfLine, bytesOfValues, dutyText, kDecoders, kRates, pulsesOf, rateOf } from "./decoders";
import type { Byte, Change, Pulse } from "./decoders";
import { markersBar } from "./markers";

const kMost = 60000; // spans, changes
const kRow = 20,
  kNames = 208,
  kAxis = 20; // px
const kShortest = 20e-6;
const kClick = 3; // px: what moves no farther is one
const kKeyStep = 1 / 50; // of what is seen
const kByteWide = 20,
  kPulseWide = 46; // px, for its text
const kKept = "decoders"; // of localStorage, by signal
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
  changes?: Change[];
  bits?: number;
  /** Of a signal: how it is read, for example "UART 115200", "PWM". */
  decoder?: string;
}
interface Decoded {
  of: string;
  bytes?: Byte[];
  pulses?: Pulse[];
  rate?: number;
}

export class TimeLine {
  readonly pane: HTMLElement;
  shown = false;
  private canvas = h("canvas", {
    id: "timeline",
    title: "Wheel: zoom. Drag: move. Click: marker A, with Shift B. Double click: follow the end.",
    tabIndex: 0,
    role: "application",
    onkeydown: (e: KeyboardEvent) => this.key(e),
  });
  private heads = h("div", { className: "row-heads" });
  private headsOf = "";
  private decoders: Record<string, string> = JSON.parse(localStorage.getItem(kKept) ?? "{}");
  private decoded = new Map<string, Decoded>();
  private row = 0; // that keys are on
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
  private grip?: { x: number; right: number; moved: boolean };

  constructor(
    private store: Store,
    private client: Client,
  ) {
    this.pane = h(
      "div",
      { className: "pane column" },
      h(
        "div",
        { className: "toolbar time-bar" },
        this.signals,
        h("button", { title: "Closer (+)", "aria-label": "Closer", onclick: () => this.zoom(0.5) }, "+"),
        h("button", { title: "Farther (-)", "aria-label": "Farther", onclick: () => this.zoom(2) }, "−"),
        h("button", { title: "All of it", onclick: () => this.all() }, "All"),
        markersBar(store),
        this.said,
      ),
      h("div", { className: "rows" }, this.canvas, this.heads),
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
      if (e.button !== 0) return;
      this.grip = { x: e.offsetX, right: this.right ?? this.end, moved: false };
      this.canvas.setPointerCapture(e.pointerId);
    });
    this.canvas.addEventListener("pointerup", (e) => {
      if (this.grip && !this.grip.moved && e.offsetX > kNames)
        store.cursor.mark(e.shiftKey ? "b" : "a", this.time(e.offsetX));
      this.grip = undefined;
    });
    this.canvas.addEventListener("dblclick", () => {
      this.right = undefined;
      this.draw();
    });
    this.canvas.addEventListener("pointermove", (e) => {
      const { grip } = this;
      if (grip) {
        grip.moved ||= Math.abs(e.offsetX - grip.x) > kClick;
        if (grip.moved) this.right = grip.right - ((e.offsetX - grip.x) * this.span) / this.width;
      }
      store.cursor.pointAt(e.offsetX > kNames ? this.time(e.offsetX) : undefined);
      this.tell(this.time(e.offsetX), Math.floor((e.offsetY - kAxis) / kRow));
      if (grip?.moved) this.draw();
    });
    this.canvas.addEventListener("pointerleave", () => store.cursor.pointAt(undefined));
    store.on("cursor", () => this.draw());
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
        .map(([name, bits], i) => ({
          name,
          bits,
          colour: lineColour(5, this.store.dark),
          changes: this.changes[i],
          decoder: this.decoders[name] ?? "",
        }))
        .filter((r) => r.changes.length > 0 || this.names.length <= 12),
    ];
  }
  private tell(t: number, at: number) {
    const row = this.rows()[at];
    if (!row) return;
    const near = (this.span / this.width) * 2;
    const span = row.spans?.filter((s) => s[1] <= t + near && s[2] >= t - near).pop();
    const change = row.changes?.filter((c) => c[0] <= t).pop(),
      is = (p: { from: number; to: number }) => p.from <= t && p.to >= t,
      { bytes, pulses } = this.decodedOf(row),
      byte = bytes?.find(is),
      pulse = pulses?.find(is);
    const words = [`${timeText(t)}  ${row.name}`];
    if (span) words.push(`: ${span[3]}, ${durationText(span[2] - span[1])}`);
    if (change) words.push(` = ${row.bits! > 1 ? "0x" + change[1].toString(16) : change[1]}`);
    if (byte) words.push(`, byte ${byteText(byte.value)}${byte.wrong && `, ${byte.wrong}`}`);
    if (pulse) words.push(`, duty ${dutyText(pulse)}, period ${durationText(pulse.to - pulse.from)}`);
    this.said.textContent = words.join("");
  }
  /** The cursor and the picture by keys. */
  private key(e: KeyboardEvent) {
    const { cursor } = this.store,
      right = this.right ?? this.end,
      left = right - this.span,
      at = Math.min(right, Math.max(left, cursor.time ?? this.store.frame?.time ?? right)),
      step = this.span * kKeyStep * (e.shiftKey ? 10 : 1);
    const move = (to: number) => {
      const time = Math.max(0, Math.min(this.end, to));
      if (time > right) this.right = time;
      else if (time < left) this.right = time + this.span;
      cursor.pointAt(time);
      this.tell(time, this.row);
      this.draw();
    };
    const turn = (by: number) => {
      this.row = Math.max(0, Math.min(this.rows().length - 1, this.row + by));
      this.tell(at, this.row);
    };
    const keys: Record<string, () => void> = {
      ArrowLeft: () => move(at - step),
      ArrowRight: () => move(at + step),
      ArrowUp: () => turn(-1),
      ArrowDown: () => turn(1),
      Home: () => move(0),
      End: () => move(this.end),
      "+": () => this.zoom(0.5, at),
      "-": () => this.zoom(2, at),
      a: () => cursor.mark("a", at),
      b: () => cursor.mark("b", at),
    };
    if (e.ctrlKey || e.metaKey || e.altKey || !keys[e.key]) return;
    e.preventDefault();
    e.stopPropagation();
    keys[e.key]();
  }

  // --- decoding

  private decodedOf(row: Row): Decoded {
    const list = row.changes;
    if (!list || !row.decoder) return { of: "" };
    const [kind, rate] = row.decoder.split(" "),
      busy = this.names.findIndex(([n]) => n === `${row.name}_busy`);
    const of = [row.decoder, list.length, list[0]?.[0], list[list.length - 1]?.[0], row.bits! > 1 && this.end].join();
    const known = this.decoded.get(row.name);
    if (known?.of === of) return known;
    const made: Decoded = { of };
    if (kind === "PWM") made.pulses = pulsesOf(list);
    else if (row.bits! > 1) made.bytes = bytesOfValues(list, busy >= 0 ? this.changes[busy] : undefined, this.end);
    else {
      made.rate = Number(rate) || rateOf(list);
      made.bytes = made.rate ? bytesOfLine(list, made.rate, this.end) : [];
    }
    this.decoded.set(row.name, made);
    return made;
  }
  private decode(name: string, as: string) {
    this.decoders[name] = as;
    if (!as) delete this.decoders[name];
    localStorage.setItem(kKept, JSON.stringify(this.decoders));
    this.draw();
  }
  /** Names of rows, and how a signal is read. */
  private showHeads(rows: Row[]) {
    const of = rows.map((r) => `${r.name}:${r.decoder ?? "-"}`).join();
    if (of === this.headsOf) return;
    this.headsOf = of;
    this.heads.replaceChildren(
      ...rows.map((row, i) => {
        const choices = row.decoder === undefined ? [] : this.choicesOf(row);
        const select =
          choices.length > 1 &&
          h(
            "select",
            {
              "aria-label": `How ${row.name} is read`,
              title: "Decoder: bytes of a UART, duty and period of a PWM",
              onchange: (e: Event) => this.decode(row.name, (e.target as HTMLSelectElement).value),
            },
            ...choices.map(([value, text]) => h("option", { value, selected: value === row.decoder }, text)),
          );
        return h(
          "div",
          { className: "row-head", style: `top:${kAxis + i * kRow}px;height:${kRow}px`, title: row.name },
          h("span", {}, row.name),
          select,
        );
      }),
    );
  }
  private choicesOf(row: Row): [string, string][] {
    const plain: [string, string] = ["", "plain"];
    if (row.name.endsWith("_busy")) return [plain];
    if (row.bits! > 1) return row.bits! <= 9 ? [plain, [kDecoders[1], "bytes"]] : [plain];
    return [
      plain,
      [kDecoders[2], "PWM"],
      [kDecoders[1], "UART"],
      ...kRates.map((r): [string, string] => [`UART ${r}`, `UART ${r}`]),
    ];
  }
  private drawDecoded(
    c: CanvasRenderingContext2D,
    row: Row,
    top: number,
    tall: number,
    x: (t: number) => number,
    left: number,
    right: number,
  ) {
    const { bytes, pulses } = this.decodedOf(row),
      text = css("--text"),
      clip = (t: number) => Math.max(kNames, x(t)),
      label = (what: string, from: number, to: number) => {
        c.fillStyle = text;
        c.textAlign = "center";
        c.fillText(what, (from + to) / 2, top + tall - 3, to - from - 2);
        c.textAlign = "left";
      };
    for (const b of bytes ?? []) {
      if (b.to < left || b.from > right) continue;
      const from = clip(b.from),
        to = Math.max(from + 1, x(b.to) - 1);
      c.globalAlpha = 0.35;
      c.fillStyle = b.wrong ? css("--bad") : row.colour;
      c.fillRect(from, top, to - from, tall);
      c.globalAlpha = 1;
      const hex = b.value.toString(16).toUpperCase().padStart(2, "0");
      if (to - from > 2 * kByteWide) label(byteText(b.value), from, to);
      else if (to - from > kByteWide - 4) label(hex, from, to);
    }
    if (!pulses) return;
    // duty as a curve where periods are too narrow for words
    c.strokeStyle = row.colour;
    c.lineWidth = 1.4;
    c.beginPath();
    for (const p of pulses) {
      if (p.to < left || p.from > right) continue;
      const from = clip(p.from),
        to = clip(p.to);
      if (to - from > kPulseWide) {
        c.globalAlpha = 0.35;
        c.fillStyle = row.colour;
        c.fillRect(from, top, Math.max(0, clip(p.from + p.high) - from), tall);
        c.globalAlpha = 1;
        label(`${dutyText(p)} ${durationText(p.to - p.from)}`, from, to);
      } else {
        const y = top + tall * (1 - p.high / (p.to - p.from));
        c.lineTo(from, y);
        c.lineTo(to, y);
      }
    }
    c.stroke();
  }

  /** A signal's levels as a curve, a register's values between the instants of its changes. */
  private drawChanges(
    c: CanvasRenderingContext2D,
    row: Row,
    top: number,
    tall: number,
    clip: (t: number) => number,
    left: number,
    right: number,
  ) {
    const changes = row.changes ?? [];
    if (!changes.length) return;
    const low = top + tall,
      most = row.bits === 1 ? 1 : 0;
    c.strokeStyle = row.colour;
    c.fillStyle = css("--text");
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
    this.showHeads(rows);
    const said = `Time line of ${this.robot || "no robot"}, ${rows.length} rows, ${timeText(Math.max(0, left))} to ${timeText(right)}. Arrows move the cursor and choose a row, plus and minus zoom, A and B set markers`;
    if (this.canvas.getAttribute("aria-label") !== said) this.canvas.setAttribute("aria-label", said);
    const dim = css("--dim"),
      line = css("--line");
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
      if (row.decoder) this.drawDecoded(c, row, top, tall, x, left, right);
      else this.drawChanges(c, row, top, tall, clip, left, right);
      c.fillStyle = css("--panel");
      c.fillRect(0, top - 3, kNames, kRow);
      c.fillStyle = line;
      c.fillRect(0, top + tall + 2, w, 1);
    });
    const upright = (t: number | undefined, colour: string, wide: number, name = "") => {
      if (t === undefined || t < left || t > right) return;
      c.fillStyle = colour;
      c.fillRect(x(t), 0, wide, hgt);
      if (name) c.fillText(name, x(t) + 3, kAxis + 9);
    };
    const { time, a, b } = this.store.cursor;
    upright(this.store.frame?.time, css("--bad"), 1.5);
    upright(time, css("--dim"), 1);
    upright(a, css("--accent"), 1.5, "A");
    upright(b, css("--accent"), 1.5, "B");
  }
}
