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
}
/** What a person chooses; undefined: nothing. A later question takes the place of this one. */
export function question<T>(text: string, choices: Choice<T>[]): Promise<T | undefined> {
  return new Promise((done) => {
    const answer = (value?: T) => {
      byId("question").replaceChildren();
      no = undefined;
      done(value);
    };
    no?.();
    no = () => answer();
    byId("question").replaceChildren(
      h("span", {}, text),
      ...choices.map((c) =>
        h("button", { id: c.id, className: c.strong ? "strong" : "", onclick: () => answer(c.value) }, c.text),
      ),
    );
  });
}
/** No to whatever is asked. */
export function dismiss() {
  no?.();
}
