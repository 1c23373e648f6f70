// SPDX-License-Identifier: MIT
// Bytes of a serial line as text that people read, and text that people type as bytes. A byte is a character up to
// U+00FF, as in docs/connecting.md.

const kHex = (byte: number) => `\\x${byte.toString(16).padStart(2, "0")}`;
const kShort: Record<number, string> = { 0: "\\0", 7: "\\a", 8: "\\b", 11: "\\v", 12: "\\f" };

/** A control character as an escape; tabs and ends of lines stay. */
export function readable(text: string): string {
  return text.replace(/[\0-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f]/g, (c) => kShort[c.charCodeAt(0)] ?? kHex(c.charCodeAt(0)));
}

/** How many bytes a character of UTF-8 has that begins so; 0: none begins so. */
const lengthOf = (first: number) =>
  first < 0x80
    ? 1
    : first >= 0xc2 && first < 0xe0
      ? 2
      : first >= 0xe0 && first < 0xf0
        ? 3
        : first >= 0xf0 && first < 0xf5
          ? 4
          : 0;
/** The least and the most that the second byte may be: neither too long nor a surrogate nor beyond U+10FFFF. */
function secondOf(first: number): [number, number] {
  if (first === 0xe0) return [0xa0, 0xbf];
  if (first === 0xed) return [0x80, 0x9f];
  if (first === 0xf0) return [0x90, 0xbf];
  if (first === 0xf4) return [0x80, 0x8f];
  return [0x80, 0xbf];
}

/** UTF-8 that comes in pieces. What is none is shown byte by byte. */
export class Utf8Pieces {
  private begun = ""; // of a character that is not complete

  get waits() {
    return this.begun !== "";
  }
  take(bytes: string): string {
    const all = this.begun + bytes;
    this.begun = "";
    let out = "";
    for (let i = 0; i < all.length;) {
      const first = all.charCodeAt(i),
        length = lengthOf(first);
      let good = length > 0 ? 1 : 0;
      while (good && good < length && i + good < all.length) {
        const next = all.charCodeAt(i + good),
          [least, most] = good === 1 ? secondOf(first) : [0x80, 0xbf];
        if (next < least || next > most) break;
        ++good;
      }
      if (good && good < length && i + good === all.length) {
        this.begun = all.slice(i);
        break;
      }
      if (good === length && good) {
        let code = length === 1 ? first : first & (0xff >> (length + 1));
        for (let k = 1; k < length; ++k) code = (code << 6) | (all.charCodeAt(i + k) & 0x3f);
        out += String.fromCodePoint(code);
        i += length;
      } else {
        out += kHex(first);
        ++i;
      }
    }
    return readable(out);
  }
  /** Nothing more has come of a character: its bytes. */
  flush(): string {
    const out = [...this.begun].map((c) => kHex(c.charCodeAt(0))).join("");
    this.begun = "";
    return out;
  }
}

export type Characters = "utf-8" | "latin-1";
export const kLineEnds: Record<string, string> = { CR: "\r", LF: "\n", "CR LF": "\r\n", none: "" };

/** What was typed as bytes: escapes \xNN \n \r \t \0 \\, characters above U+007F as said. Throws what is wrong. */
export function bytesOf(typed: string, characters: Characters): string {
  let out = "";
  const escapes: Record<string, string> = { n: "\n", r: "\r", t: "\t", "0": "\0", "\\": "\\" };
  for (let i = 0; i < typed.length;) {
    const c = String.fromCodePoint(typed.codePointAt(i)!);
    i += c.length;
    if (c === "\\") {
      const next = typed[i];
      if (next === "x") {
        const hex = typed.slice(i + 1, i + 3);
        if (!/^[0-9a-fA-F]{2}$/.test(hex)) throw new Error(`\\x: got '${hex}', expected two hexadecimal digits`);
        out += String.fromCharCode(parseInt(hex, 16));
        i += 3;
      } else if (next !== undefined && next in escapes) {
        out += escapes[next];
        ++i;
      } else throw new Error(`\\: got '\\${next ?? ""}', expected \\xNN, \\n, \\r, \\t, \\0 or \\\\`);
    } else if (characters === "latin-1") {
      if (c.codePointAt(0)! > 0xff)
        throw new Error(`'${c}' has no byte in Latin-1; choose UTF-8, or write bytes as \\xNN`);
      out += c;
    } else for (const byte of new TextEncoder().encode(c)) out += String.fromCharCode(byte);
  }
  return out;
}
