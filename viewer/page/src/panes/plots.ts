// SPDX-License-Identifier: MIT
// Values over time, an axis for each unit. Where the page has seen nothing for a while, a line is dashed between the
// dots of what it has seen. The pointer's time is that of all panes; a click sets marker A, with Shift B.
import uPlot from "uplot";
import { css, h } from "../dom";
import { notice } from "../frame/notices";
import { kPalette, lineColour } from "../store/colours";
import type { Client } from "../store/client";
import { timeText } from "../store/cursor";
import type { Store } from "../store/store";
import { markersBar } from "./markers";
import { unitOf, withUnit } from "./units";

const kMostSamples = 6000;
const kGap = 0.15; // s, between two frames: nobody knows what a value did in between
const kNone = "no unit";
const kClick = 3; // px: what moves no farther is one
const kAxisWide = 68;

/** The pieces of time, by the numbers of the samples around them, in which nothing was seen. */
export function gapsOf(times: readonly number[]): number[] {
  const out: number[] = [];
  for (let i = 1; i < times.length; ++i) if (times[i] - times[i - 1] > kGap) out.push(i);
  return out;
}
/** The number of the sample that is nearest to that time; -1: there is none. */
export function nearest(times: readonly number[], time: number): number {
  let a = 0,
    b = times.length;
  while (a < b) {
    const m = (a + b) >> 1;
    if (times[m] < time) a = m + 1;
    else b = m;
  }
  if (a > 0 && (a === times.length || time - times[a - 1] < times[a] - time)) --a;
  return times.length ? a : -1;
}

