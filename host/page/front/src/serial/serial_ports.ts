import { kClosed, kMissing, kOpen, kRefused, type ToPort } from "./messages";
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
interface Serial {
  getPorts(): Promise<SerialPort[]>;
  requestPort(): Promise<SerialPort>;
}

/** As the installed program opens it; a robot on USB has no baud rate. */
const kOptions = { baudRate: 1_000_000, bufferSize: 65_536 };

/** Undefined where the browser has no Web Serial. */
export const web_serial = (): Serial | undefined => (navigator as { serial?: Serial }).serial;

const hexadecimal = (id: number) => id.toString(16).padStart(4, "0");

/** The ports that a person has chosen for this page, now or before. Ports of the same kind are told apart by their order. */
async function named_ports(): Promise<Map<string, SerialPort>> {
  const ports = new Map<string, SerialPort>();
  for (const port of (await web_serial()?.getPorts()) ?? []) {
    const { usbVendorId: vendor, usbProductId: product } = port.getInfo();
    const kind = vendor === undefined ? "serial port" : `USB ${hexadecimal(vendor)}:${hexadecimal(product ?? 0)}`;
    let name = kind;
    for (let n = 2; ports.has(name); ++n) name = `${kind}, number ${n}`;
    ports.set(name, port);
  }
  return ports;
}

export const port_names = async () => [...(await named_ports()).keys()];

/** Has a person choose; its name. Throws what the browser says if nobody chooses. */
export async function choose_port(): Promise<string> {
  const chosen = await web_serial()!.requestPort();
  for (const [name, port] of await named_ports()) if (port === chosen) return name;
  throw new Error("The browser does not give the port to this page.");
}

/** One port that is open for a worker: what comes from it goes into memory that both share. */
export class OpenPort {
  private port: SerialPort | undefined;
  private writer: WritableStreamDefaultWriter<Uint8Array> | undefined;
  private reader: ReadableStreamDefaultReader<Uint8Array> | undefined;
  /** Opening and closing take time, and are done one after another. */
  private done: Promise<void> = Promise.resolve();

  constructor(private line: SharedBytes) {}

  take(message: ToPort) {
    if (message.kind === "write_port") this.writer?.write(message.bytes).catch(() => this.lose());
    else this.done = this.done.then(() => (message.kind === "open_port" ? this.open(message.name) : this.close()));
  }

  private async open(name: string) {
    await this.close();
    const port = (await named_ports()).get(name);
    if (!port) {
      this.line.state = kMissing;
      return;
    }
    try {
      await port.open(kOptions);
    } catch {
      this.line.state = kRefused;
      return;
    }
    this.port = port;
    // Some systems leave the line that tells a robot that somebody listens, and not all adapters have it.
    await port.setSignals({ dataTerminalReady: true }).catch(() => {});
    this.writer = port.writable!.getWriter();
    this.reader = port.readable!.getReader();
    this.line.take(new Uint8Array(this.line.waiting)); // of what was open before
    this.line.state = kOpen;
    void this.read(this.reader);
  }

  /** Bytes that find no room are lost, as on any line: the worker was busy for many seconds. */
  private async read(reader: ReadableStreamDefaultReader<Uint8Array>) {
    try {
      for (;;) {
        const { value, done } = await reader.read();
        if (done) break;
        this.line.put(value);
      }
    } catch {
      // The cable was pulled.
    }
    if (this.reader === reader) this.lose();
  }

  private lose() {
    if (this.line.state === kOpen) this.line.state = kMissing;
  }

  private async close() {
    const { port, reader, writer } = this;
    this.port = this.reader = this.writer = undefined;
    if (!port) return;
    if (this.line.state === kOpen) this.line.state = kClosed;
    await reader?.cancel().catch(() => {});
    reader?.releaseLock();
    await writer?.abort().catch(() => {});
    writer?.releaseLock();
    await port.close().catch(() => {});
  }
}
