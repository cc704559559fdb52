import { kClosed, kOpen, kOpening, kWhyClosed, type ToPort } from "./messages";
import type { SharedBytes } from "./shared_bytes";

/** In the worker: the port that the page holds open, as the module uses it (host/page/wasm/page_port.hpp). */
export class SerialLine {
  /** `meanwhile`: takes the questions that have come, while the module waits. */
  constructor(
    private line: SharedBytes,
    private post: (message: ToPort) => void,
    readonly meanwhile: () => void,
  ) {}

  /** "" once it is open, or what follows "the port". */
  open(name: string, most_ms: number): string {
    this.line.state = kOpening;
    this.post({ kind: "open_port", name });
    this.line.wait_until(() => this.line.state !== kOpening, most_ms);
    return this.why_closed();
  }

  /** How many; -1 if it is closed. */
  read(into: Uint8Array, most_ms: number): number {
    this.line.wait_until(() => this.line.waiting > 0 || this.line.state !== kOpen, most_ms);
    const count = this.line.take(into);
    return count > 0 || this.line.state === kOpen ? count : -1;
  }

  write(bytes: Uint8Array) {
    this.post({ kind: "write_port", bytes: bytes.slice() });
  }

  close() {
    this.line.state = kClosed;
    this.post({ kind: "close_port" });
  }

  pause(time_ms: number) {
    this.line.wait_until(() => false, time_ms);
  }

  why_closed(): string {
    const { state } = this.line;
    return state === kOpen ? "" : (kWhyClosed[state] ?? "does not open");
  }
}
