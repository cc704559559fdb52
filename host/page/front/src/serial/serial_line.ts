import { kClosed, kOpening, state_of, type ToPort, why_closed } from "./messages";
import type { SharedBytes } from "./shared_bytes";

/** In the worker: the port that the page holds open, as the module uses it (host/page/wasm/page_port.hpp). */
export class SerialLine {
  private opening = 0;

  /** `meanwhile`: answers the questions that have come; the module calls it again and again during a measurement. */
  constructor(
    private line: SharedBytes,
    private post: (message: ToPort) => void,
    readonly meanwhile: () => void,
  ) {}

  /** "" once it is open, or what follows "the port". */
  open(name: string, most_ms: number): string {
    const waits = state_of(++this.opening, kOpening);
    this.line.state = waits;
    this.post({ kind: "open_port", name, opening: this.opening });
    this.line.wait_until(() => this.line.state !== waits, most_ms);
    const why = this.why_closed();
    if (why !== "") this.close();
    return why;
  }

  /** How many; -1 if it is closed. */
  read(into: Uint8Array, most_ms: number): number {
    this.line.wait_until(() => this.line.waiting > 0 || this.why_closed() !== "", most_ms);
    const count = this.line.take(into);
    return count > 0 || this.why_closed() === "" ? count : -1;
  }

  write(bytes: Uint8Array) {
    this.post({ kind: "write_port", bytes: bytes.slice(), sent_ms: Date.now() });
  }

  close() {
    this.line.state = state_of(this.opening, kClosed);
    this.post({ kind: "close_port" });
  }

  pause(time_ms: number) {
    this.line.wait_until(() => false, time_ms);
  }

  why_closed = () => why_closed(this.line.state);
}
