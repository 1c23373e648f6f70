// SPDX-License-Identifier: MIT
// What the inspector shows of a robot: its place, sensors, lights, selector, camera, parts, variables.
import { h } from "../dom";
import { askText, notice } from "../frame/notices";
import type { Robot } from "../link/protocol";
import { RobotState } from "../link/protocol";
import type { Client } from "../store/client";
import type { Pieces } from "../store/pieces";
import type { Store } from "../store/store";
import { field, headOf } from "./fields";
import type { Fields } from "./fields";
import { drawEars, drawFan, drawPicture } from "./senses";
import { format, unitOf, withUnit } from "./units";

/** Name, least, most of its bar; the same: no bar. */
const kGauges: [string, number, number][] = [
  ["speed", 0, 0.13],
  ["battery", 3, 4.2],
  ["charge", 0, 100],
  ["current", 0, 800],
  ["load", 0, 100],
  ["left_steps", 0, 0],
  ["right_steps", 0, 0],
  ["distance", 0, 0],
  ["collisions", 0, 0],
  ["acc_x", 0, 4095],
  ["acc_y", 0, 4095],
  ["acc_z", 0, 4095],
  ["mic0", 0, 4095],
  ["mic1", 0, 4095],
  ["mic2", 0, 4095],
];
// codes of RC-5, as televisions' remote controls send them
const kRemote: [string, number, string][] = [
  ...Array.from({ length: 10 }, (_, i): [string, number, string] => {
    const key = (i + 1) % 10;
    return [String(key), key, `key ${key}`];
  }),
  ["⏻", 12, "standby"],
  ["V+", 16, "volume up"],
  ["V−", 17, "volume down"],
  ["P+", 32, "programme up"],
  ["P−", 33, "programme down"],
];
/** The protocol's name of what was typed: a variable, unless it says reg: or pin:. */
const watchName = (typed: string) => (/^(reg|pin):/.test(typed) ? typed : `var:${typed}`);
const kSensors = 8;

interface Gauge {
  text: HTMLElement;
  unit: HTMLElement;
  bar: HTMLElement;
  least: number;
  most: number;
}

export class RobotSheet {
  private robot?: Robot;
  private fan?: CanvasRenderingContext2D;
  private sensor = 0; // that the arrow keys have chosen on the fan
  private fanSays = h("output", { className: "number dim", "aria-live": "polite" });
  private ears?: CanvasRenderingContext2D;
  private camera = h("canvas", {
    id: "camera",
    role: "img",
    tabIndex: 0,
    title: "What the program got from its camera last",
  });
  private cameraBox = h("div", { id: "camera-box", hidden: true });
  private stands = h("button", {
    id: "stands",
    className: "row",
    title: "Where its program stands; a click shows the line",
    onclick: () => {
      const at = this.store.sourceOf(this.store.look);
      if (at) this.store.tell("sourceLine", at);
    },
  });
  private parts = h("div", { id: "parts" });
  private gauges = new Map<string, Gauge>();
  private watched = new Map<string, string[]>(); // per robot: expressions
  private place = h("p", { className: "dim number" });
  private selector = h("input", {
    type: "range",
    min: "0",
    max: "15",
    value: "0",
    id: "selector",
    title: "Selector, 0 to 15: turn it while the program runs",
    oninput: () => {
      this.selectorSays.textContent = this.selector.value;
      this.client.do("selector", { robot: this.robot!.name, position: Number(this.selector.value) });
    },
  });
  private selectorSays = h("b", { id: "selector-value" });

  constructor(
    private store: Store,
    private client: Client,
    private pieces: Pieces,
    private fields: Fields,
    private again: () => void,
  ) {}

  /** Names that the robot that is shown wants in every frame. */
  names(): string[] {
    const robot = this.store.selectedRobot();
    if (!robot || robot.body < 0) return [];
    const own = ["x", "y", "heading", "selector", "sound_bearing", "speaker", ...kGauges.map((g) => g[0])];
    for (let i = 0; i < 3; ++i) own.push(`mic_level${i}`);
    for (let i = 0; i < kSensors; ++i) own.push(`ir${i}`, `light${i}`);
    return [...own, ...(this.watched.get(robot.name) ?? []).map(watchName)].map((n) => `${robot.name}.${n}`);
  }

