/** What answers the page's questions: the module in this browser, or a program that serves the page. */
export interface Backend {
  /**
   * Asks `call` with `question` and passes on what happens meanwhile.
   * Rejects with a Refusal if it cannot be done.
   */
  ask<Answer>(call: string, question: unknown, told: (event: Event_) => void): Promise<Answer>;
  /** A file that an answer names. */
  file(path: string): Promise<Blob>;
  /** Makes a person's file readable for calls, under its name. */
  put(file: File): Promise<void>;
}

/** Something that happens while a question is being answered. */
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
