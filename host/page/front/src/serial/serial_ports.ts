import { kClosed, kMissing, kOpen, kOpening, kRefused, kStale_ms, state_of, type ToPort } from "./messages";
import type { SharedBytes } from "./shared_bytes";

/** What is used here of Web Serial, which TypeScript does not know yet. */
interface SerialPort {
  readonly readable: ReadableStream<Uint8Array> | null;
  readonly writable: WritableStream<Uint8Array> | null;
  getInfo(): { usbVendorId?: number; usbProductId?: number };
  open(options: { baudRate: number; bufferSize: number }): Promise<void>;
  setSignals(signals: { dataTerminalReady: boolean }): Promise<void>;
  close(): Promise<void>;
}
interface Serial extends EventTarget {
  getPorts(): Promise<SerialPort[]>;
  requestPort(): Promise<SerialPort>;
}

/** As the installed program opens it; a robot on USB has no baud rate. */
const kOptions = { baudRate: 1_000_000, bufferSize: 65_536 };
/** A port whose driver hangs is given up after this time. */
const kPatience_ms = 500;

/** Undefined where the browser has no Web Serial. */
export const web_serial = (): Serial | undefined => (navigator as { serial?: Serial }).serial;

const hexadecimal = (id: number) => id.toString(16).padStart(4, "0");
const names = new WeakMap<SerialPort, string>();

/** The ports that a person has chosen for this page, now or before. Each keeps its name while the page is open. */
async function named_ports(): Promise<Map<string, SerialPort>> {
  const ports = (await web_serial()?.getPorts()) ?? [];
  const taken = new Set(ports.map((port) => names.get(port)));
  for (const port of ports.filter((each) => !names.has(each))) {
    const { usbVendorId: vendor, usbProductId: product } = port.getInfo();
    const kind = vendor === undefined ? "serial port" : `USB ${hexadecimal(vendor)}:${hexadecimal(product ?? 0)}`;
    let name = kind;
    for (let n = 2; taken.has(name); ++n) name = `${kind}, number ${n}`;
    names.set(port, name);
    taken.add(name);
  }
  return new Map(ports.map((port) => [names.get(port)!, port]));
}

export const port_names = async () => [...(await named_ports()).keys()];

/** Has a person choose; its name. Throws what the browser says if nobody chooses. */
export async function choose_port(): Promise<string> {
  const chosen = await web_serial()!.requestPort();
  await named_ports();
  return names.get(chosen)!;
}

/** Whatever becomes of it, after kPatience_ms nobody waits any more. */
const in_time = (done: Promise<unknown> | undefined) =>
  Promise.race([(done ?? Promise.resolve()).catch(() => {}), new Promise((late) => setTimeout(late, kPatience_ms))]);

/** One port that is open for a worker: what comes from it goes into memory that both share. */
export class OpenPort {
  private port: SerialPort | undefined;
  private writer: WritableStreamDefaultWriter<Uint8Array> | undefined;
  private reader: ReadableStreamDefaultReader<Uint8Array> | undefined;
  private opening = 0;
  /** Opening and closing take time, and are done one after another. */
  private done: Promise<void> = Promise.resolve();

  constructor(private line: SharedBytes) {}

  take(message: ToPort) {
    if (message.kind === "write_port") this.write(message.bytes, message.sent_ms);
    else this.done = this.done.then(() => (message.kind === "open_port" ? this.open(message.name, message.opening) : this.close()));
  }

  private write(bytes: Uint8Array, sent_ms: number) {
    const is_open = this.line.state === state_of(this.opening, kOpen);
    if (is_open && Date.now() - sent_ms < kStale_ms) this.writer?.write(bytes).catch(() => this.become(kOpen, kMissing));
  }

  private async open(name: string, opening: number) {
    await this.close();
    this.opening = opening;
    const port = (await named_ports()).get(name);
    if (!port) {
      this.become(kOpening, kMissing);
      return;
    }
    try {
      await port.open(kOptions);
    } catch {
      this.become(kOpening, kRefused);
      return;
    }
    this.port = port;
    // Some systems leave the line that tells a robot that somebody listens, and not all adapters have it.
    await in_time(port.setSignals({ dataTerminalReady: true }));
    this.writer = port.writable!.getWriter();
    this.line.take(new Uint8Array(this.line.waiting)); // of what was open before
    if (this.become(kOpening, kOpen)) void this.read(port);
    else await this.close(); // the worker waits for it no longer
  }

  /** Bytes that find no room are lost, as on any line: the worker was busy for many seconds. */
  private async read(port: SerialPort) {
    // After an overrun or a damaged byte there is a new stream, and none after the cable was pulled.
    for (let last; port.readable && port.readable !== last; ) {
      last = port.readable;
      const reader = (this.reader = last.getReader());
      try {
        for (let got; !(got = await reader.read()).done; ) this.line.put(got.value);
      } catch {
        // The next stream shows whether it goes on.
      }
      reader.releaseLock();
      if (this.port !== port) return;
    }
    this.become(kOpen, kMissing);
  }

  /** False if the port of this opening is no longer in the state `from`. */
  private become(from: number, to: number): boolean {
    return this.line.change_state(state_of(this.opening, from), state_of(this.opening, to));
  }

  private async close() {
    const { port, reader, writer } = this;
    this.port = this.reader = this.writer = undefined;
    if (!port) return;
    this.become(kOpen, kClosed);
    await in_time(reader?.cancel());
    await in_time(writer?.abort());
    writer?.releaseLock();
    await in_time(port.close());
  }
}
