// SPDX-License-Identifier: MIT
// Rows for the keys of a section of the world file, from the format's own table.
import { h } from "../dom";
import { notice } from "../frame/notices";
import type { KeySpec } from "../link/protocol";
import { readLiteral } from "../link/protocol";
import type { Client } from "../store/client";
import type { Store } from "../store/store";

export const hex = (c: number[]) =>
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

/** What a sheet begins with: whose it is, and what is wrong with it. */
export const headOf = (colour: number[], name: string, small: string, wrong?: { text: string }) => [
  h("h2", {}, h("i", { style: `background:${hex(colour)}` }), name, h("small", {}, small)),
  ...(wrong ? [h("p", { className: "bad" }, `⚠ ${wrong.text}`)] : []),
];

let fields = 0;
/** A label, what it is of, a unit. */
export function field(text: string, input: HTMLElement, unit = "", title = ""): HTMLElement {
  input.id ||= `field-${++fields}`;
  return h(
    "div",
    { className: "field", title },
    h("label", { htmlFor: input.id }, text),
    input,
    h("span", { className: "unit" }, unit),
  );
}

const titleOf = (k: KeySpec) =>
  k.doc +
  (k.unit ? ", " + k.unit : "") +
  (k.range ? `, ${k.range[0]} to ${k.range[1]}` : "") +
  (k.default && k.default !== "required" ? "; otherwise " + k.default : "");

export class Fields {
  constructor(
    private store: Store,
    private client: Client,
  ) {}

  /** The keys that the format has for a piece, or for a section that is there once; written ones first. A section that
   * the file does not have is there, too: what is typed in it adds it. */
  of(path: string, id?: number): HTMLElement[] {
    const { world, schema } = this.store;
    const element = world.elements.find((e) => (id ? e.id === id : e.path === path)),
      section = schema[path];
    if (!section || (id && !element)) return [];
    const values = element?.values ?? {};
    const written = section.keys.filter((k) => k.key in values),
      rest = section.keys.filter((k) => !(k.key in values));
    const row = (k: KeySpec) => this.row(path, element?.id, k, values[k.key]);
    const more = rest.length > 0 && this.details(`${path} more`, false, `${rest.length} more keys`, rest.map(row));
    if (id) return [h("h3", {}, "In the world file"), ...written.map(row), ...(more ? [more] : [])];
    const title = [`[${path}]`, h("small", {}, element ? ` line ${element.line}` : " not in the file")];
    const inside = [
      h("p", { className: "dim" }, section.doc),
      ...written.map(row),
      ...(written.length ? (more ? [more] : []) : rest.map(row)),
    ];
    const box = this.details(path, !!element && kOpenAtFirst.includes(path), title, inside);
    box.classList.add("section");
    box.title = section.doc;
    return [box];
  }
  /** Open as a person has left it, also when all is shown anew. */
  private details(name: string, open: boolean, title: string | (string | HTMLElement)[], inside: HTMLElement[]) {
    const box = h("details", { open: this.opened.get(name) ?? open }, h("summary", {}, ...[title].flat()), ...inside);
    box.addEventListener("toggle", () => this.opened.set(name, box.open));
    return box;
  }
  private opened = new Map<string, boolean>();

  private send(path: string, id: number | undefined, key: string, value: unknown) {
    if (id) return this.client.set(id, { [key]: value });
    if (value === null) return undefined;
    // what could be typed in a section without a line goes on being there
    this.opened.set(`${path} more`, true);
    return this.client.edit({ op: "add", path, values: { [key]: value } });
  }
  private row(path: string, id: number | undefined, k: KeySpec, literal?: string): HTMLElement {
    const value = literal === undefined ? undefined : readLiteral(literal);
    const send = (v: unknown) => this.send(path, id, k.key, v);
    let input: HTMLElement;
    if (k.type === "colour") {
      input = h("input", {
        type: "color",
        value: value ? hex(value) : "#ffffff",
        onchange: (e: any) => send(fromHex(e.target.value)),
      });
    } else if (k.type === "flag") {
      const checked = value === undefined ? k.default === "true" : value === true;
      input = h("input", { type: "checkbox", checked, onchange: (e: any) => send(e.target.checked) });
    } else if (k.type === "choice") {
      const other =
        k.default && k.default !== "required" ? `${k.default.replace(/"/g, "")} (not written)` : "not written";
      input = h(
        "select",
        { onchange: (e: any) => send(e.target.value || null) },
        h("option", { value: "" }, other),
        ...k.choices!.split("|").map((c) => h("option", { value: c, selected: c === value }, c)),
      );
    } else {
      const text = k.type === "text";
      input = h("input", {
        value: literal === undefined ? "" : text ? String(value ?? literal) : literal.replace(/\s+/g, " "),
        placeholder: k.default === "required" ? "" : k.default.replace(/"/g, ""),
        onchange: (e: any) => {
          const typed = e.target.value.trim();
          const v = typed === "" ? null : text ? typed : readLiteral(typed);
          if (v === undefined) return notice(`${k.key}: got '${typed}', expected ${k.type}`, true);
          send(v);
          e.target.blur();
        },
      });
    }
    input.dataset.key = k.key;
    input.dataset.section = path;
    return field(k.key, input, k.unit, titleOf(k));
  }
}
const kOpenAtFirst = ["arena", "world"];
