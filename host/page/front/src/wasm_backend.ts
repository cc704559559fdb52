import type { Backend, Event_ } from "./backend";
import { OpenQuestions } from "./open_questions";
import type { FromWorker, ToWorker } from "./wasm_messages";

/** The module in a worker of this page. Nothing leaves the computer. */
export class WasmBackend implements Backend {
  readonly has_ports = false;
  private worker: Worker | undefined;
  private questions = new OpenQuestions();
  /** Why the worker cannot answer; set once and for all. */
  private broken = "";

  /** Loads the module, which the first question would do, too. */
  start(): Worker {
    if (this.worker) return this.worker;
    this.worker = new Worker(new URL("./wasm_worker.ts", import.meta.url), { type: "module" });
    this.worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.take(data);
    this.worker.onerror = (event) => {
      this.broken = `the module cannot be loaded: ${event.message || "it is not beside this page"}`;
      this.questions.refuse_all(this.broken);
    };
    return this.worker;
  }

  ask<Answer>(call: string, question: unknown, told?: (event: Event_) => void): Promise<Answer> {
    return this.questions.ask<Answer>((id) => this.send({ id, kind: "ask", call, question }), told);
  }

  listen(told: (event: Event_) => void) {
    return this.questions.listen(told);
  }

  async file(path: string): Promise<Blob> {
    return new Blob([await this.questions.ask<Uint8Array<ArrayBuffer>>((id) => this.send({ id, kind: "file", path }))]);
  }

  async put(file: File): Promise<void> {
    await this.questions.ask<null>((id) => this.send({ id, kind: "put", file }));
  }

  private send(message: ToWorker) {
    const worker = this.start();
    if (this.broken) this.questions.refuse(message.id, this.broken);
    else worker.postMessage(message);
  }

  private take(message: FromWorker) {
    if (message.kind === "event") this.questions.tell(message.id, message.event);
    else if (message.kind === "answer") this.questions.answer(message.id, message.answer);
    else this.questions.refuse(message.id, message.sentence, message.remedies);
  }
}
