// SPDX-License-Identifier: MIT
// Elements in one line.

type Child = Node | string | undefined | false;
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  props: Record<string, any> = {},
  ...children: Child[]
) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(props)) {
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (key in element && key !== "list") (element as any)[key] = value;
    else element.setAttribute(key, value);
  }
  element.append(...children.filter((c): c is Node | string => c !== undefined && c !== false));
  return element;
}
const kIcons: Record<string, string> = {
  over: '<path d="M2 8a6 6 0 0111-3V2h2v7H8V7h3.600A4 4 0 004 8zM7 12h3v3H7z"/>',
  in: '<path d="M7 1h2v6h3l-4 5-4-5h3zM3 13h10v2H3z"/>',
  out: '<path d="M8 1l4 5H9v6H7V6H4zM3 13h10v2H3z"/>',
  back: '<path d="M14 8A6 6 0 003 5V2H1v7h7V7H4.400A4 4 0 0112 8zM6 12h3v3H6z"/>',
  reverse: '<path d="M12 2.500v11L3 8z"/>',
  restart: '<path d="M3 3h2v10H3zM13 3v10L6 8z"/>',
  play: '<path d="M4 2.5v11L13 8z"/>',
  pause: '<path d="M4 3h3v10H4zM9 3h3v10H9z"/>',
  step: '<path d="M3 3v10l7-5zM11 3h2v10h-2z"/>',
  irq: '<path d="M9 1L3 9h4l-1 6 6-8H8z"/>',
  undo: '<path d="M6 3L2 7l4 4V8h4a2.5 2.5 0 010 5H6v2h4a4.5 4.5 0 000-9H6z"/>',
  redo: '<path d="M10 3l4 4-4 4V8H6a2.5 2.5 0 000 5h4v2H6a4.5 4.5 0 010-9h4z"/>',
  select: '<path d="M3 1l10 7-4.6.8L11 14l-2 1-2.500-5.300L3 13z"/>',
  wall: '<path d="M1 11L13 3l2 2.500L3 13.500z"/>',
  box: '<path d="M3 3h10v10H3z"/>',
  cylinder: '<circle cx="8" cy="8" r="6"/>',
  ball: '<path fill-rule="evenodd" d="M8 2a6 6 0 110 12A6 6 0 018 2zM6 4.500a2 2 0 100 3.500 2 2 0 000-3.500z"/>',
  lamp: '<circle cx="8" cy="8" r="3"/><path d="M7.200 0h1.600v3.500H7.200zM7.200 12.500h1.600V16H7.200zM0 7.200h3.500v1.600H0zM12.500 7.200H16v1.600h-3.500z"/>',
  robot: '<path fill-rule="evenodd" d="M8 1a7 7 0 110 14A7 7 0 018 1zm0 2.500L5 10l3-1.500L11 10z"/>',
  theme: '<path fill-rule="evenodd" d="M8 1a7 7 0 110 14A7 7 0 018 1zm0 2v10A5 5 0 008 3z"/>',
};
/** A picture of our own for a button: fonts differ in what signs they have. */
export function icon(name: string): Element | string {
  if (!kIcons[name]) return "";
  const box = document.createElement("template");
  box.innerHTML = `<svg viewBox="0 0 16 16" width="1.05em" height="1.05em" fill="currentColor" aria-hidden="true">${kIcons[name]}</svg>`;
  return box.content.firstElementChild!;
}
export const byId = (id: string) => document.getElementById(id)!;
export const css = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
