// SPDX-License-Identifier: MIT
// What people type, a buffer for each file: a controller's sources and the world's text. A buffer is never replaced
// while it holds what nobody has saved, and it is saved only over the bytes that were read.
import { isDirty, keyOf, kWorldKey } from "./buffer";
import type { Buffer, Conflict } from "./buffer";
import type { Client } from "./client";
import { merge } from "./merge";
import type { Store } from "./store";

export type Saved = "saved" | "unread" | "conflict" | "readonly" | "failed";

export class Buffers {
  private all = new Map<string, Buffer>();
  private reading = new Map<string, Promise<Buffer>>();

  constructor(
    private store: Store,
    private client: Client,
  ) {
    this.all.set(kWorldKey, {
      key: kWorldKey,
      name: "world file",
      program: "",
      file: "",
      text: "",
      writable: true,
    });
    store.on("world", () => this.takeWorld(store.world.text, store.world.base));
    client.link.on("disk", (e) => {
      if (e.program !== undefined) void this.takeDisk(e.program, e.file, e.base);
    });
    // servers before version 2 tell of no changes on the disk, but of each build
    store.on("built", (e) => {
      for (const b of this.all.values())
        if (b.program === e.program && b.base === undefined && b.read !== undefined && !isDirty(b)) void this.read(b);
    });
  }

  get(key: string): Buffer | undefined {
    return this.all.get(key);
  }
  get world(): Buffer {
    return this.all.get(kWorldKey)!;
  }
  dirty(): Buffer[] {
    return [...this.all.values()].filter(isDirty);
  }
  /** What somebody has typed. */
  edit(key: string, text: string) {
    const b = this.all.get(key);
    if (!b || b.read === undefined || b.text === text) return;
    const was = isDirty(b);
    b.text = text;
    if (was !== isDirty(b)) this.tell(b);
  }

  // --- sources

  /** The file's buffer, once its text is here. Rejected where it cannot be read. */
  async open(program: string, file: string): Promise<Buffer> {
    const key = keyOf(program, file);
    let b = this.all.get(key);
    if (!b) {
      b = { key, name: `${program} / ${file}`, program, file, text: "", writable: true };
      this.all.set(key, b);
    }
    return b.read !== undefined ? b : this.read(b);
  }
  private read(b: Buffer): Promise<Buffer> {
    const under = this.reading.get(b.key);
    if (under) return under;
    const { program, file } = b;
    const promise = this.client
      .ask("source", { program, file })
      .then((answer) => {
        // typed meanwhile: it stays, and what has come is the other side
        if (isDirty(b)) b.conflict = { base: answer.base ?? null, text: answer.text };
        else {
          b.text = b.read = answer.text;
          b.conflict = undefined;
          b.base = answer.base;
        }
        b.writable = answer.writable ?? true;
        this.tell(b);
        return b;
      })
      .finally(() => this.reading.delete(b.key));
    this.reading.set(b.key, promise);
    return promise;
  }
  /** Writes a source over the bytes that were read, or over whatever is there. */
  async save(key: string, overwrite = false): Promise<Saved> {
    const b = this.all.get(key);
    if (!b || b.read === undefined) return "unread";
    if (b.conflict && !overwrite) return "conflict";
    const { text, program, file, base } = b;
    try {
      const answer = await this.client.ask("write_source", { program, file, text, base, overwrite });
      b.read = text;
      b.base = answer.base;
      b.conflict = undefined;
      b.writable = true;
      this.tell(b);
      return "saved";
    } catch (e) {
      return this.refused(b, e as Error);
    }
  }
  private refused(b: Buffer, e: Error & { conflict?: Conflict; readonly?: boolean }): Saved {
    if (e.conflict) {
      b.conflict = e.conflict;
      this.tell(b);
      return "conflict";
    }
    if (e.readonly) {
      b.writable = false;
      this.tell(b);
      return "readonly";
    }
    throw e;
  }
  /** The buffer becomes what is there instead. (An editor can still undo it.) */
  reload(key: string) {
    const b = this.all.get(key);
    if (!b?.conflict || b.conflict.text === null) return;
    b.text = b.read = b.conflict.text;
    b.base = b.conflict.base ?? undefined;
    b.conflict = undefined;
    this.tell(b);
  }
  private async takeDisk(program: string, file: string, base: string | null) {
    const b = this.all.get(keyOf(program, file));
    if (!b || b.read === undefined || base === b.base) return;
    if (!isDirty(b) && base !== null) {
      await this.read(b).catch(() => {});
      return;
    }
    if (base === null) b.conflict = { base: null, text: null };
    else {
      const answer = await this.client.ask("source", { program, file }).catch(() => undefined);
      if (!answer || answer.base === b.base) return;
      b.conflict = { base: answer.base, text: answer.text };
    }
    this.tell(b);
  }

  // --- the world's text

  private takeWorld(theirs: string, base?: string) {
    const b = this.world;
    b.name = this.store.world.file.split("/").pop()!;
    if (!isDirty(b)) b.text = theirs;
    else {
      // somebody has dragged a wall while the text was typed upon
      const merged = merge(b.read!, b.text, theirs);
      b.text = merged.text;
      if (merged.conflicts.length) b.conflict = { base: base ?? null, text: theirs };
    }
    if (b.text === theirs) b.conflict = undefined;
    else if (b.conflict) b.conflict = { base: base ?? null, text: theirs };
    b.read = theirs;
    b.base = base;
    this.tell(b);
  }
  /** The world becomes what is typed. */
  async apply(overwrite = false, anew = false): Promise<Saved> {
    const b = this.world;
    if (b.read === undefined) return "unread";
    if (b.conflict && !overwrite) return "conflict";
    const { text, base } = b;
    b.conflict = undefined;
    try {
      await this.client.ask("edit", { op: "text", text, base, ...(anew ? { anew } : {}) });
      this.tell(b);
      return "saved";
    } catch (e) {
      const { conflict } = e as { conflict?: Conflict };
      if (!conflict) throw e;
      this.takeWorld(conflict.text!, conflict.base ?? undefined);
      // nothing in the way: what the server has is in the text now
      return b.conflict ? "conflict" : this.apply(false, anew);
    }
  }
  /** What is typed in the world's text, and nobody wants, goes. */
  discardWorld() {
    const b = this.world;
    if (b.read === undefined) return;
    b.text = b.read;
    b.conflict = undefined;
    this.tell(b);
  }
  private tell(b: Buffer) {
    this.store.tell("buffer", b);
  }
}
