import type { Backend, Event_ } from "./backend";
import { OpenQuestions } from "./open_questions";
import { put_question } from "./serial/question_queue";
import { OpenPort } from "./serial/serial_ports";
import { SharedBytes } from "./serial/shared_bytes";
import type { FromWorker, ToWorker } from "./wasm_messages";

/** The module in a worker of this page. Nothing leaves the computer. */
export class WasmBackend implements Backend {
  readonly has_ports = false;
  private worker: Worker | undefined;
  private questions = new OpenQuestions();
  /** What a port gives, of which the worker may wait for several seconds, and questions to the robot. */
  private shared: { port: OpenPort; questions: SharedBytes } | undefined;
  /** Why the worker cannot answer; set once and for all. */
  private broken = "";

  /** `for_robots`: opens robots, and their ports where the page may. */
  constructor(private for_robots: boolean) {}

  /** Loads the module, which the first question would do, too. */
  start(): Worker {
    if (this.worker) return this.worker;
    this.worker = new Worker(new URL("./wasm_worker.ts", import.meta.url), { type: "module" });
    this.worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.take(data);
    this.worker.onerror = (event) => {
      this.broken = `the module cannot be loaded: ${event.message || "it is not beside this page"}`;
      this.questions.refuse_all(this.broken);
    };
    if (this.for_robots && crossOriginIsolated) this.share(this.worker);
    return this.worker;
  }

  private share(worker: Worker) {
    const line = SharedBytes.of_size(1 << 20), questions = SharedBytes.of_size(1 << 16);
    this.shared = { port: new OpenPort(line), questions };
    worker.postMessage({ id: 0, kind: "share", line: line.memory, questions: questions.memory } satisfies ToWorker);
  }

  ask<Answer>(call: string, question: unknown, told?: (event: Event_) => void): Promise<Answer> {
    return this.questions.ask<Answer>((id) => this.send({ id, kind: "ask", call, question, asked_ms: Date.now() }), told);
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
    else if (message.kind !== "ask" || !this.shared) worker.postMessage(message);
    else if (put_question(this.shared.questions, message)) worker.postMessage({ id: 0, kind: "look" } satisfies ToWorker);
    else this.questions.refuse(message.id, "too many questions wait for the robot: ask again");
  }

  private take(message: FromWorker) {
    if (message.kind === "event") this.questions.tell(message.id, message.event);
    else if (message.kind === "answer") this.questions.answer(message.id, message.answer);
    else if (message.kind !== "refusal") this.shared?.port.take(message);
    else this.questions.refuse(message.id, message.sentence, message.remedies);
  }
}
