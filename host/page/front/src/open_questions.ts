import { type Event_, Refusal } from "./backend";

interface Waiting {
  told: (event: Event_) => void;
  resolve: (value: unknown) => void;
  reject: (why: Error) => void;
}

/** The questions that are not answered yet, each with a number from 1 on; number 0 is for what nobody asked. */
export class OpenQuestions {
  private waiting = new Map<number, Waiting>();
  private listeners = new Set<(event: Event_) => void>();
  private last = 0;

  /** Has `send` put a question under way with its number. */
  ask<Value>(send: (id: number) => void, told: (event: Event_) => void = () => {}): Promise<Value> {
    return new Promise<Value>((resolve, reject) => {
      const id = ++this.last;
      this.waiting.set(id, { told, resolve: resolve as (value: unknown) => void, reject });
      send(id);
    });
  }

  listen(told: (event: Event_) => void): () => void {
    this.listeners.add(told);
    return () => this.listeners.delete(told);
  }

  tell(id: number, event: Event_) {
    if (id === 0) for (const each of this.listeners) each(event);
    else this.waiting.get(id)?.told(event);
  }

  answer(id: number, value: unknown) {
    this.taken(id)?.resolve(value);
  }

  refuse(id: number, sentence: string, remedies: string[] = []) {
    this.taken(id)?.reject(new Refusal(sentence, remedies));
  }

  refuse_all(sentence: string) {
    for (const id of [...this.waiting.keys()]) this.refuse(id, sentence);
  }

  private taken(id: number) {
    const found = this.waiting.get(id);
    this.waiting.delete(id);
    return found;
  }
}
