/**
 * Recordings of a robot in this browser's module, whose memory goes with the page. What was driven cannot be driven again, so what the
 * module writes is copied into the browser's own storage for this site, where it outlives a page that was reloaded, closed or crashed.
 */
const kFolder = "recordings";
/** Held while the page that records a file is open, so that no other page offers what is still being written. */
const lock_of = (name: string) => `${kFolder}/${name}`;

const folder = async () => (await navigator.storage.getDirectory()).getDirectoryHandle(kFolder, { create: true });

/** Recordings that nobody has removed, and whose page has gone. None where the browser keeps nothing, as in private windows. */
export async function left_recordings(): Promise<string[]> {
  try {
    const { held = [] } = await navigator.locks.query();
    const names: string[] = [];
    for await (const name of (await folder()).keys()) if (!held.some((lock) => lock.name === lock_of(name))) names.push(name);
    return names.sort();
  } catch {
    return [];
  }
}

export const left_recording = async (name: string): Promise<Blob> => (await (await folder()).getFileHandle(name)).getFile();
export const drop_recording = async (name: string) => (await folder()).removeEntry(name);

/** What is used here of the module's file system. */
export interface ModuleFiles {
  analyzePath(path: string): { exists: boolean };
  stat(path: string): { size: number };
  open(path: string, flags: string): object;
  read(stream: object, into: Uint8Array, offset: number, length: number, position: number): number;
  close(stream: object): void;
}

/** The copy of one recording, in the worker that writes it. */
export class KeptRecording {
  private copied = 0;

  private constructor(readonly name: string, private files: ModuleFiles, private path: string, private handle: FileSystemSyncAccessHandle, private release: () => void) {}

  /** `path`: the file as the module names it once it is complete. Null where the browser keeps nothing. */
  static async of(files: ModuleFiles, path: string): Promise<KeptRecording | null> {
    const name = path.split("/").at(-1)!;
    try {
      const handle = await (await (await folder()).getFileHandle(name, { create: true })).createSyncAccessHandle();
      const release = await new Promise<() => void>((held) => {
        void navigator.locks.request(lock_of(name), () => new Promise<void>((release) => held(release)));
      });
      return new KeptRecording(name, files, path, handle, release);
    } catch {
      return null;
    }
  }

  /** Copies what was written since. A storage that is full keeps what it has. */
  copy() {
    const path = [this.path, `${this.path}.part`].find((each) => this.files.analyzePath(each).exists);
    if (path === undefined) return;
    const bytes = new Uint8Array(this.files.stat(path).size - this.copied);
    if (bytes.length === 0) return;
    const stream = this.files.open(path, "r");
    this.files.read(stream, bytes, 0, bytes.length, this.copied);
    this.files.close(stream);
    try {
      this.copied += this.handle.write(bytes, { at: this.copied });
      this.handle.flush();
    } catch {
      // It is tried again with the next bytes.
    }
  }

  /** A person has the recording, or does not want it. */
  async drop() {
    this.handle.close();
    await drop_recording(this.name);
    this.release();
  }
}
