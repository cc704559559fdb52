/** Between the page and a worker in which the module runs. */
export type ToWorker =
  | { id: number; kind: "ask"; call: string; question: unknown }
  | { id: number; kind: "file"; path: string }
  | { id: number; kind: "put"; file: File };

/** An event with id 0 is a robot's. */
export type FromWorker =
  | { id: number; kind: "event"; event: { event: string } }
  | { id: number; kind: "answer"; answer: unknown }
  | { id: number; kind: "refusal"; sentence: string; remedies: string[] };
