// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import test from "node:test";
import { bytesOf, Utf8Pieces } from "../src/panes/bytes";

const utf8 = (text: string) => String.fromCharCode(...new TextEncoder().encode(text));

test("UTF-8 is read, wherever its bytes are cut", () => {
  const text = "aé€😀z",
    bytes = utf8(text);
  for (let cut = 0; cut <= bytes.length; ++cut) {
    const pieces = new Utf8Pieces();
    assert.equal(pieces.take(bytes.slice(0, cut)) + pieces.take(bytes.slice(cut)), text, `cut at ${cut}`);
  }
  const single = new Utf8Pieces();
  assert.equal([...bytes].map((b) => single.take(b)).join(""), text);
});

test("every character is read", () => {
  const pieces = new Utf8Pieces();
  for (let code = 0xa0; code <= 0x10ffff; code += code < 0x10000 || code > 0x10ff00 ? 1 : 61) {
    if (code === 0xd800) code = 0xe000; // halves of pairs are none
    const text = String.fromCodePoint(code);
    if (pieces.take(utf8(text)) !== text) assert.fail(`U+${code.toString(16)}`);
  }
});

test("what is no UTF-8 is shown byte by byte", () => {
  const read = (bytes: string) => {
    const pieces = new Utf8Pieces();
    return pieces.take(bytes) + pieces.flush();
  };
  assert.equal(read("a\x80b"), "a\\x80b");
  assert.equal(read("\xff\xfe"), "\\xff\\xfe");
  assert.equal(read("\xc0\x80"), "\\xc0\\x80"); // too long a zero
  assert.equal(read("\xed\xa0\x80"), "\\xed\\xa0\\x80"); // half a surrogate pair
  assert.equal(read("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80"); // beyond U+10FFFF
  assert.equal(read("\xe2\x82"), "\\xe2\\x82"); // never completed
  assert.equal(read("\xe2\x82A"), "\\xe2\\x82A");
});

test("control characters are readable", () => {
  const pieces = new Utf8Pieces();
  assert.equal(pieces.take("\0\x1b[31m\tx\x7f"), "\\0\\x1b[31m\tx\\x7f");
});

test("what is typed becomes bytes", () => {
  assert.equal(bytesOf("D,100\\r\\n", "utf-8"), "D,100\r\n");
  assert.equal(bytesOf("\\xf5\\0\\\\", "utf-8"), "\xf5\0\\");
  assert.equal(bytesOf("é", "utf-8"), "\xc3\xa9");
  assert.equal(bytesOf("é", "latin-1"), "\xe9");
  assert.equal(bytesOf("😀", "utf-8"), "\xf0\x9f\x98\x80");
  assert.throws(() => bytesOf("€", "latin-1"), /no byte in Latin-1/);
  assert.throws(() => bytesOf("\\x4", "utf-8"), /two hexadecimal digits/);
  assert.throws(() => bytesOf("\\q", "utf-8"), /expected \\xNN/);
  assert.throws(() => bytesOf("a\\", "utf-8"), /expected \\xNN/);
});
