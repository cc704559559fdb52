import type { SharedBytes } from "./shared_bytes";

/** What the page asks of a robot. */
export interface RobotQuestion {
  id: number;
  call: string;
  question: unknown;
  /** By the clock that the page and its workers have in common. */
  asked_ms: number;
}

export const common_clock_ms = () => performance.timeOrigin + performance.now();

/** False if there is no room. */
export const put_question = (queue: SharedBytes, question: RobotQuestion) => queue.put(new TextEncoder().encode(`${JSON.stringify(question)}\n`));

/** All that were asked so far. */
export function take_questions(queue: SharedBytes): RobotQuestion[] {
  const bytes = new Uint8Array(queue.waiting);
  queue.take(bytes);
  const lines = new TextDecoder().decode(bytes).split("\n");
  return lines.slice(0, -1).map((line) => JSON.parse(line) as RobotQuestion);
}
