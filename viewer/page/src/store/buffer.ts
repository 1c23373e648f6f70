// SPDX-License-Identifier: MIT
// What is typed in one file.

export interface Conflict {
  /** What is there now, instead of what was read; null: the file is gone. */
  base: string | null;
  text: string | null;
}
export interface Buffer {
  key: string;
  /** A name for people. */
  name: string;
  /** Empty: the world's text. */
  program: string;
  file: string;
  /** Of the bytes that were read, as the server names them. */
  base?: string;
  /** The text that was read; undefined: it has not come. */
  read?: string;
  text: string;
  writable: boolean;
  /** Somebody else has changed what was read. */
  conflict?: Conflict;
}
export const kWorldKey = "world";
export const keyOf = (program: string, file: string) => `${program}\n${file}`;
export const isDirty = (b: Buffer) => b.read !== undefined && b.text !== b.read;
