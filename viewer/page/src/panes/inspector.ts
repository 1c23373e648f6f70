// SPDX-License-Identifier: MIT
// Beside the scene: a robot with its sensors, lights and selector, or a thing with the keys of its piece of the
// world file.
import { byId, h } from "../dom";
import { notice } from "../frame/notices";
import type { KeySpec, Robot, Thing } from "../link/protocol";
import { readLiteral, RobotState } from "../link/protocol";
import type { Pieces } from "../store/pieces";
import type { Client } from "../store/client";
import type { Store } from "../store/store";
import { drawEars, drawFan, drawPicture } from "./senses";

const kSwatches: [string, number[]][] = [
  ["black", [0, 0, 0]],
  ["white", [1, 1, 1]],
  ["grey", [0.5, 0.5, 0.5]],
  ["red", [0.85, 0.1, 0.1]],
  ["green", [0.1, 0.6, 0.25]],
  ["blue", [0.1, 0.3, 0.8]],
  ["yellow", [0.95, 0.8, 0.1]],
];
const kGauges: [string, string, number, number][] = [
  ["speed", "m/s", 0, 0.13],
  ["battery", "V", 3, 4.2],
  ["charge", "%", 0, 100],
  ["current", "mA", 0, 800],
  ["load", "%", 0, 100],
  ["left_steps", "steps", 0, 0],
  ["right_steps", "steps", 0, 0],
  ["distance", "m", 0, 0],
  ["collisions", "", 0, 0],
  ["acc_x", "counts", 0, 4095],
  ["acc_y", "counts", 0, 4095],
  ["acc_z", "counts", 0, 4095],
  ["mic0", "counts", 0, 4095],
  ["mic1", "counts", 0, 4095],
  ["mic2", "counts", 0, 4095],
];
// codes of RC-5, as televisions' remote controls send them
const kRemote: [string, number, string][] = [
  ...Array.from({ length: 10 }, (_, i): [string, number, string] => [
    String((i + 1) % 10),
    (i + 1) % 10,
    `key ${(i + 1) % 10}`,
  ]),
  ["⏻", 12, "standby"],
  ["V+", 16, "volume up"],
  ["V−", 17, "volume down"],
  ["P+", 32, "programme up"],
  ["P−", 33, "programme down"],
];
/** The protocol's name of what was typed: a variable, unless it says reg: or pin:. */
const watchName = (typed: string) => (/^(reg|pin):/.test(typed) ? typed : `var:${typed}`);

const hex = (c: number[]) =>
  "#" +
  c
    .slice(0, 3)
    .map((v) =>
      Math.round(255 * Math.min(1, Math.max(0, v)))
        .toString(16)
        .padStart(2, "0"),
    )
    .join("");
const fromHex = (s: string) => [1, 3, 5].map((i) => Math.round((parseInt(s.slice(i, i + 2), 16) / 255) * 1000) / 1000);

export class Inspector {
  private shown = -1;
  private fan?: CanvasRenderingContext2D;
  private ears?: CanvasRenderingContext2D;
  private camera = h("canvas", { id: "camera", title: "What the program got from its camera last" });
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
  private gauges = new Map<
    string,
    { text: HTMLElement; bar: HTMLElement; least: number; most: number; unit: string }
  >();
  private watched = new Map<string, string[]>(); // per robot: expressions
  private place?: HTMLElement;
  private selector?: { knob: HTMLInputElement; label: HTMLElement };

  constructor(
    private store: Store,
    private client: Client,
    private pieces: Pieces,
  ) {
    store.wanted.push(() => this.names());
    store.on("selection", () => this.show());
    store.on("pulse", () => this.update());
    store.on("look", () => this.showLook());
    store.on("theme", () => this.update());
  }

  /** Names that the robot that is shown wants in every frame. */
  names(): string[] {
    const robot = this.store.selectedRobot();
    if (!robot) return [];
    const own = [
      "x",
      "y",
      "heading",
      "selector",
      "sound_bearing",
      "speaker",
      "mic_level0",
      "mic_level1",
      "mic_level2",
      ...kGauges.map((g) => g[0]),
    ];
    for (let i = 0; i < 8; ++i) own.push(`ir${i}`, `light${i}`);
    return [...own, ...(this.watched.get(robot.name) ?? []).map(watchName)].map((n) => `${robot.name}.${n}`);
  }

  show() {
    const robot = this.store.selectedRobot(),
      thing = this.store.selectedThing();
    const editing = document.activeElement?.closest("#inspector input,#inspector select");
    if (editing && this.shown === this.store.selected) return;
    this.shown = this.store.selected;
    this.gauges.clear();
    this.fan = this.ears = undefined;
    this.parts.dataset.said = "";
    byId("inspector").replaceChildren(...(robot ? this.robot(robot) : thing ? this.thing(thing) : this.worldPane()));
    this.showLook();
    this.update();
  }