  show(robot: Robot): HTMLElement[] {
    const { store, client, pieces } = this;
    this.robot = robot;
    this.gauges.clear();
    this.parts.dataset.said = "";
    this.place.textContent = "";
    this.fan = this.ears = undefined;
    const program = store.programOf(robot);
    const wrong = store.world.problems.find((p) => p.id === robot.id);
    return [
      ...headOf(robot.colour, robot.name, program || "no program", wrong),
      this.place,
      this.stands,
      h(
        "div",
        { className: "buttons" },
        h(
          "button",
          { onclick: () => client.do("reset", { robot: robot.name }), title: "The robot's reset button" },
          "Reset",
        ),
        h(
          "button",
          {
            onclick: () => client.toggleRays(robot.name),
            title: "Rays of its proximity sensors (Y for all robots)",
          },
          "Rays",
        ),
        h("button", { onclick: () => store.tell("follow", robot.name), title: "The view goes with it" }, "Follow"),
        h("button", { onclick: () => store.tell("show", "program"), title: "Its source" }, "Program"),
        h("button", { onclick: () => pieces.copy(), title: "Copy (Ctrl D)" }, "Copy"),
        h("button", { onclick: () => pieces.remove(), title: "Delete (Del)" }, "Delete"),
      ),
      ...(robot.body < 0 ? [h("p", { className: "dim" }, "It is in the file, and not in the run.")] : this.live(robot)),
      ...this.fields.of("robot", robot.id),
    ];
  }

  /** What only a robot of the run has. */
  private live(robot: Robot) {
    return [
      ...this.senses(),
      ...kGauges.map(([name, least, most]) => this.gauge(robot, name, least, most)),
      h("h3", {}, "Variables, registers, pins"),
      ...this.watches(robot),
      this.hands(robot),
    ];
  }

  // --- pictures of what it senses

