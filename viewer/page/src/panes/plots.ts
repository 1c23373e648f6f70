// SPDX-License-Identifier: MIT
// Values over time.
import uPlot from "uplot";
import { css, h } from "../dom";
import { notice } from "../frame/notices";
import { kPalette, lineColour } from "../store/colours";
import type { Client } from "../store/client";
import type { Store } from "../store/store";

const kMostSamples = 6000;

export class Plots {
  readonly pane: HTMLElement;
  names: string[] = [];
  private times: number[] = [];
  private series: (number | null)[][] = [];
  private chart?: uPlot;
  private area = h("div", { id: "plot" });
  private chips = h("div", { className: "toolbar wrap" });
  constructor(
    private store: Store,
    private client: Client,
  ) {
    const list = h("datalist", { id: "names" });
    const input = h("input", {
      id: "plot-name",
      "aria-label": "Name to plot",
      list: "names",
      placeholder: "puck.ir0, puck.var:counter, puck.pin:D3",
      title: "Anything that has a name; Enter plots it",
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
    this.pane = h(
      "div",
      { className: "pane column" },
      h(
        "div",
        { className: "toolbar" },
        input,
        list,
        this.chips,
        h("button", { onclick: () => this.clear(), title: "Forget what was plotted" }, "Clear"),
        h("button", { onclick: () => this.saveCsv(), title: "What is plotted, as a table" }, "CSV"),
      ),
      this.area,
    );
    new ResizeObserver(() => this.chart?.setSize(this.size())).observe(this.area);
    store.wanted.push(() => this.names);
    store.on("plot", (name) => void this.toggle(name));
    store.on("sample", (time) =>
      this.sample(
        time,
        this.names.map((n) => store.values.get(n) ?? null),
      ),
    );
    store.on("pulse", () => this.draw());
    store.on("forgotten", () => this.clear());
    store.on("theme", () => this.build());
    store.on("shown", (pane) => {
      if (pane === "plots") this.draw();
    });
    this.build();
  }
  private size() {
    return { width: Math.max(200, this.area.clientWidth), height: Math.max(80, this.area.clientHeight - 4) };
  }
  async toggle(name: string) {
    const before = this.names;
    this.names = before.includes(name) ? before.filter((n) => n !== name) : [...before, name].slice(-kPalette.length);
    try {
      await this.client.subscribe();
    } catch (e) {
      this.names = before;
      notice((e as Error).message, true);
      this.client.subscribe();
      return;
    }
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
    this.series = this.names.map(() => []);
  }
  build() {
    this.chart?.destroy();
    this.chips.replaceChildren(
      ...this.names.map((n, i) =>
        h(
          "button",
          { className: "chip", title: "No more", onclick: () => this.toggle(n) },
          h("i", { style: `background:${lineColour(i, this.store.dark)}` }),
          n,
        ),
      ),
    );
    this.chart = undefined;
    if (this.names.length === 0)
      return this.area.replaceChildren(
        h("p", { className: "dim pad" }, "Nothing is plotted. Click a value of a robot, or type a name above."),
      );
    this.area.replaceChildren();
    const axis = { stroke: css("--dim"), grid: { stroke: css("--line"), width: 1 }, ticks: { stroke: css("--line") } };
    this.chart = new uPlot(
      {
        ...this.size(),
        scales: { x: { time: false } },
        axes: [
          { ...axis, size: 32, values: (_: uPlot, at: number[]) => at.map((t) => `${+t.toFixed(3)} s`) },
          { ...axis, size: 64 },
        ],
        legend: { show: false },
        series: [
          { label: "s" },
          ...this.names.map((label, i) => ({
            label,
            stroke: lineColour(i, this.store.dark),
            width: 1.5,
            points: { show: false },
          })),
        ],
      },
      [[], ...this.names.map(() => [])] as any,
      this.area,
    );
  }
  sample(time: number, values: (number | null)[]) {
    if (this.names.length === 0) return;
    if (this.times.length > 0 && time < this.times[this.times.length - 1]) this.clear();
    if (time === this.times[this.times.length - 1]) return;
    this.times.push(time);
    values.forEach((v, i) => this.series[i]?.push(v));
    if (this.times.length > kMostSamples) {
      this.times.splice(0, kMostSamples / 4);
      this.series.forEach((s) => s.splice(0, kMostSamples / 4));
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
    const rows = [
      ["time_s", ...this.names].join(","),
      ...this.times.map((t, i) => [t, ...this.series.map((s) => s[i])].join(",")),
    ];
    h("a", {
      href: URL.createObjectURL(new Blob([rows.join("\n") + "\n"], { type: "text/csv" })),
      download: "plot.csv",
    }).click();
  }
}
