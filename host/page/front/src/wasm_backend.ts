import { type Backend, type Event_, Refusal } from "./backend";
import type { FromWorker, ToWorker } from "./wasm_messages";

interface Waiting {
  told: (event: Event_) => void;
  resolve: (value: unknown) => void;
  reject: (why: Error) => void;
}

/** The module in a worker of this page. Nothing leaves the computer. */
export class WasmBackend implements Backend {
  private worker = new Worker(new URL("./wasm_worker.ts", import.meta.url), { type: "module" });
  private waiting = new Map<number, Waiting>();
  private last = 0;

  constructor() {
    this.worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.take(data);
    this.worker.onerror = (event) => {
      for (const each of this.waiting.values())
        each.reject(new Refusal(`the module cannot be loaded: ${event.message ?? "it is not beside this page"}`));
      this.waiting.clear();
    };
  }

  ask<Answer>(call: string, question: unknown, told: (event: Event_) => void): Promise<Answer> {
    return this.send<Answer>({ id: ++this.last, kind: "ask", call, question }, told);
  }

  async file(path: string): Promise<Blob> {
    return new Blob([await this.send<Uint8Array<ArrayBuffer>>({ id: ++this.last, kind: "file", path }, () => {})]);
  }

  async put(file: File): Promise<void> {
    await this.send<null>({ id: ++this.last, kind: "put", file }, () => {});
  }

  private send<Value>(message: ToWorker, told: (event: Event_) => void): Promise<Value> {
    return new Promise<Value>((resolve, reject) => {
      this.waiting.set(message.id, { told, resolve: resolve as (value: unknown) => void, reject });
      this.worker.postMessage(message);
    });
  }

  private take(message: FromWorker) {
    const waiting = this.waiting.get(message.id);
    if (!waiting) return;
    if (message.kind === "event") return waiting.told(message.event);
    this.waiting.delete(message.id);
    if (message.kind === "answer") waiting.resolve(message.answer);
    else if (message.kind === "file") waiting.resolve(message.bytes);
    else waiting.reject(new Refusal(message.sentence, message.remedies));
  }
}