  private senses(): HTMLElement[] {
    const canvas = h("canvas", {
      width: 640,
      height: 440,
      id: "fan",
      role: "img",
      tabIndex: 0,
      title:
        "Proximity sensors: the fuller a wedge, the nearer something is (counts, 0 to 4095). Numbers are ir0 to ir7. With the keyboard: left and right choose a sensor, Enter plots it",
      onkeydown: (e: KeyboardEvent) => this.fanKey(e),
      onfocus: () => this.sayFan(),
      onblur: () => (this.fanSays.textContent = ""),
    });
    this.fan = canvas.getContext("2d")!;
    const ears = h("canvas", {
      width: 640,
      height: 200,
      id: "ears",
      role: "img",
      tabIndex: 0,
      title:
        "Sound at the three microphones (counts, root mean square, without their noise), the arrow whence it comes; and what the loudspeaker plays, % of full scale",
      onfocus: () => this.describe(),
    });
    this.ears = ears.getContext("2d")!;
    this.describe();
    return [
      canvas,
      this.fanSays,
      h(
        "div",
        { className: "field" },
        h("label", { htmlFor: "selector" }, "Selector"),
        this.selector,
        this.selectorSays,
      ),
      this.cameraBox,
      ears,
      this.parts,
    ];
  }
  private value(name: string) {
    return this.store.values.get(`${this.robot!.name}.${name}`);
  }
  private fanKey(e: KeyboardEvent) {
    const by = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -1, ArrowDown: 1 }[e.key];
    if (by !== undefined) this.sensor = (this.sensor + by + kSensors) % kSensors;
    else if (e.key === "Enter") this.store.tell("plot", `${this.robot!.name}.ir${this.sensor}`);
    else return;
    e.preventDefault();
    this.sayFan();
  }
  private sayFan() {
    const said = (name: string) => withUnit(this.value(name) ?? NaN, "counts");
    this.fanSays.textContent = `ir${this.sensor}: ${said(`ir${this.sensor}`)}, light${this.sensor}: ${said(`light${this.sensor}`)}`;
    this.describe();
  }
  /** What the pictures show, as text. */
  private describe() {
    const number = (name: string) => format(this.value(name) ?? NaN, unitOf(name));
    const each = (stem: string, count: number) =>
      Array.from({ length: count }, (_, i) => number(`${stem}${i}`)).join(", ");
    this.fan?.canvas.setAttribute("aria-label", `Proximity sensors ir0 to ir7, counts: ${each("ir", kSensors)}`);
    this.ears?.canvas.setAttribute(
      "aria-label",
      `Sound at microphones 0 to 2, counts: ${each("mic_level", 3)}; from ${number("sound_bearing")} degrees; loudspeaker ${number("speaker")} %`,
    );
  }

  // --- numbers

  private gauge(robot: Robot, name: string, least: number, most: number, more: HTMLElement[] = []) {
    const full = `${robot.name}.${name}`;
    const text = h("span", { className: "number" }),
      unit = h("span", { className: "unit" }, unitOf(name)),
      bar = h("div", {});
    this.gauges.set(full, { text, unit, bar, least, most });
    const row = h(
      "div",
      {
        className: "gauge",
        title: `${full}${unitOf(name) ? ", " + unitOf(name) : ""}; click to plot`,
        onclick: () => this.store.tell("plot", full),
      },
      h("button", { className: "name", onkeydown: (e: KeyboardEvent) => this.gaugeKey(e) }, name.replace(/^var:/, "")),
      h("div", { className: "track", "aria-hidden": "true" }, bar),
      text,
      unit,
      ...more,
    );
    return row;
  }
  /** Up and down go through the gauges. */
  private gaugeKey(e: KeyboardEvent) {
    if (e.key !== "ArrowDown" && e.key !== "ArrowUp") return;
    const all = [...document.querySelectorAll<HTMLElement>(".gauge .name")];
    e.preventDefault();
    all[all.indexOf(e.currentTarget as HTMLElement) + (e.key === "ArrowDown" ? 1 : -1)]?.focus();
  }
  private watches(robot: Robot): HTMLElement[] {
    const typed = h("input", {
      placeholder: "counter, speed[1], reg:T2CON, pin:D3",
      id: "watch",
      "aria-label": "Variable, register or pin to watch",
      title: "A global or static variable of the program, a register or a pin; Enter watches it",
      onchange: () => {
        if (typed.value.trim()) this.watch(robot.name, typed.value.trim());
      },
    });
    const change = async (v: string) => {
      const to = await askText(`${v} =`, String(this.value(watchName(v)) ?? ""));
      if (to !== undefined) this.client.do("set", { robot: robot.name, variable: v, value: Number(to) });
    };
    const forget = (v: string) => {
      this.watched.set(
        robot.name,
        this.watched.get(robot.name)!.filter((w) => w !== v),
      );
      this.store.tell("wanted");
      this.again();
    };
    const inner = (text: string, title: string, hidden: boolean, act: () => void) =>
      h(
        "button",
        { className: "tiny", title, "aria-label": title, hidden, onclick: (e: Event) => (e.stopPropagation(), act()) },
        text,
      );
    return [
      ...(this.watched.get(robot.name) ?? []).map((v) =>
        this.gauge(robot, watchName(v), 0, 0, [
          inner("=", `Change ${v}`, watchName(v) === v, () => void change(v)),
          inner("×", `${v}: no more`, false, () => forget(v)),
        ]),
      ),
      h("div", { className: "field" }, typed),
    ];
  }
  private async watch(robot: string, expression: string) {
    try {
      await this.client.ask("subscribe", { names: [`${robot}.${watchName(expression)}`] });
      this.watched.set(robot, [...(this.watched.get(robot) ?? []), expression]);
      (document.activeElement as HTMLElement)?.blur();
    } catch (e) {
      notice((e as Error).message, true);
    }
    this.store.tell("wanted");
    this.again();
  }
  private hands(robot: Robot): HTMLElement {
    return h(
      "details",
      { id: "hands" },
      h("summary", {}, "Remote control, battery"),
      h(
        "div",
        { className: "buttons" },
        ...kRemote.map(([text, key, title]) =>
          h(
            "button",
            {
              title: `Remote control: ${title} (${key})`,
              "aria-label": `Remote control: ${title}`,
              onclick: () => this.client.do("key", { robot: robot.name, key }),
            },
            text,
          ),
        ),
      ),
      field(
        "Battery",
        h("input", {
          type: "range",
          min: "3",
          max: "4.2",
          step: "0.05",
          value: "4",
          id: "battery",
          title: "Charge the battery to so many volts",
          onchange: (e: any) => this.client.do("battery", { robot: robot.name, volts: Number(e.target.value) }),
        }),
        "V",
      ),
    );
  }

  // --- what comes with looks and frames

  /** What numbers do not say: place, picture, parts. */
  showLook() {
    const { store } = this,
      { look } = store,
      robot = store.selectedRobot();
    if (!robot) return;
    const at = look?.place?.function === "?" ? undefined : look?.place,
      waits = robot.body >= 0 && (store.frame?.robotWords[2 * robot.body + 1] ?? 0) & RobotState.Waiting;
    const own = store.sourceOf(look);
    const line = at?.line ? `, ${own?.file ?? at.file.split("/").pop()}:${at.line}` : "";
    this.stands.textContent = at?.function ? `${waits ? "waits" : "is"} in ${at.function}()${line}` : "";
    this.stands.hidden = !at?.function;
    this.stands.disabled = !own;
    const picture = look?.picture;
    this.cameraBox.hidden = !picture;
    if (picture) {
      drawPicture(this.camera, picture);
      const bytes = `${picture.bytes_per_pixel} byte${picture.bytes_per_pixel > 1 ? "s" : ""} a pixel`;
      const says = `camera: ${picture.columns} × ${picture.rows}, ${bytes}, picture ${picture.number}`;
      this.camera.setAttribute("aria-label", says);
      // what is in the page already stays, or a focus would be lost
      if (!this.cameraBox.firstChild)
        this.cameraBox.replaceChildren(
          this.camera,
          h("small", {}),
          h(
            "button",
            { className: "tiny", title: "What it sees, in the scene (K)", onclick: () => this.toggleView() },
            "Show in scene",
          ),
        );
      this.cameraBox.querySelector("small")!.textContent = says;
    }
    this.showParts(robot);
  }
  private showParts(robot: Robot) {
    const { store } = this,
      { look } = store;
    const said = JSON.stringify([robot.id, robot.parts, look?.parts]);
    if (this.parts.dataset.said === said) return;
    this.parts.dataset.said = said;
    const kinds = store.schema["robot.part"]?.kinds ?? [];
    const inner = (op: string, more: Record<string, unknown>) =>
      this.client.edit({ op, thing: robot.id, path: "robot.part", ...more });
    const add = h(
      "select",
      {
        id: "add-part",
        "aria-label": "Add a part",
        title: "Plug a part into the robot",
        onchange: () => inner("add_inner", { values: { kind: add.value } }),
      },
      h("option", { value: "" }, "Add a part…"),
      ...kinds.map((k) => h("option", { value: k.kind, title: k.doc }, k.kind)),
    );
    this.parts.replaceChildren(
      ...robot.parts.map((kind, i) =>
        h(
          "div",
          { className: "field part" },
          h("span", {}, kind),
          h("span", { className: "number" }, look?.parts[i]?.shows ?? ""),
          h(
            "button",
            {
              className: "tiny",
              title: "Unplug it",
              "aria-label": `Unplug ${kind}`,
              onclick: () => inner("remove_inner", { index: i }),
            },
            "×",
          ),
        ),
      ),
      ...(kinds.length > 0 ? [add] : []),
    );
  }
  toggleView() {
    this.store.showView = !this.store.showView;
    this.store.showLook(this.store.look);
  }
  update(robot: Robot) {
    if (robot !== this.robot) this.robot = robot;
    const value = (name: string) => this.value(name);
    const x = value("x"),
      heading = value("heading");
    if (x !== undefined)
      this.place.textContent = `x ${withUnit(x, "m")}   y ${withUnit(value("y")!, "m")}   ${(((heading! % 360) + 360) % 360).toFixed(0)}°`;
    const at = value("selector");
    if (at !== undefined && document.activeElement !== this.selector) {
      this.selector.value = String(at);
      this.selectorSays.textContent = String(at);
    }
    for (const [name, g] of this.gauges) {
      const v = this.store.values.get(name);
      if (v === undefined) continue;
      const unit = this.store.units.get(name) || unitOf(name);
      g.text.textContent = format(v, unit);
      if (g.unit.textContent !== unit) g.unit.textContent = unit;
      const share = g.most > g.least ? Math.min(1, Math.max(0, (v - g.least) / (g.most - g.least))) : 0;
      g.bar.style.width = `${(100 * share).toFixed(1)}%`;
    }
    if (this.fan) drawFan(this.fan, robot, this.store.leds(robot.body), value);
    if (this.ears) drawEars(this.ears, value);
    if (document.activeElement === this.fan?.canvas) this.sayFan();
  }
}
