// SPDX-License-Identifier: MIT
// The world's file: saved, saved under another name, read again; another world, a new one. Nothing is lost unasked.
import type { Conflict } from "../store/buffer";
import { isDirty } from "../store/buffer";
import type { Buffers } from "../store/buffers";
import type { Client } from "../store/client";
import type { Store } from "../store/store";
import type { WorldTextPane } from "../panes/world_text";
import { askText, notice, question } from "./notices";

type Refused = Error & { conflict?: Conflict; readonly?: boolean; unsaved?: boolean };

export class WorldFile {
  constructor(
    private store: Store,
    private client: Client,
    private buffers: Buffers,
    private text: WorldTextPane,
  ) {
    client.link.on("disk", (e) => {
      if (e.program === undefined) void this.onDisk(e.base);
    });
  }
  private get name() {
    return this.store.world.file.split("/").pop()!;
  }

  /** What is typed in the world's text and not applied: first that. False: not now. */
  private async settle(): Promise<boolean> {
    if (!isDirty(this.buffers.world)) return true;
    const choice = await question("The world's text has changes that are not applied.", [
      { id: "apply-first", text: "Apply and save", value: "apply", strong: true },
      { id: "save-without", text: "Save without them", value: "without" },
      { id: "save-not", text: "Do not save", value: "not" },
    ]);
    if (choice === "apply") return this.text.apply();
    return choice === "without";
  }
  async save(overwrite = false): Promise<boolean> {
    if (!overwrite && !(await this.settle())) return false;
    try {
      await this.client.ask("save", { overwrite });
      notice("saved");
      return true;
    } catch (e) {
      const { message, conflict, readonly } = e as Refused;
      if (conflict) return this.settleConflict(conflict);
      if (!readonly) {
        notice(message, true);
        return false;
      }
      const other = await question(`${this.name} may not be written (it is read-only): nothing was saved.`, [
        { id: "save-elsewhere", text: "Save as…", value: true, strong: true },
        { id: "leave", text: "Leave it", value: false },
      ]);
      return other ? this.saveAs() : false;
    }
  }
  /** Somebody else has written the file. */
  private async settleConflict(conflict: Conflict): Promise<boolean> {
    const gone = conflict.text === null;
    const choice = await question(
      gone ? `${this.name} is gone from the disk.` : `${this.name} was changed on the disk by another program.`,
      [
        { id: "disk-reload", text: "Reload", value: "reload", hidden: gone },
        { id: "disk-overwrite", text: gone ? "Write it" : "Overwrite", value: "overwrite" },
        { id: "disk-compare", text: "Compare", value: "compare", hidden: gone },
        { id: "leave", text: "Leave it", value: "leave" },
      ],
    );
    if (choice === "overwrite") return this.save(true);
    if (choice === "reload") await this.reload();
    if (choice === "compare") {
      this.store.tell("show", "text");
      this.text.compareWith(conflict.text!, "on the disk");
    }
    return false;
  }
  private async reload() {
    if (await this.client.do("reload")) notice(`${this.name} is read again; Undo brings back what was`);
  }
  private async onDisk(base: string | null) {
    if (base === null) return notice(`${this.name} is gone from the disk; Save writes it again`, true);
    const choice = await question(`${this.name} was changed on the disk by another program.`, [
      { id: "disk-reload", text: "Reload", value: true, strong: this.store.state.saved },
      { id: "leave", text: "Leave it", value: false },
    ]);
    if (choice) await this.reload();
  }
  async saveAs(): Promise<boolean> {
    if (!(await this.settle())) return false;
    const name = await askText("Save in the same folder as", this.name);
    if (!name) return false;
    const full = name.endsWith(".toml") ? name : name + ".toml";
    try {
      await this.client.ask("save_as", { name: full });
    } catch (e) {
      if (!/overwrite/.test((e as Error).message)) {
        notice((e as Error).message, true);
        return false;
      }
      const yes = await question(`${full} is there already.`, [
        { id: "overwrite", text: "Overwrite it", value: true },
        { id: "leave", text: "Leave it", value: false },
      ]);
      if (!yes || !(await this.client.do("save_as", { name: full, overwrite: true }))) return false;
    }
    this.store.rename(full);
    notice(`saved as ${full}`);
    return true;
  }

  // --- another world

  /** Asks where something would be lost. */
  private async mayLeave(): Promise<boolean> {
    const dirty = this.buffers.dirty().filter((b) => !b.program);
    if (this.store.state.saved && !dirty.length) return true;
    const choice = await question(`${this.name} has changes that are not saved.`, [
      { id: "save-first", text: "Save them", value: "save", strong: true },
      { id: "discard", text: "Discard them", value: "discard" },
      { id: "leave", text: "Stay here", value: "stay" },
    ]);
    if (choice === "save") return this.save();
    if (choice !== "discard") return false;
    if (dirty.length) this.buffers.discardWorld();
    return true;
  }
  async open(file: string) {
    if (await this.mayLeave()) await this.client.do("open", { file, discard: true });
  }
  async fresh() {
    if (!(await this.mayLeave())) return;
    const name = await askText("A new world in the same folder, named", "world.toml");
    if (!name) return;
    await this.client.do("new_world", { name: name.endsWith(".toml") ? name : name + ".toml" });
  }
}
