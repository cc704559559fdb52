/** What answers the page's questions: the module in this browser, or a program that serves the page. */
export interface Backend {
  /** Where it looks for a robot: only those that it simulates, or at this computer's ports as well. */
  readonly has_ports: boolean;
  /**
   * Asks `call` with `question` and passes on what happens meanwhile.
   * Rejects with a Refusal if it cannot be done.
   */
  ask<Answer>(call: string, question: unknown, told?: (event: Event_) => void): Promise<Answer>;
  /**
   * Passes on what belongs to no question, until the function that it answers is called: what an open robot sends, and
   * {event: "connection", up, why} whenever whoever answers goes away or comes back.
   */
  listen(told: (event: Event_) => void): () => void;
  /** A file that an answer names. */
  file(path: string): Promise<Blob>;
  /** Makes a person's file readable for calls, under its name. */
  put(file: File): Promise<void>;
}

/** Something that happens while a question is being answered, or while a robot is open. */
export interface Event_ {
  event: string;
  [key: string]: unknown;
}

/** Why a question was not answered, in a sentence for people, and which statements may help. */
export class Refusal extends Error {
  constructor(
    sentence: string,
    readonly remedies: string[] = [],
  ) {
    super(sentence);
  }
}

/** What went wrong, in a sentence. */
export const sentence_of = (error: unknown) => (error instanceof Error ? error.message : String(error));