export class Plots {
  readonly pane: HTMLElement;
  names: string[] = [];
  /** Those, and what is asked for. */
  private asked: string[] = [];
  private times: number[] = [];
  private series: (number | null)[][] = [];
  private gaps: number[] = [];
  private chart?: uPlot;
  private area = h("div", {
    id: "plot",
    tabIndex: 0,
    role: "application",
    "aria-label": "Plots",
    onkeydown: (e: KeyboardEvent) => this.key(e),
  });
  private chips = h("div", { className: "chips" });
  private values: HTMLElement[] = [];
  private at = h("output", { className: "dim number", "aria-live": "off" });
  private pressed?: { x: number; y: number };
  constructor(
    private store: Store,
    private client: Client,
  ) {
    const list = h("datalist", { id: "names" });
    const input = h("input", {
      id: "plot-name",
      "aria-label": "Name to plot",
      list: "names",
      title: "Anything that has a name, such as ir0, var:counter and pin:D3 of a robot; Enter plots it",
      onfocus: () =>
        list.replaceChildren(
          ...this.store.world.robots
            .slice(0, 20)
            .flatMap((r) => this.store.names.map((n) => h("option", { value: `${r.name}.${n}` }))),
        ),
      onchange: () => {
        if (input.value.trim()) this.toggle(input.value.trim());
        input.value = "";
      },
    }) as HTMLInputElement;
    store.on("world", () => (input.placeholder = `${store.world.robots[0]?.name ?? "puck"}.ir0`));
    this.pane = h(
      "div",
      { className: "pane column" },
      h(
        "div",
        { className: "toolbar time-bar" },
        input,
        list,
        markersBar(store),
        this.at,
        h("span", { className: "space" }),
        h("button", { onclick: () => this.clear(), title: "Forget what was plotted" }, "Clear"),
        h("button", { onclick: () => this.saveCsv(), title: "What is plotted, as a table" }, "CSV"),
      ),
      this.chips,
      this.area,
    );
    new ResizeObserver(() => this.chart?.setSize(this.size())).observe(this.area);
    store.wanted.push(() => this.asked);
    store.on("plot", (name) => void this.toggle(name));
    store.on("sample", (time) =>
      this.sample(
        time,
        this.names.map((n) => store.values.get(n) ?? null),
      ),
    );
    store.on("pulse", () => this.draw());
    store.on("cursor", () => this.showCursor());
    store.on("forgotten", () => this.clear());
    store.on("theme", () => this.build());
    store.on("shown", (pane) => {
      if (pane === "plots") this.draw();
    });
    this.build();
  }
  private unit(name: string) {
    return this.store.units.get(name) || unitOf(name);
  }
  private size() {
    return { width: Math.max(200, this.area.clientWidth), height: Math.max(80, this.area.clientHeight - 4) };
  }
  async toggle(name: string) {
    const before = this.asked;
    const asked = before.includes(name) ? before.filter((n) => n !== name) : [...before, name].slice(-kPalette.length);
    this.asked = asked;
    try {
      await this.client.subscribe();
    } catch (e) {
      this.asked = this.asked.filter((n) => n !== name || before.includes(n));
      notice((e as Error).message, true);
      this.client.subscribe().catch(() => {});
      return;
    }
    // samples of what came before are told apart until here
    this.names = asked;
    this.build();
    this.refill();
    this.store.tell("show", "plots");
  }
  /** From the frames that are kept. */
  refill() {
    this.clear();
    this.store.past.each(this.names, (time, values) => this.sample(time, values));
    this.draw();
  }
  clear() {
    this.times = [];
    this.gaps = [];
    this.series = this.names.map(() => []);
  }
  build() {
    this.chart?.destroy();
    this.values = this.names.map(() => h("span", { className: "number" }));
    this.chips.replaceChildren(
      ...this.names.map((n, i) =>
        h(
          "button",
          { className: "chip", title: "No more", "aria-label": `${n}: no more`, onclick: () => this.toggle(n) },
          h("i", { style: `background:${lineColour(i, this.store.dark)}` }),
          n,
          this.values[i],
        ),
      ),
    );
    this.chart = undefined;
    if (this.names.length === 0)
      return this.area.replaceChildren(
        h("p", { className: "dim pad" }, "Nothing is plotted. Click a value of a robot, or type a name above."),
      );
    this.area.replaceChildren();
    const units = [...new Set(this.names.map((n) => this.unit(n)))],
      scale = (unit: string) => unit || kNone,
      plain = { stroke: css("--dim"), ticks: { stroke: css("--line") } };
    this.chart = new uPlot(
      {
        ...this.size(),
        scales: { x: { time: false }, ...Object.fromEntries(units.map((u) => [scale(u), { auto: true }])) },
        axes: [
          {
            ...plain,
            grid: { stroke: css("--line"), width: 1 },
            size: 32,
            values: (_: uPlot, at: number[]) => at.map((t) => `${+t.toFixed(6)}\u202fs`),
          },
          ...units.map((unit, i) => ({
            ...plain,
            scale: scale(unit),
            side: i % 2 ? 1 : 3,
            size: kAxisWide,
            gap: 3,
            grid: { show: i === 0, stroke: css("--line"), width: 1 },
            // one series in the unit: the axis has its colour
            stroke: this.colourOfAxis(unit) ?? css("--dim"),
            values: (_: uPlot, at: number[]) => at.map((v) => `${+v.toPrecision(6)}${unit && `\u202f${unit}`}`),
          })),
        ],
        legend: { show: false },
        cursor: {
          y: false,
          drag: { x: true, y: false },
          bind: {
            mouseleave: () => () => {
              this.store.cursor.pointAt(undefined);
              return null;
            },
          },
        },
        series: [
          { label: "s" },
          ...this.names.map((label, i) => ({
            label,
            scale: scale(this.unit(label)),
            stroke: lineColour(i, this.store.dark),
            width: 1.5,
            points: { show: false },
            gaps: (u: uPlot, _: number, from: number, to: number, known: [number, number][]) =>
              this.gapsInPixels(u, from, to, known),
          })),
        ],
        hooks: {
          draw: [(u: uPlot) => this.drawOver(u)],
          setCursor: [(u: uPlot) => this.pointed(u)],
          ready: [(u: uPlot) => this.listen(u)],
        },
      } as uPlot.Options,
      [[], ...this.names.map(() => [])] as any,
      this.area,
    );
  }
  private colourOfAxis(unit: string) {
    const of = this.names.map((n, i) => (this.unit(n) === unit ? i : -1)).filter((i) => i >= 0);
    return of.length === 1 ? lineColour(of[0], this.store.dark) : undefined;
  }
  private gapsInPixels(u: uPlot, from: number, to: number, known: [number, number][]): [number, number][] {
    const px = (i: number) => Math.round(u.valToPos(this.times[i], "x", true));
    const own = this.gaps
      .filter((i) => i > from && i <= to)
      .map((i): [number, number] => [px(i - 1), px(i)])
      .filter(([a, b]) => b > a + 1);
    return [...known, ...own].sort((a, b) => a[0] - b[0]);
  }
  /** Dots and dashes of gaps, markers, the time that the scene shows. */
  private drawOver(u: uPlot) {
    const { ctx } = u,
      { left, top, width, height } = u.bbox,
      px = devicePixelRatio;
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, top, width, height);
    ctx.clip();
    this.names.forEach((name, s) => {
      const scale = this.unit(name) || kNone,
        values = this.series[s];
      const at = (i: number): [number, number] => [
        u.valToPos(this.times[i], "x", true),
        u.valToPos(values[i]!, scale, true),
      ];
      ctx.strokeStyle = ctx.fillStyle = lineColour(s, this.store.dark);
      ctx.lineWidth = px;
      for (const i of this.gaps) {
        if (values[i - 1] == null || values[i] == null) continue;
        const a = at(i - 1),
          b = at(i);
        if (b[0] < left || a[0] > left + width || b[0] - a[0] < 2) continue;
        ctx.setLineDash([2 * px, 4 * px]);
        ctx.globalAlpha = 0.6;
        ctx.beginPath();
        ctx.moveTo(...a);
        ctx.lineTo(...b);
        ctx.stroke();
        ctx.globalAlpha = 1;
        for (const [x, y] of [a, b]) {
          ctx.beginPath();
          ctx.arc(x, y, 1.8 * px, 0, 7);
          ctx.fill();
        }
      }
    });
    ctx.setLineDash([]);
    const upright = (time: number | undefined, colour: string, name = "") => {
      if (time === undefined) return;
      const x = u.valToPos(time, "x", true);
      ctx.fillStyle = colour;
      ctx.fillRect(x - px / 2, top, 1.5 * px, height);
      ctx.font = `${12 * px}px system-ui`;
      if (name) ctx.fillText(name, x + 3 * px, top + 12 * px);
    };
    if (!this.store.live) upright(this.store.frame?.time, css("--bad"));
    upright(this.store.cursor.a, css("--accent"), "A");
    upright(this.store.cursor.b, css("--accent"), "B");
    ctx.restore();
  }
  private listen(u: uPlot) {
    u.over.addEventListener("pointerdown", (e) => (this.pressed = { x: e.clientX, y: e.clientY }));
    u.over.addEventListener("click", (e) => {
      const { pressed } = this;
      if (!pressed || Math.hypot(e.clientX - pressed.x, e.clientY - pressed.y) > kClick) return;
      const time = this.store.cursor.time ?? u.posToVal(e.offsetX, "x");
      this.store.cursor.mark(e.shiftKey ? "b" : "a", time);
    });
  }

  // --- the cursor

  /** The pointer is over the chart. */
  private pointed(u: uPlot) {
    const { left, idx } = u.cursor;
    if (!u.over.matches(":hover") || left === undefined || left < 0 || idx == null) return;
    this.store.cursor.pointAt(this.times[idx]);
  }
  private showCursor() {
    const { chart, times } = this,
      { time } = this.store.cursor,
      i = time === undefined ? -1 : nearest(times, time);
    this.at.textContent = time === undefined ? "" : timeText(time);
    this.values.forEach((out, s) => {
      const value = i < 0 ? null : this.series[s]?.[i];
      out.textContent = value == null ? "" : ` ${withUnit(value, this.unit(this.names[s]))}`;
    });
    if (!chart || !times.length || !this.area.offsetParent) return;
    if (!chart.over.matches(":hover"))
      chart.setCursor(
        time === undefined ? { left: -10, top: -10 } : { left: chart.valToPos(time, "x"), top: 0 },
        false,
      );
    const markers = [this.store.cursor.a, this.store.cursor.b].join();
    if (markers !== this.drawnMarkers) {
      this.drawnMarkers = markers;
      chart.redraw(false);
    }
  }
  private drawnMarkers = ",";
  /** From sample to sample; with Shift ten at once. */
  private key(e: KeyboardEvent) {
    const { cursor } = this.store,
      { times } = this;
    if (!times.length || e.ctrlKey || e.metaKey || e.altKey) return;
    const at = nearest(times, cursor.time ?? this.store.frame?.time ?? Infinity),
      by = e.shiftKey ? 10 : 1;
    const go = (i: number) => {
      cursor.pointAt(times[Math.max(0, Math.min(times.length - 1, i))]);
      this.area.setAttribute("aria-label", `Plots at ${this.text()}`);
    };
    const keys: Record<string, () => void> = {
      ArrowLeft: () => go(at - by),
      ArrowRight: () => go(at + by),
      Home: () => go(0),
      End: () => go(times.length - 1),
      a: () => cursor.mark("a", times[at]),
      b: () => cursor.mark("b", times[at]),
    };
    if (!keys[e.key]) return;
    e.preventDefault();
    e.stopPropagation();
    keys[e.key]();
  }
  /** Time and values at the cursor. */
  text() {
    return [this.at.textContent, ...this.names.map((n, i) => `${n}${this.values[i].textContent}`)].join(", ");
  }

  sample(time: number, values: (number | null)[]) {
    if (this.names.length === 0) return;
    const { times } = this,
      last = times[times.length - 1];
    if (times.length > 0 && time < last) this.clear();
    if (time === last) return;
    if (this.times.length && time - last > kGap) this.gaps.push(this.times.length);
    this.times.push(time);
    values.forEach((v, i) => this.series[i]?.push(v));
    if (this.times.length > kMostSamples) {
      this.times.splice(0, kMostSamples / 4);
      this.series.forEach((s) => s.splice(0, kMostSamples / 4));
      this.gaps = gapsOf(this.times);
    }
  }
  draw() {
    if (this.pane.isConnected && this.pane.offsetParent && this.chart && this.times.length > 0)
      this.chart.setData([this.times, ...this.series] as any);
  }
  get samples() {
    return this.times.length;
  }
  private saveCsv() {
    const head = (n: string) => (this.unit(n) ? `${n} (${this.unit(n)})` : n);
    const rows = [
      ["time_s", ...this.names.map(head)].join(","),
      ...this.times.map((t, i) => [t, ...this.series.map((s) => s[i])].join(",")),
    ];
    h("a", {
      href: URL.createObjectURL(new Blob([rows.join("\n") + "\n"], { type: "text/csv" })),
      download: "plot.csv",
    }).click();
  }
}
