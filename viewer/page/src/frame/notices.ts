// SPDX-License-Identifier: MIT
// What the page says by itself: notices that go by themselves, and questions that wait for an answer.
import { byId, h } from "../dom";

let timer = 0;
let no: (() => void) | undefined; // to the question that stands

export function notice(text: string, bad = false, stays = false) {
  const box = byId("notice");
  box.textContent = text;
  box.className = bad ? "bad shown" : "shown";
  clearTimeout(timer);
  if (!stays) timer = window.setTimeout(() => (box.className = ""), bad ? 8000 : 2500);
}

export interface Choice<T> {
  id: string;
  text: string;
  value: T;
  strong?: boolean;
  hidden?: boolean;
}
/** Puts a question; the last one takes the place of any before. */
function put<T>(fill: (answer: (value?: T) => void) => Node[], label: string): Promise<T | undefined> {
  return new Promise((done) => {
    const box = byId("question"),
      at = document.activeElement as HTMLElement | null,
      // what the mouse has pressed does not get the keys back
      before = at?.matches("button:not(:focus-visible)") ? undefined : at;
    const answer = (value?: T) => {
      const inside = box.contains(document.activeElement);
      box.replaceChildren();
      no = undefined;
      if (inside) before?.focus?.();
      done(value);
    };
    no?.();
    no = () => answer();
    box.setAttribute("aria-label", label);
    box.replaceChildren(...fill(answer));
  });
}
/** What a person chooses; undefined: nothing. */
export function question<T>(text: string, choices: Choice<T>[]): Promise<T | undefined> {
  return put((answer) => {
    const buttons = choices
      .filter((c) => !c.hidden)
      .map((c) =>
        h("button", { id: c.id, className: c.strong ? "strong" : "", onclick: () => answer(c.value) }, c.text),
      );
    queueMicrotask(() => buttons[0]?.focus());
    return [h("span", {}, text), ...buttons];
  }, text);
}
/** A text that a person types; undefined: none. */
export function askText(text: string, value: string): Promise<string | undefined> {
  return put((answer) => {
    const input = h("input", {
      id: "question-text",
      value,
      "aria-label": text,
      onkeydown: (e: KeyboardEvent) => {
        if (e.key === "Enter") answer(input.value.trim() || undefined);
        if (e.key === "Escape") answer();
        e.stopPropagation();
      },
    });
    queueMicrotask(() => {
      input.focus();
      input.select();
    });
    return [
      h("span", {}, text),
      input,
      h(
        "button",
        { id: "question-yes", className: "strong", onclick: () => answer(input.value.trim() || undefined) },
        "OK",
      ),
      h("button", { id: "leave", onclick: () => answer() }, "Leave it"),
    ];
  }, text);
}
/** No to whatever is asked. */
export function dismiss() {
  no?.();
}
/** Shall the run, which would be lost, begin anew? */
export const beginAnew = (message: string) =>
  question(message, [
    { id: "anew", text: "Begin anew", value: true, strong: true },
    { id: "leave", text: "Leave it", value: false },
  ]);
