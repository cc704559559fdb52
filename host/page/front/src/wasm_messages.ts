import type { Event_ } from "./backend";
import type { ToPort } from "./serial/messages";

/** Between the page and a worker in which the module runs. */
export type ToWorker =
  | { id: number; kind: "ask"; call: string; question: unknown; asked_ms: number }
  | { id: number; kind: "file"; path: string }
  | { id: number; kind: "put"; file: File }
  /** Comes first, if a page may share memory: what a port gives, and questions to a robot, which are asked while the worker waits. */
  | { id: 0; kind: "share"; line: SharedArrayBuffer; questions: SharedArrayBuffer }
  /** Questions were put into that memory. */
  | { id: 0; kind: "look" };

/** An event with id 0 is a robot's. */
export type FromWorker =
  | { id: number; kind: "event"; event: Event_ }
  | { id: number; kind: "answer"; answer: unknown }
  | { id: number; kind: "refusal"; sentence: string; remedies: string[] }
  | ({ id: 0 } & ToPort);