  private worldPane(): HTMLElement[] {
    const w = this.store.world;
    return [
      h("h2", {}, w.title || "World"),
      h("p", { className: "dim" }, w.file),
      h("p", {}, "Click a robot or a thing to see and change it. Add things from the palette on the left."),
      h("h3", {}, "Robots"),
      h(
        "ul",
        { className: "list" },
        ...w.robots.map((r) =>
          h(
            "li",
            {},
            h(
              "button",
              { className: "row", onclick: () => this.store.select(r.id) },
              h("i", { style: `background:${hex(r.colour)}` }),
              `${r.name}`,
              h("small", {}, r.firmware || "no program"),
            ),
          ),
        ),
      ),
      h("h3", {}, "Things"),
      h(
        "ul",
        { className: "list" },
        ...w.things.map((t) =>
          h(
            "li",
            {},
            h(
              "button",
              { className: "row", onclick: () => this.store.select(t.id) },
              h("i", { style: `background:${hex(t.colour)}` }),
              t.name || t.kind,
              h("small", {}, t.kind),
            ),
          ),
        ),
      ),
      ...this.keys("arena"),
      ...this.keys("world"),
      ...this.keys("proximity"),
    ];
  }

  private robot(robot: Robot): HTMLElement[] {
    const canvas = h("canvas", {
      width: 640,
      height: 440,
      id: "fan",
      title:
        "Proximity sensors: the fuller a wedge, the nearer something is (counts, 0 to 4095). Numbers are ir0 to ir7.",
    });
    this.fan = canvas.getContext("2d")!;
    const ears = h("canvas", {
      width: 640,
      height: 200,
      id: "ears",
      title:
        "Sound at the three microphones (counts, root mean square, without their noise), the arrow whence it comes; and what the loudspeaker plays, % of full scale",
    });
    this.ears = ears.getContext("2d")!;
    const selector = h("input", {
      type: "range",
      min: "0",
      max: "15",
      value: "0",
      id: "selector",
      title: "Selector, 0 to 15: turn it while the program runs",
      oninput: () => {
        label.textContent = selector.value;
        this.client.do("selector", { robot: robot.name, position: Number(selector.value) });
      },
    }) as HTMLInputElement;
    const label = h("b", { id: "selector-value" });
    this.selector = { knob: selector, label };
    const gauge = ([name, unit, least, most]: (typeof kGauges)[number]) => {
      const text = h("span", { className: "number" }),
        bar = h("div", {});
      this.gauges.set(`${robot.name}.${name}`, { text, bar, least, most, unit });
      return h(
        "div",
        {
          className: "gauge",
          title: `${robot.name}.${name}${unit ? ", " + unit : ""}; click to plot`,
          onclick: () => this.store.tell("plot", `${robot.name}.${name}`),
        },
        h("label", {}, name),
        h("div", { className: "track" }, bar),
        text,
      );
    };
    const variable = h("input", {
      placeholder: "counter, speed[1], reg:T2CON, pin:D3",
      id: "watch",
      title: "A global or static variable of the program, a register or a pin; Enter watches it",
      onchange: () => {
        if (variable.value.trim()) this.watch(robot.name, variable.value.trim());
      },
    }) as HTMLInputElement;
    this.place = h("p", { className: "dim number" });
    return [
      h(
        "h2",
        {},
        h("i", { style: `background:${hex(robot.colour)}` }),
        robot.name,
        h("small", {}, this.store.programOf(robot) || "no program"),
      ),
      this.place,
      this.stands,
      h(
        "div",
        { className: "buttons" },
        h(
          "button",
          { onclick: () => this.client.do("reset", { robot: robot.name }), title: "The robot's reset button" },
          "Reset",
        ),
        h(
          "button",
          {
            onclick: () => this.client.toggleRays(robot.name),
            title: "Rays of its proximity sensors (Y for all robots)",
          },
          "Rays",
        ),
        h("button", { onclick: () => this.store.tell("follow", robot.name), title: "The view goes with it" }, "Follow"),
        h("button", { onclick: () => this.store.tell("show", "program"), title: "Its source" }, "Program"),
        h("button", { onclick: () => this.pieces.copy(), title: "Copy (Ctrl D)" }, "Copy"),
        h("button", { onclick: () => this.pieces.remove(), title: "Delete (Del)" }, "Delete"),
      ),
      canvas,
      h("div", { className: "field" }, h("label", {}, "Selector"), selector, label),
      this.cameraBox,
      ears,
      this.parts,
      ...kGauges.map(gauge),
      h("h3", {}, "Variables, registers, pins"),
      ...(this.watched.get(robot.name) ?? []).map((v) => {
        const row = gauge([watchName(v), "", 0, 0]);
        row.append(
          h(
            "button",
            {
              className: "tiny",
              title: "Change it",
              hidden: watchName(v) === v,
              onclick: (e: Event) => {
                e.stopPropagation();
                const to = prompt(`${v} =`);
                if (to) this.client.do("set", { robot: robot.name, variable: v, value: Number(to) });
              },
            },
            "=",
          ),
          h(
            "button",
            {
              className: "tiny",
              title: "No more",
              onclick: (e: Event) => {
                e.stopPropagation();
                this.watched.set(
                  robot.name,
                  this.watched.get(robot.name)!.filter((w) => w !== v),
                );
                this.client.subscribe();
                this.show();
              },
            },
            "×",
          ),
        );
        return row;
      }),
      h("div", { className: "field" }, variable),
      h(
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
                onclick: () => this.client.do("key", { robot: robot.name, key }),
              },
              text,
            ),
          ),
        ),
        h(
          "div",
          { className: "field" },
          h("label", {}, "Battery"),
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
          h("span", { className: "unit" }, "V"),
        ),
      ),
      ...this.keys("robot", robot.id),
    ];
  }

  /** What numbers do not say: place, picture, parts. */
  showLook() {
    const { look } = this.store,
      robot = this.store.selectedRobot();
    if (!robot) return;
    const at = look?.place,
      waits = (this.store.frame?.robotWords[2 * robot.body + 1] ?? 0) & RobotState.Waiting;
    const own = this.store.sourceOf(look);
    this.stands.textContent = !at?.function
      ? ""
      : `${waits ? "waits" : "is"} in ${at.function}()${at.line ? `, ${own?.file ?? at.file.split("/").pop()}:${at.line}` : ""}`;
    this.stands.hidden = !at?.function;
    this.stands.disabled = !own;
    const picture = look?.picture;
    this.cameraBox.hidden = !picture;
    if (picture) {
      drawPicture(this.camera, picture);
      this.cameraBox.replaceChildren(
        this.camera,
        h(
          "small",
          {},
          `camera: ${picture.columns} × ${picture.rows}, ${picture.bytes_per_pixel} byte${picture.bytes_per_pixel > 1 ? "s" : ""} a pixel, picture ${picture.number}`,
        ),
        h(
          "button",
          { className: "tiny", title: "What it sees, in the scene (K)", onclick: () => this.toggleView() },
          "Show in scene",
        ),
      );
    }
    const said = JSON.stringify([robot.parts, look?.parts]);
    if (this.parts.dataset.said === said) return;
    this.parts.dataset.said = said;
    const kinds = this.store.schema["robot.part"]?.kinds ?? [];
    const add = h(
      "select",
      {
        id: "add-part",
        title: "Plug a part into the robot",
        onchange: () =>
          this.client.edit({
            op: "add_inner",
            thing: robot.id,
            path: "robot.part",
            values: { kind: (add as HTMLSelectElement).value },
          }),
      },
      h("option", { value: "" }, "Add a part…"),
      ...kinds.map((k) => h("option", { value: k.kind, title: k.doc }, k.kind)),
    );
    this.parts.replaceChildren(
      ...robot.parts.map((kind, i) =>
        h(
          "div",
          { className: "field part" },
          h("label", {}, kind),
          h("span", { className: "number" }, look?.parts[i]?.shows ?? ""),
          h(
            "button",
            {
              className: "tiny",
              title: "Unplug it",
              onclick: () => this.client.edit({ op: "remove_inner", thing: robot.id, path: "robot.part", index: i }),
            },
            "×",
          ),
        ),
      ),
      ...(kinds.length > 0 ? [add] : []),
    );
  }

  private async watch(robot: string, expression: string) {
    try {
      await this.client.ask("subscribe", { names: [`${robot}.${watchName(expression)}`] });
      this.watched.set(robot, [...(this.watched.get(robot) ?? []), expression]);
      (document.activeElement as HTMLElement)?.blur();
    } catch (e) {
      notice((e as Error).message, true);
    }
    this.client.subscribe();
    this.shown = -1;
    this.show();
  }

  private thing(thing: Thing): HTMLElement[] {
    const element = this.store.world.elements.find((e) => e.id === thing.id);
    return [
      h(
        "h2",
        {},
        h("i", { style: `background:${hex(thing.colour)}` }),
        thing.name || thing.kind,
        h("small", {}, `${thing.kind}, line ${element?.line}`),
      ),
      h(
        "div",
        { className: "buttons" },
        h("button", { onclick: () => this.pieces.copy(), title: "Copy (Ctrl D)" }, "Copy"),
        h("button", { onclick: () => this.pieces.turn(15), title: "Turn by 15 degrees (E, back: Q)" }, "Turn"),
        h("button", { onclick: () => this.pieces.remove(), title: "Delete (Del)" }, "Delete"),
      ),
      h("h3", {}, "Paint"),
      h(
        "div",
        { className: "swatches" },
        ...kSwatches.map(([name, colour]) =>
          h("button", {
            style: `background:${hex(colour)}`,
            title: name,
            "aria-label": `paint ${name}`,
            onclick: () => this.client.set(thing.id, { colour }),
          }),
        ),
      ),
      ...this.keys(element?.path ?? thing.kind, thing.id),
    ];
  }

  /** The keys that the format has for a piece; written ones filled in. */
  private keys(path: string, id?: number): HTMLElement[] {
    const element = this.store.world.elements.find((e) => (id ? e.id === id : e.path === path));
    const section = this.store.schema[path];
    if (!element || !section) return [];
    const written = section.keys.filter((k) => k.key in element.values),
      rest = section.keys.filter((k) => !(k.key in element.values));
    const row = (k: KeySpec) => this.key(element.id, k, element.values[k.key]);
    return [
      h("h3", {}, id ? "In the world file" : `[${path}]`),
      ...written.map(row),
      rest.length > 0 && h("details", {}, h("summary", {}, `${rest.length} more keys`), ...rest.map(row)),
    ].filter((e): e is HTMLElement => !!e);
  }

  private key(id: number, k: KeySpec, literal?: string): HTMLElement {
    const value = literal === undefined ? undefined : readLiteral(literal);
    const send = (v: unknown) => this.client.set(id, { [k.key]: v });
    const title = `${k.doc}${k.unit ? ", " + k.unit : ""}${k.range ? `, ${k.range[0]} to ${k.range[1]}` : ""}${k.default && k.default !== "required" ? "; otherwise " + k.default : ""}`;
    let input: HTMLElement;
    if (k.type === "colour") {
      input = h("input", {
        type: "color",
        value: value ? hex(value) : "#ffffff",
        onchange: (e: any) => send(fromHex(e.target.value)),
      });
    } else if (k.type === "flag") {
      input = h("input", { type: "checkbox", checked: value === true, onchange: (e: any) => send(e.target.checked) });
    } else if (k.type === "choice") {
      input = h(
        "select",
        { onchange: (e: any) => send(e.target.value || null) },
        h("option", { value: "" }, ""),
        ...k.choices!.split("|").map((c) => h("option", { value: c, selected: c === value }, c)),
      );
    } else {
      const text = k.type === "text";
      input = h("input", {
        value: literal === undefined ? "" : text ? String(value ?? literal) : literal.replace(/\s+/g, " "),
        placeholder: k.default === "required" ? "" : k.default.replace(/"/g, ""),
        "data-key": k.key,
        onchange: (e: any) => {
          const typed = e.target.value.trim();
          const v = typed === "" ? null : text ? typed : readLiteral(typed);
          if (v === undefined) return notice(`${k.key}: got '${typed}', expected ${k.type}`, true);
          send(v);
          e.target.blur();
        },
      });
    }
    return h(
      "div",
      { className: "field", title },
      h("label", {}, k.key),
      input,
      h("span", { className: "unit" }, k.unit),
    );
  }

  toggleView() {
    this.store.showView = !this.store.showView;
    this.store.showLook(this.store.look);
  }
  update() {
    const robot = this.store.selectedRobot();
    if (!robot) return;
    const value = (name: string) => this.store.values.get(`${robot.name}.${name}`);
    if (this.place && value("x") !== undefined)
      this.place.textContent = `x ${value("x")!.toFixed(3)} m   y ${value("y")!.toFixed(3)} m   ${(((value("heading")! % 360) + 360) % 360).toFixed(0)}°`;
    if (this.selector && value("selector") !== undefined && document.activeElement !== this.selector.knob) {
      this.selector.knob.value = String(value("selector"));
      this.selector.label.textContent = String(value("selector"));
    }
    for (const [name, g] of this.gauges) {
      const v = this.store.values.get(name);
      if (v === undefined) continue;
      g.text.textContent = Number.isInteger(v) ? String(v) : v.toFixed(3);
      g.bar.style.width =
        g.most > g.least ? `${(100 * Math.min(1, Math.max(0, (v - g.least) / (g.most - g.least)))).toFixed(1)}%` : "0";
    }
    if (this.fan) drawFan(this.fan, robot, this.store.leds(robot.body), value);
    if (this.ears) drawEars(this.ears, value);
  }
}
