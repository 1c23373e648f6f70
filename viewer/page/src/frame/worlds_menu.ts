// SPDX-License-Identifier: MIT
// Which world: the files of this folder, examples, a new one.
import { h } from "../dom";
import type { Client } from "../store/client";
import { notice } from "./notices";
import type { WorldFile } from "./save";

interface Listed {
  file: string;
  title: string;
}

export function worldsMenu(client: Client, file: WorldFile): HTMLElement {
  const list = h("div", { id: "worlds", role: "menu", hidden: true, "aria-label": "Worlds" });
  const close = () => {
    list.hidden = true;
    button.setAttribute("aria-expanded", "false");
  };
  const item = (text: string, more: string, act: () => unknown, id = "") =>
    h(
      "button",
      {
        id,
        className: "row",
        role: "menuitem",
        onclick: () => {
          close();
          void act();
        },
      },
      text,
      h("small", {}, more),
    );
  const open = async () => {
    let answer;
    try {
      answer = await client.ask("worlds");
    } catch (e) {
      return notice((e as Error).message, true);
    }
    const section = (title: string, worlds: Listed[]) =>
      worlds.length
        ? [h("h3", {}, title), ...worlds.map((w) => item(w.file.split("/").pop()!, w.title, () => file.open(w.file)))]
        : [];
    list.replaceChildren(
      item("New world…", "an empty arena, in this folder", () => file.fresh(), "new-world"),
      ...section("In this folder", answer.here ?? []),
      ...section("Examples", answer.examples ?? []),
    );
    list.hidden = false;
    button.setAttribute("aria-expanded", "true");
    (list.firstElementChild as HTMLElement).focus();
  };
  const button = h(
    "button",
    {
      id: "open-world",
      title: "Open another world, an example, or a new one",
      "aria-haspopup": "menu",
      "aria-expanded": "false",
      onclick: () => (list.hidden ? void open() : close()),
    },
    "Open…",
  );
  list.addEventListener("keydown", (e) => {
    const items = [...list.querySelectorAll<HTMLElement>("button")],
      at = items.indexOf(document.activeElement as HTMLElement);
    if (e.key === "Escape") {
      close();
      button.focus();
    } else if (e.key === "ArrowDown") items[(at + 1) % items.length]?.focus();
    else if (e.key === "ArrowUp") items[(at + items.length - 1) % items.length]?.focus();
    else return;
    e.preventDefault();
    e.stopPropagation();
  });
  addEventListener("pointerdown", (e) => {
    if (!box.contains(e.target as Node)) close();
  });
  const box = h("span", { className: "menu" }, button, list);
  return box;
}
